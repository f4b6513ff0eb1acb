#include "ui/viewport/stroke_brush.h"

#include "ui/widgets/distances.h"
#include "ui/widgets/theme.h"

#include <QPainter>

#include <utility>

namespace prt::ui {

namespace {
constexpr double kCatch = 9;  // pixels from which a stroke is taken
}  // namespace

StrokeBrush::StrokeBrush(FieldEditor& field, Painting& painting, Pick pick, QObject* parent)
    : SurfaceBrush(painting, Brush::Strokes, std::move(pick), parent), field_(field) {
  connect(&field_, &FieldEditor::changed, this, [this] {
    if (near_ >= int(field_.strokes().size())) near_ = -1;
  });
}

void StrokeBrush::paint(QPainter& painter, const ViewGeometry& view) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = pictureTheme();
  if (near_ >= 0 && !down()) {
    QPolygonF line;
    for (const Vec3& p : field_.strokes()[std::size_t(near_)].points)
      if (const auto at = view.project(p)) line << *at;
    QColor glow = takesAway() ? t.failed : t.text;
    glow.setAlpha(120);
    painter.setPen(QPen(glow, 10, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
  }
  if (!takesAway()) paintRing(painter, view, field_.width(), t.accent);
  painter.restore();
}

int StrokeBrush::strokeAt(const QPointF& at, const ViewGeometry& view) const {
  int found = -1;
  double least = kCatch;
  for (std::size_t s = 0; s < field_.strokes().size(); ++s) {
    const auto& points = field_.strokes()[s].points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto a = view.project(points[i - 1]), b = view.project(points[i]);
      if (!a || !b) continue;
      if (const double d = distanceToPiece(at, *a, *b); d < least) least = d, found = int(s);
    }
  }
  return found;
}

void StrokeBrush::hovered(const ViewGeometry& view) {
  near_ = pointer() ? strokeAt(*pointer(), view) : -1;
}

void StrokeBrush::begin(const SurfaceHit& hit, bool takesAway) {
  if (!takesAway) field_.begin(hit);
}

void StrokeBrush::goOn(const SurfaceHit& hit) {
  if (!takesAway()) field_.extend(hit);
}

void StrokeBrush::finish() {
  if (!takesAway()) field_.end();
}

void StrokeBrush::click(const QPointF& at, const ViewGeometry& view) {
  const int stroke = strokeAt(at, view);
  field_.drop();
  if (takesAway())
    field_.erase(stroke);
  else
    field_.select(stroke);
  near_ = -1;
}

bool StrokeBrush::keyPress(int key) {
  if (key == Qt::Key_Delete || key == Qt::Key_Backspace) {
    if (field_.selected() < 0) return false;
    field_.erase(field_.selected());
    return true;
  }
  return SurfaceBrush::keyPress(key);
}

QString StrokeBrush::hint() const {
  if (!painting().on()) return tr("Reading the surface\u2026");
  if (down() && !takesAway()) return tr("The field follows this stroke   \u00b7   Esc drops it");
  if (near_ >= 0)
    return takesAway() ? tr("Click erases this stroke")
                       : tr("Click selects this stroke, Delete erases it   \u00b7   drag draws another one");
  return tr("Drag draws a stroke that the field follows   \u00b7   Ctrl click erases   \u00b7   Esc leaves");
}

QList<Binding> StrokeBrush::bindings() const {
  return {{tr("D, then drag"), tr("draw strokes on the model that the orientation field follows")},
          {tr("Click, Delete"), tr("while drawing strokes: select one, erase it")},
          {tr("Ctrl click on a stroke"), tr("while drawing strokes: erase it")}};
}

}  // namespace prt::ui
