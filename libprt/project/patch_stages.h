#pragma once
// The stages of the meso scale: the patch that the recipe asks for and its radiance transfer texture.

#include "libprt/meso/patch.h"
#include "libprt/meso/patch_build.h"
#include "libprt/meso/view_error.h"
#include "libprt/project/stages.h"

#include <memory>
#include <optional>

namespace prt {

class Pipeline;

/// Stage "patch". Empty where the recipe asks for none, or for images of a real one.
struct PatchProduct : Product {
  std::shared_ptr<const Patch> patch;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// Stage "rtt". Empty without a patch.
struct RttProduct : Product {
  std::shared_ptr<const Rtt> rtt;  ///< values as they come out of the storage type
  RttStorage storage = RttStorage::Float;
  double storageError = 0;             ///< relative, of rounding to it
  std::optional<ViewError> viewError;  ///< of what was baked from a patch; none for imported images

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// Stage "layers": the tables of the layers over the patch, each as stage "rtt" makes its own.
struct LayersProduct : Product {
  std::vector<std::shared_ptr<const RttProduct>> tables;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

bool hasPatch(const Recipe& recipe);
/// Whether layers cover something of a patch that is grown over the surface.
bool hasLayers(const Recipe& recipe);
/// Whether a layer has a patch and is painted anywhere: recipes when resolved have no others.
bool isPainted(const LayerRecipe& layer);
ProductPtr makeLayersStage(StageRun& run);
ProductPtr makePatchStage(StageRun& run);
ProductPtr makeRttStage(StageRun& run);

/// Settings of the bake, from a resolved recipe.
RttSettings rttSettings(const Recipe& recipe);

/// Reads the files that a patch names, relative to `folder`. Throws FileError.
PatchSources loadPatchSources(const PatchOptions& options, const std::filesystem::path& folder, Job& job);

/// What a project holds for its recipe. Throws ValueError when it has no radiance transfer texture.
std::shared_ptr<const RttProduct> bakedRtt(Pipeline& pipeline, const Recipe& recipe,
                                           const std::string& project);

}  // namespace prt
