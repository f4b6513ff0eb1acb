#pragma once
// Where transfer is computed: vertices, texels or free points, all seen as points on the surface with
// normals. "Nothing bakes over vertices": every baker takes a SampleSet.

#include "libprt/core/math.h"
#include "libprt/transport/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace prt {

struct SampleSet {
  std::vector<Vec3> origin;           ///< [S] where rays start: already moved off the surface
  std::vector<Vec3> geometricNormal;  ///< [S] unit; visibility is clipped by its plane
  std::vector<Vec3> shadingNormal;    ///< [S] unit; cosines use it
  std::vector<std::uint32_t> triangle;  ///< [S] a triangle the sample lies on
  std::vector<Vec2> barycentric;        ///< [S] its place there: weights of corners 1 and 2

  std::size_t size() const { return origin.size(); }
};

/// One sample per vertex of the scene's mesh, in order. The geometric normal is the area-weighted mean
/// of the faces around the vertex's position (all vertices at that position that share the smoothing).
SampleSet samplesAtVertices(const Scene& scene);

/// `count` points spread over the surface, density proportional to area, stratified; the same seed
/// gives the same points.
SampleSet samplesOnSurface(const Scene& scene, std::size_t count, std::uint64_t seed);

}  // namespace prt
