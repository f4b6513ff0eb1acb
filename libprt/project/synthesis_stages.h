#pragma once
// The stages that lay the patch over the scene: the direction field, the synthesis on the meso mesh, and the
// id map over the atlas.

#include "libprt/project/patch_stages.h"
#include "libprt/project/stages.h"
#include "libprt/synthesis/id_map.h"
#include "libprt/synthesis/layer_masks.h"
#include "libprt/synthesis/orientation_field.h"
#include "libprt/synthesis/texture_synthesis.h"

#include <memory>
#include <string>
#include <vector>

namespace prt {

/// Stage "field". Empty where no patch is grown over the surface.
struct FieldProduct : Product {
  std::shared_ptr<const OrientationField> field;
  ProductData save() const override { return {}; }
};

/// Stage "synthesis": a meso mesh and the patch coordinates of its vertices. A preview holds the first levels
/// of the mesh, which cover the surface more coarsely. Objects that carry no patch have no vertices. Empty
/// where no patch is grown, or no object carries it.
struct SynthesisProduct : Product {
  std::shared_ptr<const MesoMesh> meso;
  std::shared_ptr<const std::vector<Vec2>> coordinates;  ///< [M] in [0, 1)^2
  double patchWidth = 0;                                 ///< in the scene's unit
  SynthesisQuality quality;                              ///< charts are not told apart; all 0 for previews

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// Stage "idmap". Empty where the synthesis is.
struct IdMapProduct : Product {
  std::shared_ptr<const IdMap> map;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

ProductPtr makeFieldStage(StageRun& run);
ProductPtr makeSynthesisStage(StageRun& run);
ProductPtr makeIdMapStage(StageRun& run);

/// 1, 2 or 4.
int symmetryOf(const FieldRecipe& field);
/// Numbers of the objects that carry no patch, which synthesis depends on; empty when all carry it.
std::string plainObjectsText(const Recipe& recipe);
/// What the recipe asks of the field, strokes read.
FieldOptions fieldOptionsOf(const FieldRecipe& field);
/// Vertices of the meso mesh that the recipe asks for.
std::size_t mesoVerticesOf(const SynthesisRecipe& synthesis, const Surface& surface, double patchWidth,
                           int texels);
/// The exemplars of a surface, and what of each vertex each of them shows; no weights where there is one.
struct SurfaceExemplars {
  std::vector<Exemplar> exemplars;
  std::vector<float> weights;

  PatchExemplars all() const { return {exemplars, weights}; }
};
/// As the stage makes them, of the patch and of the layers that `recipe`, resolved, has. Throws ValueError
/// when `layers` has not as many.
SurfaceExemplars exemplarsFor(const Rtt& rtt, const LayersProduct* layers, const Recipe& recipe,
                              const MesoMesh& meso, double patchWidth, Job& job);

/// The quality once more, with charts told apart (`chartOf` of each triangle; may be empty). Takes seconds.
SynthesisQuality qualityOf(const SynthesisProduct& product, const TriMesh& mesh, const TangentFrames& frames,
                           const Rtt& rtt, const LayersProduct* layers, const Recipe& recipe,
                           std::span<const std::uint32_t> chartOf, Job& job);

/// Strokes as `field.strokes` has them: points "x,y,z" parted by blanks, strokes parted by ';'. Throws
/// ValueError when the text is not of that form or a stroke has fewer than two points.
std::vector<FieldStroke> parseStrokes(const std::string& text);
std::string strokesToText(const std::vector<FieldStroke>& strokes);
/// Wishes as `synthesis.wishes` has them: "x,y,z radius u,v extent" parted by ';'. Throws ValueError.
std::vector<PatchWish> parseWishes(const std::string& text);
std::string wishesToText(const std::vector<PatchWish>& wishes);
/// Spots as `layers[].spots` has them: "x,y,z radius strength" parted by ';'. Throws ValueError.
std::vector<LayerSpot> parseSpots(const std::string& text);
std::string spotsToText(const std::vector<LayerSpot>& spots);

}  // namespace prt
