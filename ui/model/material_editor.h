#pragma once
// What the material dock does beside editing single values: presets, and keeping energy.

#include "ui/model/document.h"

#include <QObject>
#include <QString>

#include <vector>

namespace prt::ui {

/// A material to begin with, from resources/materials/presets.json.
struct MaterialPreset {
  QString name, about;
  Material material;
};
const std::vector<MaterialPreset>& materialPresets();

/// The largest channel of what a material reflects in all, at normal incidence: above 1 it gives more light
/// than it gets.
float reflectedShare(const Material& material);

class MaterialEditor : public QObject {
  Q_OBJECT
 public:
  explicit MaterialEditor(Document& document, QObject* parent = nullptr)
      : QObject(parent), document_(document) {}

  /// Null when the recipe has no such object.
  const Material* material(int object) const;
  /// Reflection as in the preset; name and sides stay the object's own.
  void apply(const MaterialPreset& preset, int object);
  /// The preset that the object's material is exactly; null when it is none.
  const MaterialPreset* presetOf(int object) const;
  /// Scales albedo and specular by one factor, so that no channel reflects more than it gets.
  void keepEnergy(int object);

 private:
  Document& document_;
};

}  // namespace prt::ui
