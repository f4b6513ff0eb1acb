#pragma once
// The products of the stages, as the types that renderers and exports use.

#include "libprt/mesh/defect_list.h"
#include "libprt/mesh/mesh.h"
#include "libprt/mesh/tangent_frames.h"
#include "libprt/project/product.h"
#include "libprt/project/recipe.h"
#include "libprt/transport/interpolation_floor.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"
#include "libprt/transport/transfer_bake.h"

#include <memory>
#include <string>
#include <vector>

namespace prt {

/// Stage "mesh": the repaired mesh of each object, in its own frame.
struct MeshProduct : Product {
  std::vector<std::shared_ptr<const TriMesh>> meshes;  ///< [objects]
  std::vector<std::string> reports;  ///< [objects] what was repaired, as JSON; "{}" for built-in meshes
  /// [objects] what was wrong with the file, what became of it, and where on the mesh it is; empty for
  /// built-in meshes.
  std::vector<std::vector<DefectLine>> defects;

  /// What was repaired in one object, in words.
  std::string repairText(std::size_t object) const;
  /// What the mesh is made of, in words; empty for built-in meshes.
  std::string factsText(std::size_t object) const;
  /// What the reader left out or took to mean something, one line each.
  std::vector<std::string> notes(std::size_t object) const;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// Stage "scene": all objects in the common frame. Of the materials only twoSided is the recipe's:
/// geometry alone decides what is visible. See withMaterials().
struct SceneProduct : Product {
  explicit SceneProduct(Scene s) : scene(std::make_shared<Scene>(std::move(s))) {}
  std::shared_ptr<const Scene> scene;
  ProductData save() const override { return {}; }
};

/// Stage "samples": one per vertex, and one on the back of each vertex of a two-sided object.
struct SamplesProduct : Product {
  explicit SamplesProduct(SampleSet s) : samples(std::make_shared<SampleSet>(std::move(s))) {}
  std::shared_ptr<const SampleSet> samples;
  ProductData save() const override { return {}; }
};

/// Stage "rays".
struct RaysProduct : Product {
  explicit RaysProduct(const Scene& scene) : rays(std::make_shared<RayScene>(scene)) {}
  std::shared_ptr<const RayScene> rays;
  ProductData save() const override { return {}; }
};

/// Stage "frames": tangents that turn transferred radiance into local frames.
struct FramesProduct : Product {
  explicit FramesProduct(TangentFrames f) : frames(std::move(f)) {}
  TangentFrames frames;
  ProductData save() const override { return {}; }
};

/// Stage "direct". Empty for the form None.
struct DirectProduct : Product {
  DirectProduct() = default;
  explicit DirectProduct(DirectTransfer d) : direct(std::move(d)) {}
  DirectTransfer direct;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// Stage "transfer": what pictures are made from.
struct TransferProduct : Product {
  explicit TransferProduct(Transfer t) : transfer(std::move(t)) {}
  Transfer transfer;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// Stage "floor": how exact pictures of this bake can be.
struct FloorProduct : Product {
  explicit FloorProduct(const InterpolationFloor& f) : floor(f) {}
  InterpolationFloor floor;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// The scene with the materials and names that the recipe has now. Throws ValueError when the recipe has
/// another number of objects than the scene.
Scene withMaterials(Scene scene, const Recipe& recipe);

}  // namespace prt
