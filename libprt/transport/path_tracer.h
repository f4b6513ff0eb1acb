#pragma once
// Ground truth: unidirectional path tracing of the same scene, materials and light that transfer is
// baked for. Next-event estimation, combined with BRDF sampling by the power heuristic (Veach and Guibas
// 1995, "Optimally Combining Sampling Techniques for Monte Carlo Rendering").
//
// Conventions shared with the bake: visibility is clipped by the geometric surface, cosines use the
// shading normal, back faces block light and reflect nothing unless their material is two-sided. A view
// from under the shading normal's horizon counts as one from that horizon, so that a diffuse surface
// looks the same from everywhere in front of it.
//
// Every random number is a function of (seed, item, sample number): results do not depend on threads,
// and more samples can be added later.

#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/core/sampling.h"
#include "libprt/light/light_rig.h"
#include "libprt/light/light_sampler.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

struct PathOptions {
  int bounces = 3;  ///< interreflections; 0 = direct light and shadows only
  /// Surfaces that are seen by way of another one reflect with their diffuse part alone. Baked
  /// transfer has diffuse bounces, so this is what to compare glossy pictures of it with.
  bool diffuseBounces = false;
  std::uint64_t seed = 1;
};

/// What one ray carries back.
struct PathSample {
  Rgb radiance{0};
  bool hit = false;  ///< the ray met the scene; else radiance is the light's from its direction
};

class PathTracer {
 public:
  /// Keeps a reference to `scene`. `emission`: radiance that reflecting sides of each object send of their
  /// own, found by rays that happen to meet them; empty: none. Throws as RayScene and LightSampler do, and
  /// ValueError when there is not one for each object.
  PathTracer(const Scene& scene, const LightRig& lights, Job& job, std::vector<Rgb> emission = {});

  /// One path along `ray`, with numbers from `stream`.
  PathSample trace(const Ray& ray, const PathOptions& options, SobolStream& stream) const;

  /// One estimate of the irradiance at a sample point: light that arrives in front of both its normals'
  /// planes, cosine about the shading normal included; starts at the sample's origin exactly as the bake
  /// does.
  Rgb irradiance(const SampleSet& samples, std::size_t index, const PathOptions& options,
                 SobolStream& stream) const;

  const Scene& scene() const { return scene_; }
  const LightSampler& lights() const { return lights_; }
  const RayScene& rays() const { return rays_; }

 private:
  struct Vertex;
  Vertex vertexAt(const Hit& hit, const Vec3& direction, bool first, const PathOptions& options) const;
  Rgb gather(Vertex vertex, const PathOptions& options, SobolStream& stream) const;
  Rgb nextEvent(const Vertex& vertex, const Vec2& u) const;
  Rgb emitted(const Hit& hit, const Vec3& direction) const;

  const Scene& scene_;
  RayScene rays_;
  LightSampler lights_;
  std::vector<Material> diffuse_;  // [objects] without their specular part
  std::vector<Rgb> emission_;      // [objects] or empty
  Material receiver_;
};

/// Path-traced irradiance at the points of a sample set, with its standard error.
struct SampleIrradiance {
  std::vector<Rgb> mean;           ///< [S]
  std::vector<Rgb> standardError;  ///< [S] as if the paths were independent: well-spread ones do better
};

/// Means over `paths` paths at each point. `indices` = which points (all when empty; results in its order).
SampleIrradiance irradianceAtSamples(const PathTracer& tracer, const SampleSet& samples,
                                     std::span<const std::uint32_t> indices, int paths,
                                     const PathOptions& options, Job& job);

}  // namespace prt
