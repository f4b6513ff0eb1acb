#include "ui/viewport/overlay.h"

#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr int kMargin = 12, kPadding = 8;
constexpr double kDial = 44;  // of compass and axes

struct Line {
  QString text;
  QColor color;
};

// Lines of text on a veil that keeps them legible on any picture; `corner` places the block.
void paintBlock(QPainter& painter, const QSize& size, Qt::Alignment corner, const std::vector<Line>& lines) {
  const QFontMetrics metrics = painter.fontMetrics();
  int width = 0;
  for (const Line& line : lines) width = std::max(width, metrics.horizontalAdvance(line.text));
  const int lineHeight = metrics.height() + 1;
  QRect box(0, 0, width + 2 * kPadding, int(lines.size()) * lineHeight + kPadding);
  box.moveLeft(corner & Qt::AlignRight ? size.width() - kMargin - box.width() : kMargin);
  box.moveTop(corner & Qt::AlignBottom ? size.height() - kMargin - box.height() : kMargin);
  painter.setPen(Qt::NoPen);
  painter.setBrush(pictureVeil());
  painter.drawRoundedRect(box, 4, 4);
  QRect row(box.left() + kPadding, box.top() + kPadding / 2, width, lineHeight);
  for (const Line& line : lines) {
    painter.setPen(line.color);
    painter.drawText(row, Qt::AlignVCenter | (corner & Qt::AlignRight ? Qt::AlignRight : Qt::AlignLeft),
                     line.text);
    row.translate(0, lineHeight);
  }
}

std::vector<Line> methodLines(const PictureStatus& s) {
  const Theme& t = pictureTheme();
  QString method =
      QObject::tr("%1 \u00b7 %2 bands, %3 functions").arg(s.method).arg(s.bands).arg(s.bands * s.bands);
  if (s.levels > 0 && s.bounces > 0)
    method +=
        s.bounces == 1 ? QObject::tr(" \u00b7 1 bounce") : QObject::tr(" \u00b7 %1 bounces").arg(s.bounces);
  std::vector<Line> lines{{method, t.text}};
  if (s.levels == 0)
    lines.push_back({QObject::tr("not baked yet: light without shadows"), t.stale});
  else if (s.level < s.levels)
    lines.push_back({QObject::tr("preview %1 of %2 \u00b7 %3 of %4 rays")
                         .arg(s.level)
                         .arg(s.levels)
                         .arg(s.rays)
                         .arg(s.raysWanted),
                     t.stale});
  else
    lines.push_back({QObject::tr("final \u00b7 %1 rays").arg(s.rays), t.muted});
  if (s.estimatedError)
    lines.push_back({QObject::tr("estimated error %1 %").arg(100 * *s.estimatedError, 0, 'f', 2), t.muted});
  return lines;
}

// Nothing to see yet: say what to do.
void paintEmpty(QPainter& painter, const QSize& size) {
  const Theme& t = pictureTheme();
  const QRect all(QPoint(0, 0), size);
  QFont big = painter.font();
  big.setPointSizeF(big.pointSizeF() * 1.6);
  painter.save();
  painter.setFont(big);
  painter.setPen(t.text);
  painter.drawText(all.adjusted(0, 0, 0, -48), Qt::AlignCenter, QObject::tr("Drop a mesh here"));
  painter.restore();
  painter.setPen(t.muted);
  painter.drawText(
      all.adjusted(0, 24, 0, 24), Qt::AlignCenter,
      QObject::tr(
          "OBJ, PLY, OFF, STL, glTF: its light transfer is baked at once, with a preview in a second.\n"
          "An HDR or EXR probe becomes the light. Or take a sample from File \u203a Samples."));
}

