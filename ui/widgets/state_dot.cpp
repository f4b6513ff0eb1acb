#include "ui/widgets/state_dot.h"

#include "ui/widgets/theme.h"

#include <QPainter>

namespace prt::ui {

StateDot::StateDot(QWidget* parent) : QWidget(parent) {
  setFixedSize(12, kRowHeight - 4);
}

void StateDot::setStatus(ProductStatus status) {
  if (status == status_) return;
  status_ = status;
  update();
}

void StateDot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = theme();
  const QPointF middle = QRectF(rect()).center();
  // A ring where something is still being made, a disc where there is a result to trust or not.
  const bool ring = status_ == ProductStatus::Missing || status_ == ProductStatus::Baking ||
                    status_ == ProductStatus::Preview;
  QColor color = t.muted;
  if (status_ == ProductStatus::Fresh) color = t.done;
  if (status_ == ProductStatus::Failed) color = t.failed;
  if (status_ == ProductStatus::Stale || status_ == ProductStatus::Baking ||
      status_ == ProductStatus::Preview)
    color = t.stale;
  painter.setPen(ring ? QPen(color, 1.5) : QPen(Qt::NoPen));
  painter.setBrush(ring ? QBrush(Qt::NoBrush) : QBrush(color));
  painter.drawEllipse(middle, ring ? 3.25 : 4, ring ? 3.25 : 4);
}

QString statusText(const StageInfo& info) {
  switch (info.status) {
    case ProductStatus::Missing:
      return QObject::tr("not made");
    case ProductStatus::Baking:
      return QObject::tr("baking");
    case ProductStatus::Preview:
      return QObject::tr("preview %1 of %2").arg(info.level).arg(info.levels);
    case ProductStatus::Fresh:
      return QObject::tr("fresh");
    case ProductStatus::Stale:
      return QObject::tr("stale");
    case ProductStatus::Failed:
      return QObject::tr("failed");
  }
  return {};
}

}  // namespace prt::ui
