#pragma once
// Layers of patches: which one is worked on, here and in the Patch dock, and where each covers what is below
// it, painted on the model and held in the recipe.

#include "libprt/meso/patch_options.h"
#include "ui/model/spot_editor.h"

namespace prt {
struct Recipe;
}

namespace prt::ui {

/// The patch of a layer; LayerEditor::kPatch, or a layer that the recipe lacks: the one below.
const PatchOptions& patchOf(const Recipe& recipe, int layer);
PatchOptions& patchOf(Recipe& recipe, int layer);

class LayerEditor : public SpotEditor {
  Q_OBJECT
 public:
  explicit LayerEditor(Session& session, QObject* parent = nullptr);

  static constexpr int kPatch = -1;  ///< the patch below all layers
  int selected() const { return selected_; }
  void select(int layer);
  int count() const { return int(spots_.size()); }
  /// "patch", or "layers[1].patch": what the Patch dock edits.
  QString patchPath() const;

  bool canAdd() const;
  /// A new layer over all others, selected.
  void add();
  void remove(int layer);
  void rename(int layer, const QString& name);
  void eraseAll();

  /// Of the mask that the brush paints, 0..1.
  float strength() const { return strength_; }
  void setStrength(float strength);
  static constexpr float kLeastStrength = 0.05f;

  /// Of a layer; while a drag goes on, as it would leave them.
  const std::vector<LayerSpot>& spotsOf(int layer) const;
  Rgb color() const override { return colorOfLayer(selected_); }

 protected:
  bool ready() const override { return selected_ != kPatch; }
  std::vector<ShownSpot> spots() const override;
  void read() override;
  void startDrag() override { dragged_ = spots_[std::size_t(selected_)]; }
  void paintAt(const std::vector<Vec3>& centres) override;
  void eraseAt(const Vec3& place) override { dragged_ = erasedAround(dragged_, place, radius()); }
  void finishDrag(bool takesAway) override;

 private:
  void write(const QString& name, const std::vector<LayerSpot>& spots);

  std::vector<std::vector<LayerSpot>> spots_;
  std::vector<LayerSpot> dragged_;
  int selected_ = kPatch;
  float strength_ = 1;
};

}  // namespace prt::ui
