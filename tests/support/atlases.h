#pragma once
// Atlases for tests that are about something else.

#include "libprt/atlas/chart_texels.h"
#include "libprt/transport/sample_set.h"

#include <memory>

namespace prt::test {

/// Cut by itself and packed.
inline Atlas automaticAtlas(const TriMesh& mesh) {
  Job job;
  const Surface surface(mesh, job);
  AtlasOptions options;
  options.pack.size = 512;
  return packAtlas(autoCut(surface, seamCosts(surface, {}, job), {}, job), options, job);
}

/// Samples at the texels of such an atlas.
inline std::shared_ptr<const SampleSet> texelSamples(const Scene& scene, int size) {
  Job job;
  return std::make_shared<SampleSet>(
      samplesAtTexels(scene, makeChartTexels(automaticAtlas(scene.mesh), size, job), job));
}

}  // namespace prt::test
