#pragma once
// Where transfer is computed: vertices, texels or free points, all seen as points on the surface with
// normals. "Nothing bakes over vertices": every baker takes a SampleSet.

#include "libprt/atlas/chart_texels.h"
#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/transport/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace prt {

/// "No such sample" and "no such triangle".
inline constexpr std::uint32_t kNone = 0xffffffffu;

/// What a point of the surface is interpolated from.
struct SamplePlace {
  std::array<std::uint32_t, 4> sample{};
  Vec4 weight{0};
};

struct SampleSet {
  std::vector<Vec3> origin;             ///< [S] where rays start: already moved off the surface
  std::vector<Vec3> geometricNormal;    ///< [S] unit; visibility is clipped by its plane
  std::vector<Vec3> shadingNormal;      ///< [S] unit; cosines use it
  std::vector<std::uint32_t> triangle;  ///< [S] a triangle the sample lies on; kNone when it lies on none
  std::vector<Vec2> barycentric;        ///< [S] its place there: weights of corners 1 and 2
  /// The first so many samples are the vertices of the scene's mesh, in order; 0 for other sets.
  std::size_t vertices = 0;
  /// The first texels->count samples are these texels, in order; null for other sets.
  std::shared_ptr<const TexelGrid> texels;
  /// Empty, or [vertices or texels] the sample on the back of each, kNone where that side does not reflect.
  std::vector<std::uint32_t> back;

  std::size_t size() const { return origin.size(); }
  /// Whether every point of the surface lies between some of the samples: vertices or texels.
  bool coversSurface() const { return vertices > 0 || texels != nullptr; }
  /// Samples on fronts: those before the backs.
  std::size_t fronts() const { return texels ? texels->count : vertices; }
  /// Between how many samples a point lies: the corners of its triangle, or the texels around it.
  int around() const { return texels ? 4 : 3; }
  /// Those, with their weights; false when there is none on that side. The fourth of three is the first again
  /// and weighs nothing. Only where coversSurface().
  bool at(const TriMesh& mesh, std::uint32_t triangle, const Vec2& barycentric, bool onBack,
          SamplePlace& place) const;
};

/// Some samples of a set, in the given order; no longer counted as vertices. Throws ValueError when an index
/// is out of range.
SampleSet someSamples(const SampleSet& samples, std::span<const std::uint32_t> indices);

/// One sample per vertex of the scene's mesh, in order; then, for each vertex of an object whose material
/// is two-sided, one for its back, with both normals turned over (`back` is empty when there is none).
///
/// Geometric normal: angle-weighted mean (Thuermer and Wuethrich 1998) of the faces that meet at the
/// vertex's *position* and share its smoothing: faces of the same object whose corner there has the same
/// shading normal. So vertices split at a texture seam get the same sample, and vertices split at a
/// crease keep the flat sides of the crease. A vertex without faces has its shading normal for both.
///
/// Origin: the position, pulled into the vertex's own faces by 1e-3 of their size (a border or a crease
/// that lies exactly on another surface then sees that surface from its right side), and moved to a height
/// of 1e-4 of the shortest edge, or a millionth of the coordinates, over the planes of its own faces and of
/// all faces at its position that rise above them (the other side of a concave crease, touching objects).
/// In a corner of flat faces what is visible is the same at any distance from the corner, so the error is
/// that of the faces' curvature over 1e-3 of an edge.
///
/// A job, when given, can cancel it.
SampleSet samplesAtVertices(const Scene& scene, Job* job = nullptr);

/// One sample per texel of the charts; then one for the back of each texel of a two-sided object. Where the
/// texel's point lies on the rim of its triangle it is pulled inside by 1e-3, so that it sees neighbours that
/// fold towards it from their front. Geometric normal: the triangle's; shading normal: the interpolated one;
/// origin: off the surface by the least that rounding allows. Throws ValueError when the texels are of
/// another mesh.
SampleSet samplesAtTexels(const Scene& scene, const ChartTexels& texels, Job& job);

/// `count` points spread over the surface, density proportional to area, stratified; the same seed
/// gives the same points. Origins are moved off along the face's normal; the shading normal is the
/// interpolated one. Front sides only.
SampleSet samplesOnSurface(const Scene& scene, std::size_t count, std::uint64_t seed);

/// One random point in each of the triangles, which must have area; as samplesOnSurface() else. Throws
/// ValueError when an index is out of range.
SampleSet samplesInTriangles(const Scene& scene, std::span<const std::uint32_t> triangles,
                             std::uint64_t seed);

}  // namespace prt
