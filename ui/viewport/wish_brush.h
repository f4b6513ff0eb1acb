#pragma once
// Paints wishes on the surface: what is painted takes the part of the patch that was picked. What is painted
// is the wish editor's.

#include "ui/model/wish_editor.h"
#include "ui/viewport/surface_brush.h"

namespace prt::ui {

class WishBrush : public SurfaceBrush {
  Q_OBJECT
 public:
  WishBrush(WishEditor& wishes, Painting& painting, Pick pick, QObject* parent = nullptr);

  void paint(QPainter& painter, const ViewGeometry& view) override;
  bool keyPress(int key) override;
  QString hint() const override;
  QList<Binding> bindings() const override;

 protected:
  void begin(const SurfaceHit& hit, bool takesAway) override { wishes_.begin(hit, takesAway); }
  void goOn(const SurfaceHit& hit) override { wishes_.goOn(hit); }
  void finish() override { wishes_.end(); }
  void drop() override { wishes_.drop(); }
  void click(const QPointF&, const ViewGeometry&) override { wishes_.end(); }

 private:
  WishEditor& wishes_;
};

}  // namespace prt::ui
