#pragma once
// Wishes as they are painted: which part of the patch the brush takes, how wide it is, and what was painted,
// held in the recipe, one named step of undo for each drag. Shown on the surface in the part's colour.

#include "libprt/shade/pick.h"
#include "ui/model/wish_spots.h"

#include <QObject>
#include <QString>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace prt::ui {

class Session;

class WishEditor : public QObject {
  Q_OBJECT
 public:
  explicit WishEditor(Session& session, QObject* parent = nullptr);

  /// Of the recipe; while a drag goes on, as it would leave them.
  const std::vector<PatchWish>& wishes() const { return drag_ ? dragged_ : wishes_; }
  /// Why they cannot be read; empty when all is well.
  const QString& error() const { return error_; }

  // ---- the brush ----
  /// The part of the patch that is painted: its middle, 0..1, and how far from there is still fine.
  const Vec2& place() const { return place_; }
  float extent() const { return extent_; }
  void setPart(const Vec2& place, float extent);
  static constexpr float kLeastExtent = 0.02f, kMostExtent = 0.5f;
  /// Relative to the diagonal of the bounding box.
  float width() const { return width_; }
  void setWidth(float width);
  static constexpr float kLeastWidth = 0.005f, kMostWidth = 0.3f;
  /// In the scene's unit.
  float radius() const;

  // ---- painting ----
  bool painting() const { return drag_.has_value(); }
  /// Nothing happens until the surface was read.
  void begin(const SurfaceHit& hit, bool takesAway);
  void goOn(const SurfaceHit& hit);
  void end();
  void drop();
  void eraseAll();

  bool shown() const { return shown_; }
  void setShown(bool shown);
  /// What is shown is what the recipe asks for.
  bool settled() const;

 Q_SIGNALS:
  void changed();

 private:
  struct Drag {
    bool takesAway = false;
    WishTrail trail;
  };
  /// Where a spot lies and how large it is.
  using SpotKey = std::array<float, 4>;
  using Shapes = std::map<SpotKey, std::vector<Vec3>>;
  static SpotKey keyOf(const PatchWish& wish) {
    return {wish.centre.x, wish.centre.y, wish.centre.z, wish.radius};
  }
  void follow();
  void show();
  void findShapes(std::vector<PatchWish> unknown);

  Session& session_;
  std::vector<PatchWish> wishes_, dragged_;
  QString error_;
  Vec2 place_{0.5f};
  float extent_ = 0.15f, width_ = 0.05f;
  std::optional<Drag> drag_;
  bool shown_ = false;
  std::shared_ptr<const PaintSurface> shapesOn_;
  Shapes shapes_;  // of spots on shapesOn_
  quint64 job_ = 0, run_ = 0;
};

}  // namespace prt::ui
