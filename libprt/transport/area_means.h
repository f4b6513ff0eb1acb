#pragma once
// What bounced light is gathered from. The irradiance at a vertex is not that of its neighbourhood: it falls
// steeply towards the depth of a hollow and the line of a contact, flat faces hide part of the hemisphere of
// a smooth normal, and the hollows, where interpolation between vertices runs too bright, are just what light
// bounces in. No gather over hundreds of triangles averages that away. So light leaves from values at the
// vertices whose interpolation has the right mean over the area around each of them: the vertex's own plus
// what random points of its triangles are off the interpolation. (Without it the error of three bounces
// on lucy with 50 000 vertices was half as large again.) Internal to transport.

#include "libprt/transport/bounce_gather.h"
#include "libprt/transport/sample_set.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace prt {

/// A random point in every triangle that has an area, and on the backs of two-sided ones after them. The same
/// seed gives the same points.
SampleSet pointsInTriangles(const Scene& scene, std::uint64_t seed);

class AreaMeans {
 public:
  /// Bakes direct transfer at one point per triangle, with a 16th of the rays of `direct`, which belongs
  /// to `surface`, the scene's vertices. All must outlive this object.
  AreaMeans(const Scene& scene, const RayScene& rays, const SampleSet& surface, const DirectTransfer& direct,
            std::size_t hitMemory, Job& job);
  ~AreaMeans();

  /// Direct irradiance vectors at the points.
  const SampleRows& direct() const { return direct_; }
  /// What light leaving the surface brings to the points as irradiance.
  SampleRows gather(const SampleRows& leaving, Job& job);
  /// Rays that one gather goes over.
  double rayCount() const;

  /// `atVertices` (rows of the surface set) corrected by what `atPoints` are off their interpolation.
  SampleRows corrected(const SampleRows& atVertices, const SampleRows& atPoints) const;
  /// [points] 1 = inside of something, and left out.
  std::span<const std::uint8_t> buried() const { return buried_; }

 private:
  /// Points are baked in batches with random directions of their own: those of one bake share so few that
  /// the mean over all points would be off by what these have in common.
  struct Batch;

  /// The surface samples around a point.
  std::array<std::uint32_t, 3> cornersOf(std::size_t point) const;

  const Scene& scene_;
  const SampleSet& surface_;
  SampleSet points_;
  std::size_t fronts_;  // the points after these are on backs
  SampleRows direct_;
  std::vector<std::uint8_t> buried_;
  std::vector<std::unique_ptr<Batch>> batches_;
};

}  // namespace prt
