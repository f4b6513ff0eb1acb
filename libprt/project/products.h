#pragma once
// The products of the stages, as the types that renderers and exports use.

#include "libprt/mesh/mesh.h"
#include "libprt/project/product.h"
#include "libprt/project/recipe.h"
#include "libprt/transport/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace prt {

/// Stage "mesh": the repaired mesh of each object, in its own frame.
struct MeshProduct : Product {
  std::vector<std::shared_ptr<const TriMesh>> meshes;  ///< [objects]
  std::vector<std::string> reports;  ///< [objects] what was repaired, as JSON; "{}" for built-in meshes

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// Stage "scene": all objects in the common frame. Materials are the default ones: geometry alone decides
/// what is visible. See withMaterials().
struct SceneProduct : Product {
  Scene scene;
  ProductData save() const override;
};

/// The scene with the materials and names that the recipe has now. Throws ValueError when the recipe has
/// another number of objects than the scene.
Scene withMaterials(Scene scene, const Recipe& recipe);

}  // namespace prt
