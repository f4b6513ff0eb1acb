#pragma once
// What light travels in: every object of the recipe, flattened into one mesh in the common object
// frame (the frame transfer is stored in), with the material of each triangle.

#include "libprt/material/material.h"
#include "libprt/mesh/mesh.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace prt {

struct SceneObject {
  std::string name;
  std::shared_ptr<const TriMesh> mesh;
  Mat4 transform{1.0f};  ///< mesh to scene; any invertible affine map, mirrored ones included
  Material material;
};

struct Scene {
  TriMesh mesh;                               ///< all objects, transformed, objects in order
  std::vector<std::uint32_t> triangleObject;  ///< [F] object of each triangle
  std::vector<std::uint32_t> vertexObject;    ///< [V] object of each vertex
  std::vector<Material> materials;            ///< [objects]
  std::vector<std::string> names;             ///< [objects]

  const Material& materialOf(std::uint32_t triangle) const { return materials[triangleObject[triangle]]; }
};

/// Objects may be empty: they keep their number. Throws GeometryError when there is no triangle at all, a
/// transform is singular or not finite, or the flattened mesh would exceed 2^31 vertices.
Scene flattenScene(std::span<const SceneObject> objects);

}  // namespace prt
