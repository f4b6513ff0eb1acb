#pragma once
// Draws strokes on the surface that the orientation field follows. What is drawn is the field editor's.

#include "ui/model/field_editor.h"
#include "ui/viewport/surface_brush.h"

namespace prt::ui {

class StrokeBrush : public SurfaceBrush {
  Q_OBJECT
 public:
  StrokeBrush(FieldEditor& field, Painting& painting, Pick pick, QObject* parent = nullptr);

  void paint(QPainter& painter, const ViewGeometry& view) override;
  bool keyPress(int key) override;
  QString hint() const override;
  QList<Binding> bindings() const override;

 protected:
  void begin(const SurfaceHit& hit, bool takesAway) override;
  void goOn(const SurfaceHit& hit) override;
  void finish() override;
  void drop() override { field_.drop(); }
  void click(const QPointF& at, const ViewGeometry& view) override;
  void hovered(const ViewGeometry& view) override;

 private:
  /// -1: none is near.
  int strokeAt(const QPointF& at, const ViewGeometry& view) const;

  FieldEditor& field_;
  int near_ = -1;  // the stroke under the pointer
};

}  // namespace prt::ui
