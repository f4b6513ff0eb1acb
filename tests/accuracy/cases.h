#pragma once
// Real meshes under real light, made band-limited so that transfer has nothing to leave out.

#include "libprt/basis/sh.h"
#include "libprt/core/job.h"
#include "libprt/light/light_rig.h"
#include "libprt/shade/metrics.h"
#include "libprt/transport/path_tracer.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"
#include "libprt/transport/transfer_bake.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace prt::test {

/// True when PRT_FULL is set: all meshes and probes, more samples.
bool fullRun();

/// A mesh with what a bake needs, and coloured Lambert: red bounces most.
struct Model {
  std::string name;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const RayScene> rays;
  std::shared_ptr<const SampleSet> samples;  ///< at the vertices
};
/// From shared/data/meshes.
Model loadModel(const std::string& file);

/// A probe as 5 bands of non-negative light: the map every renderer gets, and its coefficients.
struct Light {
  std::string name;
  LightRig rig;
  ShRgb coefficients;
};
/// From shared/data/probes.
Light loadLight(const std::string& file);

/// The part of a sample set that `indices` names.
SampleSet subset(const SampleSet& samples, const std::vector<std::uint32_t>& indices);
/// `count` different indices below `size`, ascending, spread by a hash; all of them when there are fewer.
std::vector<std::uint32_t> pick(std::size_t size, std::size_t count, std::uint64_t seed);

/// A mesh file's name as GoogleTest wants names.
std::string caseName(const std::string& file);

/// Colours as a row of numbers.
std::vector<float> flatten(const std::vector<Rgb>& colours);

/// Prints one line of the accuracy table.
void report(const std::string& what, const NoiseFreeError& error);

}  // namespace prt::test
