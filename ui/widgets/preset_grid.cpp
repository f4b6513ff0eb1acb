#include "ui/widgets/preset_grid.h"

#include "ui/widgets/theme.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {
constexpr int kColumns = 6;
}

PresetGrid::PresetGrid(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("presetGrid"));
  setMouseTracking(true);
  setCursor(Qt::PointingHandCursor);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

void PresetGrid::setPresets(const QStringList& names, const QStringList& tips) {
  names_ = names;
  tips_ = tips;
  updateGeometry();
  update();
}

void PresetGrid::setPictures(std::vector<QImage> pictures) {
  pictures_ = std::move(pictures);
  update();
}

void PresetGrid::setCurrent(int index) {
  if (std::exchange(current_, index) != index) update();
}

QRect PresetGrid::cell(int index) const {
  const int side = (width() - (kColumns - 1) * kGrid) / kColumns;
  return {index % kColumns * (side + kGrid), index / kColumns * (side + kGrid), side, side};
}

int PresetGrid::heightForWidth(int width) const {
  const int side = (width - (kColumns - 1) * kGrid) / kColumns;
  const int rows = (int(names_.size()) + kColumns - 1) / kColumns;
  return std::max(0, rows * side + (rows - 1) * kGrid);
}

int PresetGrid::presetAt(const QPoint& at) const {
  for (int i = 0; i < int(names_.size()); ++i)
    if (cell(i).contains(at)) return i;
  return -1;
}

// Its rows are as high as the width makes them; columns of docks do not ask again for that.
void PresetGrid::resizeEvent(QResizeEvent*) {
  setFixedHeight(heightForWidth(width()));
}

void PresetGrid::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const Theme& t = theme();
  for (int i = 0; i < int(names_.size()); ++i) {
    const QRectF box = QRectF(cell(i)).adjusted(0.5, 0.5, -0.5, -0.5);
    const bool current = i == current_;
    painter.setPen(QPen(current ? t.accent : (i == hovered_ ? t.muted : t.field), current ? 1.5 : 1));
    painter.setBrush(i == hovered_ ? t.fieldHover : t.field);
    painter.drawRoundedRect(box, 3, 3);
    if (std::size_t(i) < pictures_.size())
      painter.drawImage(box.adjusted(3, 3, -3, -3), pictures_[std::size_t(i)]);
  }
}

void PresetGrid::mousePressEvent(QMouseEvent* event) {
  const int index = presetAt(event->position().toPoint());
  if (event->button() == Qt::LeftButton && index >= 0) Q_EMIT chosen(index);
}

void PresetGrid::mouseMoveEvent(QMouseEvent* event) {
  const int index = presetAt(event->position().toPoint());
  if (std::exchange(hovered_, index) != index) update();
}

void PresetGrid::leaveEvent(QEvent*) {
  hovered_ = -1;
  update();
}

bool PresetGrid::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  auto* help = static_cast<QHelpEvent*>(event);
  const int index = presetAt(help->pos());
  if (index >= 0)
    QToolTip::showText(help->globalPos(), names_[index] + QStringLiteral("\n") + tips_[index], this,
                       cell(index));
  else
    QToolTip::hideText();
  return true;
}

}  // namespace prt::ui
