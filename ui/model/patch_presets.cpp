#include "ui/model/patch_presets.h"

#include "libprt/meso/patch_picture.h"
#include "ui/model/layer_editor.h"

namespace prt::ui {

namespace {

PatchPreset heights(const QString& name, const QString& about, const char* generator, float depth,
                    const Rgb& albedo) {
  PatchPreset preset{name, about, {}};
  preset.options.model = PatchModel::HeightField;
  preset.options.heightmap = std::string("builtin:") + generator;
  preset.options.depth = depth;
  preset.options.albedo = albedo;
  return preset;
}

std::vector<PatchPreset> makePresets() {
  PatchPreset weave{QObject::tr("Weave"), QObject::tr("Cloth of crossing yarns, as real geometry."), {}};
  weave.options.model = PatchModel::Weave;
  weave.options.albedo = Rgb(0.62f, 0.5f, 0.32f), weave.options.warp = Rgb(0.85f, 0.95f, 1);
  PatchPreset flower{QObject::tr("Flower"), QObject::tr("A flat patch with a colour texture."), {}};
  flower.options.model = PatchModel::Flat;
  flower.options.texture = "builtin:flower";
  flower.options.albedo = Rgb(0.9f);
  return {
      weave,
      heights(QObject::tr("Stucco"), QObject::tr("Rough plaster, noise on many scales."), "stucco", 0.1f,
              Rgb(0.7f, 0.66f, 0.6f)),
      heights(QObject::tr("Holes"), QObject::tr("Round holes in a plate."), "holes", 0.12f,
              Rgb(0.55f, 0.57f, 0.6f)),
      heights(QObject::tr("Bins"), QObject::tr("Square compartments."), "bins", 0.15f,
              Rgb(0.62f, 0.55f, 0.45f)),
      heights(QObject::tr("Scales"), QObject::tr("Overlapping scales, all one way."), "scales", 0.08f,
              Rgb(0.3f, 0.48f, 0.34f)),
      heights(QObject::tr("Ripples"), QObject::tr("Wind-blown sand."), "ripples", 0.1f,
              Rgb(0.72f, 0.6f, 0.42f)),
      flower,
  };
}

}  // namespace

const std::vector<PatchPreset>& patchPresets() {
  static const std::vector<PatchPreset> presets = makePresets();
  return presets;
}

int patchPresetOf(const PatchOptions& options) {
  for (std::size_t i = 0; i < patchPresets().size(); ++i) {
    PatchOptions other = patchPresets()[i].options;
    other.albedo = options.albedo, other.warp = options.warp, other.specular = options.specular;
    other.gloss = options.gloss, other.exponent = options.exponent;
    if (other == options) return int(i);
  }
  return -1;
}

void applyPatchPreset(const LayerEditor& layers, Document& document, const PatchPreset& preset) {
  Recipe next = document.recipe();
  PatchOptions& patch = patchOf(next, layers.selected());
  const PatchOptions before = patch;
  patch = preset.options;
  patch.specular = before.specular, patch.exponent = before.exponent;
  patch.gloss = before.gloss;
  document.edit(QObject::tr("Patch: %1").arg(preset.name.toLower()), next);
}

std::vector<Image> patchPictures(int pixels, Job& job) {
  std::vector<Image> pictures;
  for (const PatchPreset& preset : patchPresets()) {
    PatchOptions options = preset.options;
    options.grid = 96;
    const auto patch = std::make_shared<const Patch>(buildPatch(options, {}, job));
    PatchView view;
    view.elevation = 0.9f, view.samples = 3;
    pictures.push_back(patchPicture(makePatchRays(patch, job), view, pixels, pixels, job));
  }
  return pictures;
}

}  // namespace prt::ui
