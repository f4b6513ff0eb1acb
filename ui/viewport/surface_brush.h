#pragma once
// A brush on the surface: a press on the model begins, a drag goes over the surface without leaving gaps
// where the hand is fast, and a press that does not move is a click. What it does there is its heirs'.

#include "libprt/shade/pick.h"
#include "ui/model/painting.h"
#include "ui/viewport/manipulator.h"

#include <functional>

namespace prt::ui {

class SurfaceBrush : public Manipulator {
  Q_OBJECT
 public:
  using Pick = std::function<std::optional<SurfaceHit>(const QPointF&)>;

  /// It is enabled while it is the one in the hand.
  SurfaceBrush(Painting& painting, Brush brush, Pick pick, QObject* parent = nullptr);

  bool hover(std::optional<QPointF> at, const ViewGeometry& view) override;
  bool press(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) override;
  void move(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) override;
  void release(const QPointF& at, const ViewGeometry& view) override;
  void cancel() override;
  bool keyPress(int key) override;
  QCursor cursor() const override { return Qt::CrossCursor; }

 protected:
  /// The hand is down at a place of the surface; Ctrl takes away.
  virtual void begin(const SurfaceHit& hit, bool takesAway) = 0;
  virtual void goOn(const SurfaceHit& hit) = 0;
  virtual void finish() = 0;
  /// As if it had not begun.
  virtual void drop() = 0;
  /// Instead of finish(), where the hand did not move.
  virtual void click(const QPointF& at, const ViewGeometry& view) = 0;
  /// The pointer, or Ctrl, is elsewhere.
  virtual void hovered(const ViewGeometry&) {}

  /// What the pointer is over, seen from its front.
  const std::optional<SurfaceHit>& under() const { return under_; }
  std::optional<QPointF> pointer() const { return pointer_; }
  bool down() const { return last_.has_value(); }
  bool takesAway() const { return takesAway_; }
  Painting& painting() const { return painting_; }
  /// A ring around the pointer on the surface.
  void paintRing(QPainter& painter, const ViewGeometry& view, float radius, const QColor& color) const;

 private:
  std::optional<SurfaceHit> hitAt(const QPointF& at) const;

  Painting& painting_;
  Brush brush_;
  Pick pick_;
  std::optional<SurfaceHit> under_;
  std::optional<QPointF> pointer_, last_;
  QPointF pressedAt_;
  bool moved_ = false, takesAway_ = false;
};

}  // namespace prt::ui
