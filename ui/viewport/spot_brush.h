#pragma once
// Paints spots on the surface: parts of the patch that are wished for, or where a layer covers it. What is
// painted is the editor's.

#include "ui/model/spot_editor.h"
#include "ui/viewport/surface_brush.h"

namespace prt::ui {

class SpotBrush : public SurfaceBrush {
  Q_OBJECT
 public:
  /// What it says of itself.
  struct Words {
    QString key;               ///< that takes it: "W"
    QString paints;            ///< what a drag does: "paint where .. is wished for"
    QString painting, erases;  ///< while it is done, and what Ctrl erases: "wishes"
    QString idle;              ///< "Drag paints .."
  };
  SpotBrush(SpotEditor& spots, Painting& painting, Pick pick, Words words, QObject* parent = nullptr);

  void paint(QPainter& painter, const ViewGeometry& view) override;
  bool keyPress(int key) override;
  QString hint() const override;
  QList<Binding> bindings() const override;

 protected:
  void begin(const SurfaceHit& hit, bool takesAway) override { spots_.begin(hit, takesAway); }
  void goOn(const SurfaceHit& hit) override { spots_.goOn(hit); }
  void finish() override { spots_.end(); }
  void drop() override { spots_.drop(); }
  void click(const QPointF&, const ViewGeometry&) override { spots_.end(); }

 private:
  SpotEditor& spots_;
  Words words_;
};

/// The one for wishes, and the one for layers.
SpotBrush* wishBrush(Session& session, SurfaceBrush::Pick pick);
SpotBrush* layerBrush(Session& session, SurfaceBrush::Pick pick);

}  // namespace prt::ui
