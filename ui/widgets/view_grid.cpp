#include "ui/widgets/view_grid.h"

#include "libprt/basis/view_square.h"
#include "ui/model/rtt_look.h"
#include "ui/model/view_state.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/theme.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace prt::ui {

ViewGrid::ViewGrid(RttLook& look, const ViewState& view, QWidget* parent)
    : QWidget(parent), look_(look), view_(view) {
  setObjectName(QStringLiteral("viewGrid"));
  setCursor(Qt::PointingHandCursor);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  connect(&look_, &RttLook::changed, this, &ViewGrid::follow);
  connect(&view_, &ViewState::changed, this, &ViewGrid::follow);
}

int ViewGrid::side() const {
  return look_.rtt() ? look_.rtt()->views : 0;
}

void ViewGrid::follow() {
  pictures_.clear();
  for (const Image& image : look_.thumbnails()) pictures_.push_back(toQImage(image, view_.tone()));
  update();
}

// The top row of the square is the last of the table.
QRectF ViewGrid::cell(int view) const {
  const int n = std::max(1, side());
  const double step = width() / double(n);
  return {view % n * step, (n - 1 - view / n) * step, step, step};
}

int ViewGrid::viewAt(const QPointF& at) const {
  const int n = side();
  if (n == 0 || !QRectF(rect()).contains(at)) return -1;
  const int x = std::min(n - 1, int(at.x() * n / width()));
  const int y = std::min(n - 1, int(at.y() * n / width()));
  return (n - 1 - y) * n + x;
}

void ViewGrid::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const int n = side();
  if (pictures_.size() != std::size_t(n) * std::size_t(n) || n == 0) {
    painter.setPen(theme().muted);
    painter.drawText(rect(), Qt::AlignCenter, tr("The views appear here as they are baked."));
    return;
  }
  for (int i = 0; i < n * n; ++i) {
    const int view = (n - 1 - i / n) * n + i % n;
    painter.drawImage(cell(view).adjusted(0.5, 0.5, -0.5, -0.5), pictures_[std::size_t(i)]);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme().accent, 1.5));
  painter.drawRect(cell(look_.viewIndex()).adjusted(0.5, 0.5, -0.5, -0.5));
}

void ViewGrid::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) look_.setViewIndex(viewAt(event->position()));
}

bool ViewGrid::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  auto* help = static_cast<QHelpEvent*>(event);
  const int view = viewAt(help->pos());
  if (view < 0) {
    QToolTip::hideText();
    return true;
  }
  const Vec3 d = ViewSquare(side()).centre(view);
  QToolTip::showText(help->globalPos(),
                     tr("View %1 of %2: %3\u00b0 from the zenith, towards %4\u00b0")
                         .arg(view + 1)
                         .arg(side() * side())
                         .arg(std::acos(double(d.z)) * 180 / M_PI, 0, 'f', 0)
                         .arg(std::atan2(double(d.y), double(d.x)) * 180 / M_PI, 0, 'f', 0),
                     this, cell(view).toRect());
  return true;
}

}  // namespace prt::ui
