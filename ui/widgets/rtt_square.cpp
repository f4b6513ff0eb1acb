#include "ui/widgets/rtt_square.h"

#include "ui/model/rtt_look.h"
#include "ui/model/view_state.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/theme.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {
constexpr double kDisc = 56;        // pixels across
constexpr double kMoved = 0.012;    // of the disc's radius, a pixel of a drag
constexpr double kKeyMoved = 0.06;  // and a key press
constexpr double kRim = 0.985;      // the eye stays above the horizon

// Directions on the disc: its radius is the sine of the angle to the zenith.
QPointF placeOf(const Vec3& view) {
  return {double(view.x), -double(view.y)};
}
Vec3 viewAt(QPointF p) {
  const double r = std::hypot(p.x(), p.y());
  if (r > kRim) p *= kRim / r;
  const double x = p.x(), y = -p.y();
  return Vec3(float(x), float(y), float(std::sqrt(std::max(0.0, 1 - x * x - y * y))));
}
}  // namespace

RttSquare::RttSquare(RttLook& look, const ViewState& view, QWidget* parent)
    : QWidget(parent), look_(look), view_(view) {
  setObjectName(QStringLiteral("rttSquare"));
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::OpenHandCursor);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  setToolTip(
      tr("The patch on the ground under the light of the scene, as its texture answers. Drag to move "
         "the eye over the hemisphere."));
  connect(&look_, &RttLook::changed, this, &RttSquare::follow);
  connect(&view_, &ViewState::changed, this, &RttSquare::follow);
}

QRectF RttSquare::disc() const {
  return {width() - kDisc - 2 * kGrid, height() - kDisc - 2 * kGrid, kDisc, kDisc};
}

void RttSquare::follow() {
  picture_ = look_.square().empty() ? QImage() : toQImage(look_.square(), view_.tone());
  update();
}

void RttSquare::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (picture_.isNull()) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme().window);
    painter.drawRoundedRect(rect(), 3, 3);
    painter.setPen(theme().muted);
    painter.drawText(rect(), Qt::AlignCenter, tr("Nothing baked yet."));
    return;
  }
  painter.drawImage(rect(), picture_);  // texels stay squares: they are what is judged here
  paintDisc(painter);
  if (hasFocus()) {
    painter.setPen(QPen(theme().accent, 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
}

void RttSquare::paintDisc(QPainter& painter) const {
  const QRectF box = disc();
  const Theme& t = pictureTheme();
  painter.setPen(QPen(t.muted, 1));
  painter.setBrush(pictureVeil());
  painter.drawEllipse(box);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(t.line, 1));
  const double half = 0.5 * box.width() * std::sin(M_PI / 4);
  painter.drawEllipse(box.center(), half, half);
  painter.setPen(Qt::NoPen);
  painter.setBrush(t.accent);
  painter.drawEllipse(box.center() + 0.5 * box.width() * placeOf(look_.view()), 3.5, 3.5);
}

void RttSquare::showEvent(QShowEvent*) {
  look_.setWatched(true);
}

void RttSquare::hideEvent(QHideEvent*) {
  look_.setWatched(false);
}

void RttSquare::moveEye(const QPointF& by) {
  look_.setView(viewAt(placeOf(look_.view()) + by));
}

void RttSquare::mousePressEvent(QMouseEvent* event) {
  last_ = event->position();
  if (event->button() != Qt::LeftButton || !disc().contains(last_)) return;
  const QPointF at = (last_ - disc().center()) / (0.5 * disc().width());
  look_.setView(viewAt(at));
}

void RttSquare::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & (Qt::LeftButton | Qt::MiddleButton))) return;
  moveEye(kMoved * (event->position() - last_));
  last_ = event->position();
}

void RttSquare::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Left:
      return moveEye({-kKeyMoved, 0});
    case Qt::Key_Right:
      return moveEye({kKeyMoved, 0});
    case Qt::Key_Up:
      return moveEye({0, -kKeyMoved});
    case Qt::Key_Down:
      return moveEye({0, kKeyMoved});
    case Qt::Key_Home:
      return look_.setView(Vec3(0, 0, 1));
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace prt::ui
