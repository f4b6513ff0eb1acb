#pragma once
// Wishes as they are painted: which part of the patch the brush takes, and what was painted, held in the
// recipe. Shown on the surface in the part's colour.

#include "ui/model/spot_editor.h"

namespace prt::ui {

class WishEditor : public SpotEditor {
  Q_OBJECT
 public:
  explicit WishEditor(Session& session, QObject* parent = nullptr);

  /// Of the recipe; while a drag goes on, as it would leave them.
  const std::vector<PatchWish>& wishes() const { return painting() ? dragged_ : wishes_; }
  /// The part of the patch that is painted: its middle, 0..1, and how far from there is still fine.
  const Vec2& place() const { return place_; }
  float extent() const { return extent_; }
  void setPart(const Vec2& place, float extent);
  static constexpr float kLeastExtent = 0.02f, kMostExtent = 0.5f;
  Rgb color() const override { return colorOfPart(place_); }
  void eraseAll();

 protected:
  std::vector<ShownSpot> spots() const override;
  void read() override;
  void startDrag() override { dragged_ = wishes_; }
  void paintAt(const std::vector<Vec3>& centres) override;
  void eraseAt(const Vec3& place) override { dragged_ = erasedAround(dragged_, place, radius()); }
  void finishDrag(bool takesAway) override;

 private:
  std::vector<PatchWish> wishes_, dragged_;
  Vec2 place_{0.5f};
  float extent_ = 0.15f;
};

}  // namespace prt::ui
