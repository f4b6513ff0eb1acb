#pragma once
// A patch of meso-structure: one period of a surface that repeats along u and v. Lengths are relative to the
// patch's width: x = u, y = v, and z is the height, outwards; the patch frame's tangent is +u. Bi-scale
// Radiance Transfer, section 4.2. A patch is a plain value; immutable once shared.
//
// Triangles that cross the border of the unit cell stick out of it: their vertices are repeated a period
// away. So the mesh alone is a picture of the patch, and copies of it side by side close up.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/mesh/mesh.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace prt {

/// A picture over the unit cell, repeated: bilinear between pixel centres; null = 1 everywhere. The image's
/// top row is v = 1.
using PatchTexture = std::shared_ptr<const Image>;
Rgb lookUp(const PatchTexture& texture, const Vec2& uv);

struct Patch {
  TriMesh mesh;             ///< positions as above; normals for shading
  std::vector<Rgb> albedo;  ///< [V] diffuse reflectance, times albedoTexture
  PatchTexture albedoTexture;
  Rgb specular{0};  ///< reflectance of a Phong lobe, times glossTexture; 0 = matte
  PatchTexture glossTexture;
  float exponent = 32;      ///< of that lobe, 1 .. 10 000
  float low = 0, high = 0;  ///< heights of the surface, its backing left out
  bool backed = false;      ///< a plane closes it from below
  /// [V] for each vertex the first one that is the same point of the torus with the same normal: itself, or
  /// one that lies in the same place or a whole number of periods away.
  std::vector<std::uint32_t> twin;

  /// Height of the plane that texels and views refer to: midway in depth.
  float middle() const { return 0.5f * (low + high); }
  float depth() const { return high - low; }
  bool glossy() const { return luminance(specular) > 0; }
  /// Diffuse reflectance at a place of a triangle.
  Rgb albedoAt(std::uint32_t triangle, const Vec2& barycentric) const;
  Vec3 positionAt(std::uint32_t triangle, const Vec2& barycentric) const;
};

/// Makes a patch of triangles that repeat with period 1 along x and y: finds twins, makes smooth normals
/// where `mesh` has none, measures the depth. `albedo` holds one colour per vertex, or one for all. Throws
/// GeometryError when there is no triangle, something is not finite, or the surface sticks out of the unit
/// cell by more than half a period. A job, when
/// given, can cancel it.
Patch makePatch(TriMesh mesh, std::vector<Rgb> albedo, Job* job = nullptr);

/// Adds an opaque plane `gap` below the surface, as a grid of cells x cells: what shows through gaps.
void addBacking(Patch& patch, float gap, int cells, const Rgb& albedo);

/// What stands against the assumption that a patch is thin (or nothing): one line for people. Between two
/// neighbouring views at 45 degrees the surface's highest and lowest points move against each other by
/// depth * 2 * (angle between the views); beyond an eighth of the width views no longer blend.
std::string thinPatchWarning(const Patch& patch, int viewsPerSide);

/// The patch moved by (u, v) on the torus, its textures with it: what was at (0, 0) is then at (u, v).
Patch shifted(const Patch& patch, const Vec2& by);
/// The patch turned a quarter counter-clockwise about +z, seen from above: what was at (u, v) is at (-v, u).
Patch quarterTurned(const Patch& patch);

}  // namespace prt
