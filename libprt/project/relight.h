#pragma once
// From a baked project to a picture: the one way that the command line, the studio and the demo share.

#include "libprt/core/image.h"
#include "libprt/light/light_rig.h"
#include "libprt/project/captured_objects.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"
#include "libprt/shade/biscale_view.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/render.h"

#include <memory>
#include <string>

namespace prt {

/// What pictures need of a project. Immutable; cheap to copy but for the materials.
struct BakedScene {
  std::shared_ptr<const SceneProduct> geometry;
  std::shared_ptr<const SamplesProduct> samples;
  std::shared_ptr<const TransferProduct> transfer;
  std::shared_ptr<const BiscaleSurface> patch;  ///< on the surface; null: there is none
  int level = 0;                                ///< of the transfer: passes done
  int levels = 0;                               ///< and wanted; a preview when level < levels
  Surroundings surroundings = {};               ///< captured objects, not lit

  bool final() const { return level >= levels; }
  /// Of all that is seen.
  Box3 bounds() const;
};

/// What a run of the pipeline made, without patch and surroundings. Throws ValueError when transfer is not
/// among it.
BakedScene bakedScene(const Products& products);
/// What a project holds for its recipe, previews included. Throws ValueError when it holds no transfer.
BakedScene bakedScene(Pipeline& pipeline, const Recipe& recipe, const std::string& project);

/// Throws ValueError when no patch is laid over the surface: pictures by method.name=biscale need one.
void expectPatch(const BakedScene& baked);

/// The light on a baked scene and its surroundings, in the bands of its transfer.
SceneLight sceneLight(const BakedScene& baked, const Recipe& recipe, const LightRig& lights, Job& job);

struct PictureOptions {
  int width = 800;
  int height = 600;
  int grid = 2;             ///< grid x grid samples per pixel
  bool background = false;  ///< show the environment behind the scene
};

/// A relit picture, by the method that the recipe names. Throws ValueError for biscale without a patch on the
/// surface. Float RGBA, linear radiance, alpha = coverage (1 with background).
Image relight(const BakedScene& baked, const Recipe& recipe, const LightRig& lights, const Camera& camera,
              const PictureOptions& options, Job& job);

/// The method of this name for shade/render.h. Throws ValueError for names that are none.
ShadeMethod shadeMethod(const std::string& name);

}  // namespace prt
