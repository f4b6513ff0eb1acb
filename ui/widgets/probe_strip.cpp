#include "ui/widgets/probe_strip.h"

#include "ui/widgets/image_convert.h"
#include "ui/widgets/theme.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>

#include <utility>

namespace prt::ui {

namespace {
constexpr int kColumns = 4;
}

ProbeStrip::ProbeStrip(ProbeLibrary& library, QWidget* parent) : QWidget(parent), library_(library) {
  setObjectName(QStringLiteral("probeStrip"));
  setMouseTracking(true);
  setFocusPolicy(Qt::TabFocus);
  setCursor(Qt::PointingHandCursor);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  connect(&library_, &ProbeLibrary::changed, this, &ProbeStrip::follow);
  follow();
}

void ProbeStrip::follow() {
  std::map<std::shared_ptr<const Image>, QImage> pictures;
  for (const Probe& probe : library_.probes())
    if (probe.picture) {
      const auto known = pictures_.find(probe.picture);
      pictures[probe.picture] = known != pictures_.end() ? known->second : toQImage(*probe.picture);
    }
  pictures_ = std::move(pictures);
  hovered_ = -1;
  updateGeometry();
  update();
}

void ProbeStrip::setCurrent(const QString& path) {
  if (std::exchange(current_, path) != path) update();
}

QRect ProbeStrip::cell(int index) const {
  const int across = (width() - (kColumns - 1) * kGrid) / kColumns, down = across / 2;
  return {index % kColumns * (across + kGrid), index / kColumns * (down + kGrid), across, down};
}

int ProbeStrip::heightForWidth(int width) const {
  const int down = (width - (kColumns - 1) * kGrid) / kColumns / 2;
  const int rows = (int(library_.probes().size()) + kColumns - 1) / kColumns;
  return rows * down + (rows - 1) * kGrid;
}

int ProbeStrip::probeAt(const QPoint& at) const {
  for (int i = 0; i < int(library_.probes().size()); ++i)
    if (cell(i).contains(at)) return i;
  return -1;
}

void ProbeStrip::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const Theme& t = theme();
  for (int i = 0; i < int(library_.probes().size()); ++i) {
    const Probe& probe = library_.probes()[std::size_t(i)];
    const QRectF box = QRectF(cell(i)).adjusted(0.5, 0.5, -0.5, -0.5);
    QPainterPath frame;
    frame.addRoundedRect(box, 2, 2);
    painter.fillPath(frame, t.field);
    if (probe.picture) {
      painter.setClipPath(frame);
      painter.drawImage(box, pictures_.at(probe.picture));
      painter.setClipping(false);
    } else if (!probe.error.isEmpty()) {
      icon(QStringLiteral("data-error"), t.failed).paint(&painter, box.toRect());
    }
    const bool current = probe.path == current_;
    painter.setPen(QPen(current ? t.accent : (i == hovered_ ? t.text : t.line), current ? 2 : 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(frame);
  }
  if (hasFocus()) {
    painter.setPen(QPen(t.accent, 1, Qt::DotLine));
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
}

void ProbeStrip::choose(int index) {
  if (index < 0 || index >= int(library_.probes().size())) return;
  const QString path = library_.probes()[std::size_t(index)].path;
  Q_EMIT chosen(path);
}

void ProbeStrip::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) choose(probeAt(event->position().toPoint()));
}

void ProbeStrip::mouseMoveEvent(QMouseEvent* event) {
  const int at = probeAt(event->position().toPoint());
  if (std::exchange(hovered_, at) != at) update();
}

void ProbeStrip::leaveEvent(QEvent*) {
  hovered_ = -1;
  update();
}

// Left and right step through them.
void ProbeStrip::keyPressEvent(QKeyEvent* event) {
  const int step = event->key() == Qt::Key_Right ? 1 : (event->key() == Qt::Key_Left ? -1 : 0);
  if (step == 0) return QWidget::keyPressEvent(event);
  int now = -1;
  for (int i = 0; i < int(library_.probes().size()); ++i)
    if (library_.probes()[std::size_t(i)].path == current_) now = i;
  choose(now < 0 ? 0 : now + step);
}

bool ProbeStrip::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  auto* help = static_cast<QHelpEvent*>(event);
  const int index = probeAt(help->pos());
  if (index < 0) {
    QToolTip::hideText();
    return true;
  }
  const Probe& probe = library_.probes()[std::size_t(index)];
  QToolTip::showText(help->globalPos(), probe.error.isEmpty() ? probe.name : probe.error, this, cell(index));
  return true;
}

}  // namespace prt::ui
