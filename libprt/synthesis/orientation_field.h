#pragma once
// The orientation field: a direction at every point of a surface, as smooth as can be, along which patches
// are laid. It is the tangent that transfer, radiance transfer texture and id map share (DESIGN,
// conventions).
//
// Directions are known up to turns by 2 pi / N, N = 1, 2 or 4 by the symmetry of the patch, and are
// represented by z = e^{i N angle} at the vertices, transported along edges by the surface's own connection
// (Knoeppel, Crane, Pinkall, Schroeder 2013, "Globally Optimal Direction Fields"): the smoothest field is the
// eigenvector of the least eigenvalue of a sparse Hermitian matrix, and one that follows strokes solves a
// system with it. It lies here and not in mesh/ because the solver is that of atlas/.
//
// Where a field must turn, it has singularities; their indices add up to N times the Euler characteristic.

#include "libprt/atlas/surface.h"
#include "libprt/mesh/tangent_frames.h"
#include "libprt/synthesis/surface_point.h"

#include <vector>

namespace prt {

/// A line drawn on the surface: the field runs along it, from the first point to the last.
struct FieldStroke {
  std::vector<Vec3> points;  ///< at least two, on the surface or near it
};

struct FieldOptions {
  int symmetry = 1;  ///< N: 1, 2 or 4
  /// Without strokes on a piece of the surface: turn against the general course, which is eastwards on a
  /// globe (about +Y), in radians, counter-clockwise seen from outside.
  double angle = 0;
  std::vector<FieldStroke> strokes = {};
  double strokeWidth = 0.02;  ///< of the band that follows a stroke, relative to the bounding box's diagonal
};

/// The field winds around this triangle.
struct FieldSingularity {
  std::uint32_t triangle = 0;
  int index = 0;  ///< turns of the field there, in units of 1/N
};

struct OrientationField {
  int symmetry = 1;
  /// [3F], one of the N directions at each corner, unit and at a right angle to the shading normal; the three
  /// of a triangle are the same branch. Corners that share a vertex of the mesh share the direction, but for
  /// its branch where N > 1.
  TangentFrames frames;
  std::vector<FieldSingularity> singularities;  ///< by triangle
};

/// `surface` is made of `mesh`. Strokes act on vertices within their width whose normal is within 90 degrees
/// of that of the vertex nearest to the stroke there, and on coarse meshes on those that they pass nearest
/// to. Deterministic. Throws ValueError for options out of range, Cancelled.
OrientationField makeOrientationField(const TriMesh& mesh, const Surface& surface,
                                      const FieldOptions& options, Job& job);

/// The tangent at a point of a triangle, unit, at a right angle to `normal`.
Vec3 tangentAt(const TangentFrames& frames, std::uint32_t triangle, const Vec2& barycentric,
               const Vec3& normal);

}  // namespace prt