// Where the middle of the environment's map stands, seen from above with the viewer at the bottom.
void paintCompass(QPainter& painter, const QSize& size, Session& session) {
  const Theme& t = pictureTheme();
  const Camera& camera = session.view().camera();
  const Frame axes = camera.axes();
  const double angle = session.environmentAngle();
  const float turn = float(radians(angle));
  const Vec3 front(-std::sin(turn), 0, -std::cos(turn));
  const Vec3 level = std::abs(axes.normal.y) < 0.9f ? -axes.normal
                     : axes.normal.y > 0            ? axes.bitangent
                                                    : -axes.bitangent;
  const Vec3 ahead = normalize(Vec3(level.x, 0, level.z));
  const QPointF needle(dot(front, axes.tangent), -dot(front, ahead));

  const QRectF veil(kMargin, size.height() - kMargin - kDial - 26, kDial + 12, kDial + 26);
  const QRectF dial(veil.left() + 6, veil.top() + 6, kDial, kDial);
  painter.setPen(Qt::NoPen);
  painter.setBrush(pictureVeil());
  painter.drawRoundedRect(veil, 4, 4);
  painter.setPen(QPen(t.muted, 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(dial);
  painter.drawLine(QPointF(dial.center().x(), dial.bottom() - 3), QPointF(dial.center().x(), dial.bottom()));
  const QPointF tip = dial.center() + 0.42 * kDial * needle, across(-needle.y(), needle.x());
  painter.setPen(Qt::NoPen);
  painter.setBrush(t.accent);
  painter.drawPolygon(QPolygonF({tip, dial.center() + 4 * across, dial.center() - 4 * across}));
  painter.setPen(t.text);
  painter.drawText(dial.adjusted(-8, kDial + 2, 8, 18), Qt::AlignCenter,
                   QObject::tr("%1\u00b0").arg(std::lround(angle)));
}

// Directions of the world's axes, the nearest drawn last; `left`: where there is room.
void paintAxes(QPainter& painter, const QSize& size, double left, const Camera& camera) {
  const Frame axes = camera.axes();
  struct Axis {
    Vec3 direction;
    QColor color;
    QString name;
  };
  std::vector<Axis> all{{{1, 0, 0}, QColor(0xd9, 0x5f, 0x5f), QStringLiteral("x")},
                        {{0, 1, 0}, QColor(0x7f, 0xb3, 0x5c), QStringLiteral("y")},
                        {{0, 0, 1}, QColor(0x5f, 0x8f, 0xd9), QStringLiteral("z")}};
  std::sort(all.begin(), all.end(), [&](const Axis& a, const Axis& b) {
    return dot(a.direction, axes.normal) < dot(b.direction, axes.normal);
  });
  const QPointF middle(left + 0.5 * kDial, size.height() - kMargin - 0.5 * kDial);
  for (const Axis& axis : all) {
    const QPointF along(dot(axis.direction, axes.tangent), -dot(axis.direction, axes.bitangent));
    painter.setPen(QPen(pictureVeil(), 4, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(middle, middle + 0.42 * kDial * along);
    painter.setPen(QPen(axis.color, 2, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(middle, middle + 0.42 * kDial * along);
    const QPointF at = middle + 0.58 * kDial * along;
    painter.drawText(QRectF(at.x() - 8, at.y() - 8, 16, 16), Qt::AlignCenter, axis.name);
  }
}

// The corners of what the selected object's box covers; where there is but one object there is nothing to
// tell.
void paintSelection(QPainter& painter, const QSize& size, Session& session) {
  const Scene& scene = *session.relighter().scene();
  const Box3 box = session.objectBounds(session.selectedObject());
  if (scene.names.size() < 2 || box.empty()) return;
  QRectF covered;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                 corner & 4 ? box.high.z : box.low.z);
    const auto at = session.view().camera().project(p, size.width(), size.height());
    if (!at) return;
    const QRectF point(at->x - 0.5, at->y - 0.5, 1, 1);
    covered = covered.isNull() ? point : covered.united(point);
  }
  covered.adjust(-4, -4, 4, 4);
  const double arm = std::clamp(0.12 * std::min(covered.width(), covered.height()), 4.0, 14.0);
  for (const auto& [color, width] :
       {std::pair(QColor(0x14, 0x14, 0x14, 150), 3.0), std::pair(pictureTheme().accent, 1.25)}) {
    painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap));
    for (const double x : {covered.left(), covered.right()})
      for (const double y : {covered.top(), covered.bottom()}) {
        painter.drawLine(QPointF(x, y), QPointF(x == covered.left() ? x + arm : x - arm, y));
        painter.drawLine(QPointF(x, y), QPointF(x, y == covered.top() ? y + arm : y - arm));
      }
  }
}

}  // namespace

void paintOverlay(QPainter& painter, const QSize& size, Session& session, const Canvas* canvas) {
  painter.setRenderHint(QPainter::Antialiasing);
  if (!session.relighter().scene()) {
    if (session.opening() || session.bakes().baking())
      paintBlock(painter, size, Qt::AlignLeft | Qt::AlignTop,
                 {{QObject::tr("opening\u2026"), pictureTheme().text}});
    else
      paintEmpty(painter, size);
    return;
  }
  paintBlock(painter, size, Qt::AlignLeft | Qt::AlignTop, methodLines(session.status()));
  paintSelection(painter, size, session);
  const bool compass = session.view().compass() && session.hasEnvironment();
  if (compass) paintCompass(painter, size, session);
  if (session.view().grid())
    paintAxes(painter, size, compass ? 2 * kMargin + kDial + 12 : kMargin, session.view().camera());
  if (!canvas) return;
  paintBlock(painter, size, Qt::AlignRight | Qt::AlignTop,
             {{QObject::tr("%1 ms \u00b7 %2")
                   .arg(canvas->frameMilliseconds(), 0, 'f', 1)
                   .arg(canvas->describe().section(u' ', 0, 0)),
               pictureTheme().text}});
}

}  // namespace prt::ui
