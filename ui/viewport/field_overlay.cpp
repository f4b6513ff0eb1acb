#include "ui/viewport/field_overlay.h"

#include "ui/model/field_editor.h"
#include "ui/model/session.h"
#include "ui/widgets/distances.h"
#include "ui/widgets/theme.h"

#include <QPainter>

namespace prt::ui {

namespace {

constexpr double kFaint = 0.22;                     // opacity of what the model hides
constexpr float kLift = 3e-3f;                      // of the distance to the eye, towards it
constexpr double kArrow = 11, kArrowDistance = 72;  // pixels
constexpr double kDot = 9;                          // radius
const QColor kForwards(0xd9, 0x5f, 0x4a), kBackwards(0x4a, 0x86, 0xd9);  // indices above and below 0

void paintArrow(QPainter& painter, const QPointF& tip, const QPointF& along, const QColor& color) {
  const QPointF across(-along.y(), along.x());
  painter.setPen(QPen(QColor(0, 0, 0, 160), 1));
  painter.setBrush(color);
  painter.drawPolygon(QPolygonF({tip, tip - kArrow * along + 0.5 * kArrow * across,
                                 tip - 0.7 * kArrow * along, tip - kArrow * along - 0.5 * kArrow * across}));
}

}  // namespace

bool hiddenBySurface(const Vec3& point, const ViewGeometry& view, const SceneRays& rays) {
  const Vec3 eye = view.sightTo(point).origin;
  return rays.blocked(eye, point + kLift * (eye - point));
}

void paintStroke(QPainter& painter, const ViewGeometry& view, const SceneRays& rays,
                 const std::vector<Vec3>& points, const QColor& color) {
  double since = kArrowDistance / 2;  // pixels since the last arrow
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto from = view.project(points[i - 1]), to = view.project(points[i]);
    if (!from || !to) continue;
    painter.setOpacity(hiddenBySurface(0.5f * (points[i - 1] + points[i]), view, rays) ? kFaint : 1);
    painter.setPen(QPen(QColor(0, 0, 0, 170), 5.5, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(*from, *to);
    painter.setPen(QPen(color, 3, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(*from, *to);
    const double length = distance(*from, *to);
    since += length;
    const bool last = i + 1 == points.size();
    if (length < 0.5 || (!last && since < kArrowDistance)) continue;
    paintArrow(painter, last ? *to : 0.5 * (*from + *to), (*to - *from) / length, color);
    since = 0;
  }
}

void paintField(QPainter& painter, const ViewGeometry& view, Session& session) {
  FieldEditor& editor = session.field();
  if (!editor.shown()) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = pictureTheme();
  for (int i = 0; i < int(editor.strokes().size()); ++i)
    paintStroke(painter, view, session.rays(), editor.strokes()[std::size_t(i)].points,
                i == editor.selected() ? t.text : t.accent);
  if (editor.drawing()) paintStroke(painter, view, session.rays(), editor.drawn(), t.accent);
  QFont font = painter.font();
  font.setBold(true);
  font.setPixelSize(11);
  painter.setFont(font);
  for (const FieldKnot& knot : editor.knots()) {
    const auto at = view.project(knot.position);
    if (!at) continue;
    painter.setOpacity(hiddenBySurface(knot.position, view, session.rays()) ? kFaint : 1);
    painter.setPen(QPen(QColor(0, 0, 0, 180), 1.5));
    painter.setBrush(knot.index > 0 ? kForwards : kBackwards);
    painter.drawEllipse(*at, kDot, kDot);
    painter.setPen(Qt::white);
    painter.drawText(QRectF(at->x() - 12, at->y() - 9, 24, 18), Qt::AlignCenter,
                     QStringLiteral("%1%2")
                         .arg(knot.index > 0 ? QStringLiteral("+") : QStringLiteral("\u2212"))
                         .arg(std::abs(knot.index)));
  }
  painter.restore();
}

}  // namespace prt::ui
