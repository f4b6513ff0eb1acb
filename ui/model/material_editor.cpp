#include "ui/model/material_editor.h"

#include "libprt/core/error.h"
#include "libprt/project/recipe.h"

#include <nlohmann/json.hpp>

#include <QFile>

#include <algorithm>

namespace prt::ui {

namespace {

constexpr const char* kPresetsFile = ":/materials/presets.json";

// A preset's reflection is read as a recipe's, with all its checks.
MaterialPreset readPreset(nlohmann::json entry) {
  MaterialPreset preset;
  preset.name = QString::fromStdString(entry.at("name").get<std::string>());
  preset.about = QString::fromStdString(entry.at("about").get<std::string>());
  entry.erase("about");
  preset.material = recipeFromJson({{"material", entry}}, kPresetsFile).objects[0].material;
  return preset;
}

std::vector<MaterialPreset> readPresets() {
  QFile file{QString::fromLatin1(kPresetsFile)};
  if (!file.open(QIODevice::ReadOnly)) return {};
  std::vector<MaterialPreset> presets;
  for (const nlohmann::json& entry : nlohmann::json::parse(file.readAll().toStdString()))
    presets.push_back(readPreset(entry));
  return presets;
}

/// `to` with the reflection of `from`.
Material withReflection(Material to, const Material& from) {
  to.model = from.model;
  to.albedo = from.albedo;
  to.specular = from.specular;
  to.exponent = from.exponent;
  return to;
}

}  // namespace

const std::vector<MaterialPreset>& materialPresets() {
  static const std::vector<MaterialPreset> presets = readPresets();
  return presets;
}

float reflectedShare(const Material& material) {
  const Rgb all = material.albedo + (material.glossy() ? material.specular : Rgb(0));
  return std::max({all.x, all.y, all.z});
}

const Material* MaterialEditor::material(int object) const {
  const auto& objects = document_.recipe().objects;
  return object >= 0 && object < int(objects.size()) ? &objects[std::size_t(object)].material : nullptr;
}

void MaterialEditor::apply(const MaterialPreset& preset, int object) {
  if (!material(object)) return;
  Recipe next = document_.recipe();
  Material& changed = next.objects[std::size_t(object)].material;
  changed = withReflection(changed, preset.material);
  document_.edit(tr("Preset %1").arg(preset.name), next);
}

const MaterialPreset* MaterialEditor::presetOf(int object) const {
  const Material* now = material(object);
  if (!now) return nullptr;
  for (const MaterialPreset& preset : materialPresets())
    if (withReflection(*now, preset.material) == *now) return &preset;
  return nullptr;
}

void MaterialEditor::keepEnergy(int object) {
  if (!material(object) || reflectedShare(*material(object)) <= 1) return;
  Recipe next = document_.recipe();
  Material& changed = next.objects[std::size_t(object)].material;
  // A hair below, so that rounding leaves nothing to warn of.
  const float factor = (1 - 1e-6f) / reflectedShare(changed);
  changed.albedo *= factor;
  changed.specular *= factor;
  document_.edit(tr("Keep energy"), next);
}

}  // namespace prt::ui
