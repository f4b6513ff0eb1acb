#include "ui/viewport/overlay.h"

#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <QPainter>

namespace prt::ui {

namespace {

constexpr int kMargin = 12, kPadding = 8;

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
  if (s.levels > 0 && s.bounces > 0) method += QObject::tr(" \u00b7 %n bounces", nullptr, s.bounces);
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
  if (!canvas) return;
  paintBlock(painter, size, Qt::AlignRight | Qt::AlignTop,
             {{QObject::tr("%1 ms").arg(canvas->frameMilliseconds(), 0, 'f', 1), pictureTheme().text}});
}

}  // namespace prt::ui
