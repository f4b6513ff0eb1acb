#include "ui/viewport/wish_brush.h"

#include "ui/widgets/theme.h"

#include <QPainter>

#include <utility>

namespace prt::ui {

namespace {
constexpr float kWider = 1.2f;  // a press of a key
}  // namespace

WishBrush::WishBrush(WishEditor& wishes, Painting& painting, Pick pick, QObject* parent)
    : SurfaceBrush(painting, Brush::Wishes, std::move(pick), parent), wishes_(wishes) {
  connect(&wishes_, &WishEditor::changed, this, &Manipulator::changed);
}

void WishBrush::paint(QPainter& painter, const ViewGeometry& view) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const Rgb c = colorOfPart(wishes_.place());
  paintRing(painter, view, wishes_.radius(),
            takesAway() ? pictureTheme().failed : QColor::fromRgbF(c.x, c.y, c.z).lighter(130));
  painter.restore();
}

bool WishBrush::keyPress(int key) {
  if (key == Qt::Key_BracketLeft || key == Qt::Key_BracketRight) {
    wishes_.setWidth(wishes_.width() * (key == Qt::Key_BracketRight ? kWider : 1 / kWider));
    return true;
  }
  return SurfaceBrush::keyPress(key);
}

QString WishBrush::hint() const {
  if (!painting().on()) return tr("Reading the surface\u2026");
  if (down())
    return takesAway()
               ? tr("Erases wishes   \u00b7   Esc drops it")
               : tr("This part of the surface takes the picked part of the patch   \u00b7   Esc drops it");
  return tr(
      "Drag paints the picked part of the patch   \u00b7   Ctrl erases   \u00b7   [ ] width   \u00b7   Esc "
      "leaves");
}

QList<Binding> WishBrush::bindings() const {
  return {{tr("W, then drag"), tr("paint where the picked part of the patch is wished for")},
          {tr("Ctrl drag"), tr("while painting wishes: erase them")},
          {tr("[ and ]"), tr("while painting wishes: a narrower and a wider brush")}};
}

}  // namespace prt::ui
