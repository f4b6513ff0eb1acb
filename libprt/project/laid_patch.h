#pragma once
// The patch on the surface, put together from products: what bi-scale pictures need beside transfer.

#include "libprt/project/pipeline.h"
#include "libprt/shade/biscale_view.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace prt {

/// The stages that laidPatch() reads for this recipe; empty when it lays no patch.
std::vector<std::string> stagesOfLaidPatch(const Recipe& recipe);

/// Those and the ones that bakedScene() reads: all that a picture of this recipe needs.
std::vector<std::string> stagesOfPicture(const Recipe& recipe);

/// Null when the recipe lays no patch, a product is missing or only a preview of a coarser mesh, or the scene
/// has not as many objects as the recipe. Objects with patch=false show their material as the recipe has it.
/// With method.filter its filter is made, which takes part of a second; Cancelled.
std::shared_ptr<const BiscaleSurface> laidPatch(const Products& products, const Recipe& recipe, Job& job);
std::shared_ptr<const BiscaleSurface> laidPatch(const Products& products, const Recipe& recipe);

/// The same surface with the plain objects and their materials as the recipe now has them, nothing else made
/// anew. Null when the scene has not as many objects as the recipe.
std::shared_ptr<const BiscaleSurface> withPlainObjects(std::shared_ptr<const BiscaleSurface> surface,
                                                       const Recipe& recipe);

/// What withPlainObjects() reads of the recipe: the materials of plain objects, nothing for the others.
std::vector<std::optional<Material>> plainMaterials(const Recipe& recipe);

/// Whether the patch, its layers and the objects beside it are flat and matte: what they show is irradiance.
bool isMattePlane(const Recipe& recipe);

/// Whether pictures of this recipe show the patch on the surface once it is laid: method.name is biscale.
bool showsPatch(const Recipe& recipe);

}  // namespace prt
