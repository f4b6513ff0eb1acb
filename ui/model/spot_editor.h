#pragma once
// What brushes that lay spots on the surface have in common: how wide the brush is, a drag from its first
// place to its last as one named step of undo, and spots shown on the model. What a spot means, and where in
// the recipe it is kept, is its heirs'.

#include "libprt/shade/pick.h"
#include "ui/model/painting.h"
#include "ui/model/surface_layers.h"
#include "ui/model/surface_spots.h"

#include <QObject>
#include <QString>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace prt::ui {

class Session;

class SpotEditor : public QObject {
  Q_OBJECT
 public:
  Brush brush() const { return brush_; }
  /// Relative to the diagonal of the bounding box.
  float width() const { return width_; }
  void setWidth(float width);
  static constexpr float kLeastWidth = 0.005f, kMostWidth = 0.3f;
  /// In the scene's unit.
  float radius() const;
  /// Of what the brush paints.
  virtual Rgb color() const = 0;
  /// Why the recipe's cannot be read; empty when all is well.
  const QString& error() const { return error_; }

  bool painting() const { return drag_.has_value(); }
  /// Nothing happens until the surface was read.
  void begin(const SurfaceHit& hit, bool takesAway);
  void goOn(const SurfaceHit& hit);
  void end();
  void drop();

  bool shown() const { return shown_; }
  void setShown(bool shown);
  /// What is shown is what the recipe asks for.
  bool settled() const;

 Q_SIGNALS:
  void changed();

 protected:
  struct ShownSpot {
    Vec3 centre;
    float radius;
    Rgb color;
  };
  SpotEditor(Session& session, Brush brush, MarkOwner owner, QObject* parent);
  Session& session() const { return session_; }

  /// There is something to paint with.
  virtual bool ready() const { return true; }
  /// All of them, as the drag would leave them.
  virtual std::vector<ShownSpot> spots() const = 0;
  /// Reads the recipe's. Throws Error.
  virtual void read() = 0;
  /// A drag begins from what the recipe has, and paints at these places, or erases around one.
  virtual void startDrag() = 0;
  virtual void paintAt(const std::vector<Vec3>& centres) = 0;
  virtual void eraseAt(const Vec3& place) = 0;
  /// Writes what it left into the recipe.
  virtual void finishDrag(bool takesAway) = 0;
  void follow();
  void tell();

 private:
  struct Drag {
    bool takesAway = false;
    SpotTrail trail;
  };
  /// Where a spot lies and how large it is.
  using SpotKey = std::array<float, 4>;
  using Shapes = std::map<SpotKey, std::vector<Vec3>>;
  static SpotKey keyOf(const Vec3& centre, float radius) { return {centre.x, centre.y, centre.z, radius}; }
  void show();
  void findShapes(std::vector<SpotKey> unknown);

  Session& session_;
  Brush brush_;
  MarkOwner owner_;
  QString error_;
  float width_ = 0.05f;
  std::optional<Drag> drag_;
  bool shown_ = false;
  std::shared_ptr<const PaintSurface> shapesOn_;
  Shapes shapes_;  // of spots on shapesOn_
  quint64 job_ = 0, run_ = 0;
};

}  // namespace prt::ui
