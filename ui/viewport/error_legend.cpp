#include "ui/viewport/error_legend.h"

#include "libprt/shade/color_map.h"
#include "ui/model/error_estimate.h"
#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <QPainter>

namespace prt::ui {

namespace {

constexpr int kMargin = 12, kPadding = 10, kBarWidth = 336, kBarHeight = 10;

QColor toQColor(const Rgb& c) {
  return QColor::fromRgbF(c.x, c.y, c.z);
}

void paintScale(QPainter& painter, const QRect& bar, double end) {
  for (int x = 0; x < bar.width(); ++x) {
    painter.fillRect(bar.left() + x, bar.top(), 1, bar.height(),
                     toQColor(magnitudeColor(float(x) / float(bar.width() - 1))));
  }
  painter.setPen(pictureTheme().muted);
  const QFontMetrics metrics = painter.fontMetrics();
  for (const double t : {0.0, 0.5, 1.0}) {
    const QString text = t == 0 ? QStringLiteral("0")
                                : (t == 1 ? QStringLiteral("\u2265 ") : QString()) + percentText(t * end);
    const int x = bar.left() + int(t * (bar.width() - 1)), wide = metrics.horizontalAdvance(text);
    painter.drawLine(x, bar.bottom() + 1, x, bar.bottom() + 4);
    const int left = t == 0 ? x : (t == 1 ? x - wide : x - wide / 2);
    painter.drawText(left, bar.bottom() + 5 + metrics.ascent(), text);
  }
}

}  // namespace

void paintErrorLegend(QPainter& painter, const QSize& size, Session& session) {
  const ErrorEstimate& errors = session.errors();
  if (errors.shown() == ErrorShown::Off) return;
  const ErrorMap* map = errors.map();
  const QFontMetrics metrics = painter.fontMetrics();
  const int line = metrics.height() + 2;
  QRect box(0, 0, kBarWidth + 2 * kPadding,
            map ? 2 * kPadding + 4 * line + kBarHeight + 4 : 2 * kPadding + line);
  box.moveBottomRight(QPoint(size.width() - kMargin, size.height() - kMargin));
  painter.setPen(Qt::NoPen);
  painter.setBrush(pictureVeil());
  painter.drawRoundedRect(box, 4, 4);
  QRect row(box.left() + kPadding, box.top() + kPadding, kBarWidth, line);
  painter.setPen(pictureTheme().text);
  if (!map) {
    painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter,
                     errors.measuring() ? QObject::tr("Measuring the error\u2026")
                                        : QObject::tr("The error is measured when the bake is final"));
    return;
  }
  painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter,
                   QObject::tr("Error of irradiance: %1").arg(errorName(errors.shown())));
  row.translate(0, line);
  paintScale(painter, QRect(row.left(), row.top() + 2, kBarWidth, kBarHeight), errors.scaleEnd());
  row.translate(0, line + kBarHeight + 4);
  painter.setPen(pictureTheme().text);
  const QString between = errors.complete() ? percentText(map->rms.y) : QStringLiteral("\u2026");
  painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter,
                   QObject::tr("Over the surface: %1").arg(percentText(map->totalRms())));
  row.translate(0, line);
  painter.setPen(pictureTheme().muted);
  painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter,
                   QObject::tr("noise %1 \u00b7 between vertices %2 \u00b7 bands %3")
                       .arg(percentText(map->rms.x), between, percentText(map->rms.z)));
}

}  // namespace prt::ui
