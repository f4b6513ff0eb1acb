#pragma once
// Triangle meshes of implicit surfaces, for the generated shapes.

#include "libprt/mesh/mesh.h"

#include <functional>

namespace prt {

/// A scalar field, negative inside. Its length scale should be about that of a distance (gradient near
/// one), which keeps the projection steps below short.
using ScalarField = std::function<float(const Vec3&)>;

/// Triangulates the zero set of a field inside a box with surface nets (Gibson 1998): one vertex per
/// grid cell that the surface crosses, at the mean of its edge crossings, one quadrilateral per crossed
/// grid edge. The surface must stay clear of the box's border by a cell. Manifold as long as no cell
/// holds two sheets. Normals come from the field's gradient; no UVs.
TriMesh polygonise(const ScalarField& field, const Box3& box, float cellSize);

/// Evens out the triangles of a mesh of a field's zero set: each sweep flips edges towards the Delaunay
/// condition, moves vertices tangentially to the mean of their neighbours, and puts them back on the
/// surface. Topology is kept.
void relaxOnSurface(TriMesh& mesh, const ScalarField& field, float cellSize, int sweeps);

}  // namespace prt
