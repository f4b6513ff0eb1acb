#pragma once
// Grids and surfaces of revolution, the two patterns that most generated shapes are made of.

#include "libprt/mesh/mesh.h"

#include <functional>
#include <span>

namespace prt {

using DVec2 = glm::dvec2;

struct GridPoint {
  Vec3 position;
  Vec3 normal;
  Vec2 uv;
};

/// Appends (columns + 1) * (rows + 1) vertices and two triangles per cell; `point` takes (s, t) in -1..1,
/// s to the right and t up as seen from the front. Both are exactly symmetric about 0, so that grids which
/// meet along an edge from opposite ends share its positions. The diagonals alternate.
void appendGrid(TriMesh& mesh, int columns, int rows,
                const std::function<GridPoint(float s, float t)>& point);

/// A point (radius, height) of a profile, the outward unit normal there in the same plane, and the
/// texture coordinate v. A radius of exactly 0 makes a pole.
struct ProfilePoint {
  DVec2 point;
  DVec2 normal;
  double v;
};

/// Turns a profile about the Y axis. The profile runs so that the outside is on its right (upwards for an
/// outer wall). It may start and end in poles or, when its ends coincide, close on itself.
/// UV: u around, 0 at +Z and growing towards +X; the seam splits UVs only, not vertices.
TriMesh revolve(std::span<const ProfilePoint> profile, int segments);

}  // namespace prt
