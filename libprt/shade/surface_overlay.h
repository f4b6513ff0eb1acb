#pragma once
// What is drawn over a picture of the surface: false colour per vertex, and layers of marks (points, edges,
// triangles) that show through what hides them. The CPU's version; gl/surface_overlay draws the same in
// OpenGL.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"
#include "libprt/shade/camera.h"

#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace prt {

/// Places on the surface, in the mesh's frame, all of one colour.
struct SurfaceMarks {
  std::vector<Vec3> points;
  std::vector<Vec3> edges;        ///< pairs of ends
  std::vector<Vec3> triangles;    ///< triples of corners
  Rgb color{1.0f, 0.31f, 0.16f};  ///< as the screen shows it
  float hidden = 0.3f;            ///< opacity of what lies behind the surface
  float size = 1;                 ///< of points and edges, relative to the sizes below
  float fill = 0.7f;              ///< opacity of triangles

  bool empty() const { return points.empty() && edges.empty() && triangles.empty(); }
  bool operator==(const SurfaceMarks&) const = default;
  /// Bounds of everything marked.
  Box3 bounds() const;
};

/// Colours laid on the surface triangle by triangle, and squares in texture space over them; or a picture in
/// texture space.
struct SurfacePaint {
  std::vector<Rgb> colors;  ///< [F] as the screen shows them
  std::vector<Vec2> uv;     ///< [3F] texture coordinates of each triangle's corners; empty: no squares
  float squares = 32;       ///< along a side of the texture; every other one is darker
  /// In place of colours and squares: RGB as the screen shows it, over the unit square of `uv`, v = 1 at the
  /// top; the texel at a place, not mixed with others. Null: none.
  std::shared_ptr<const Image> picture = {};
  SurfaceMarks seams;  ///< lines over it, under all other marks

  bool empty() const { return !covers() && seams.empty(); }
  /// Whether the surface itself is painted.
  bool covers() const { return picture || !colors.empty(); }
  /// Whether it can be laid on a surface of so many triangles.
  bool fits(std::size_t triangles) const;
};
/// Brightness of the darker squares.
inline constexpr float kDarkSquare = 0.55f;
/// Whether a place of the texture lies on a darker square.
inline bool onDarkSquare(const Vec2& uv, float squares) {
  return (int(std::floor(uv.x * squares)) + int(std::floor(uv.y * squares))) % 2 != 0;
}

struct OverlayPicture {
  Camera camera;
  int width = 0, height = 0;
  int grid = 2;          ///< grid x grid samples per pixel at the edges of the surface
  float pixelScale = 1;  ///< pixels of the picture per unit of the sizes below: high on dense screens
};

inline constexpr float kMarkRadius = 4.5f;      ///< of points, in units of pixelScale
inline constexpr float kMarkHalfWidth = 1.25f;  ///< of edges
inline constexpr float kMarkOutline = 1.0f;     ///< dark rim around both
/// A mark counts as hidden when it lies this share of its distance behind the surface.
inline constexpr float kMarkLift = 2e-3f;

/// `values`: [V] of 0..1 on the magnitude scale (color_map.h), empty to leave the surface as it is. Returns
/// float RGBA, premultiplied and display-encoded, to be laid over the picture. Throws ValueError when there
/// are values but not one for each vertex.
Image drawSurfaceOverlay(const TriMesh& mesh, std::span<const float> values, const SurfaceMarks& marks,
                         const OverlayPicture& picture, Job& job);
/// The same with paint, which takes the place of the values where it has colours, and several layers of
/// marks, the lowest first. Throws ValueError when there are colours but not one for each triangle, or
/// texture coordinates but not three.
Image drawSurfaceOverlay(const TriMesh& mesh, std::span<const float> values, const SurfacePaint& paint,
                         std::span<const SurfaceMarks> marks, const OverlayPicture& picture, Job& job);
/// Throws those errors.
void checkPaint(const SurfacePaint& paint, std::size_t triangles);

/// How false colour is shaded so that shapes stay legible: a factor from the cosine between normal and view.
constexpr float overlayShade(float cosine) {
  return 0.78f + 0.22f * (cosine < 0 ? -cosine : cosine);
}

}  // namespace prt
