#include "ui/viewport/spot_brush.h"

#include "ui/model/layer_editor.h"
#include "ui/model/session.h"
#include "ui/model/wish_editor.h"
#include "ui/widgets/theme.h"

#include <QPainter>

#include <utility>

namespace prt::ui {

namespace {
constexpr float kWider = 1.2f;  // a press of a key
}  // namespace

SpotBrush::SpotBrush(SpotEditor& spots, Painting& painting, Pick pick, Words words, QObject* parent)
    : SurfaceBrush(painting, spots.brush(), std::move(pick), parent),
      spots_(spots),
      words_(std::move(words)) {
  connect(&spots_, &SpotEditor::changed, this, &Manipulator::changed);
}

void SpotBrush::paint(QPainter& painter, const ViewGeometry& view) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const Rgb c = spots_.color();
  paintRing(painter, view, spots_.radius(),
            takesAway() ? pictureTheme().failed : QColor::fromRgbF(c.x, c.y, c.z).lighter(130));
  painter.restore();
}

bool SpotBrush::keyPress(int key) {
  if (key == Qt::Key_BracketLeft || key == Qt::Key_BracketRight) {
    spots_.setWidth(spots_.width() * (key == Qt::Key_BracketRight ? kWider : 1 / kWider));
    return true;
  }
  return SurfaceBrush::keyPress(key);
}

QString SpotBrush::hint() const {
  if (!painting().on()) return tr("Reading the surface\u2026");
  if (down())
    return tr("%1   \u00b7   Esc drops it")
        .arg(takesAway() ? tr("Erases %1").arg(words_.erases) : words_.painting);
  return tr("%1   \u00b7   Ctrl erases   \u00b7   [ ] width   \u00b7   Esc leaves").arg(words_.idle);
}

QList<Binding> SpotBrush::bindings() const {
  return {{tr("%1, then drag").arg(words_.key), words_.paints},
          {tr("Ctrl drag"), tr("while painting %1: erase them").arg(words_.erases)},
          {tr("[ and ]"), tr("while painting %1: a narrower and a wider brush").arg(words_.erases)}};
}

SpotBrush* wishBrush(Session& session, SurfaceBrush::Pick pick) {
  return new SpotBrush(
      session.wishes(), session.painting(), std::move(pick),
      {SpotBrush::tr("W"), SpotBrush::tr("paint where the picked part of the patch is wished for"),
       SpotBrush::tr("This part of the surface takes the picked part of the patch"), SpotBrush::tr("wishes"),
       SpotBrush::tr("Drag paints the picked part of the patch")});
}

SpotBrush* layerBrush(Session& session, SurfaceBrush::Pick pick) {
  return new SpotBrush(
      session.patchLayers(), session.painting(), std::move(pick),
      {SpotBrush::tr("P"), SpotBrush::tr("paint where the selected layer covers what is below"),
       SpotBrush::tr("The layer covers this part of the surface"), SpotBrush::tr("layers"),
       SpotBrush::tr("Drag paints the selected layer")});
}

}  // namespace prt::ui
