#include "ui/widgets/patch_canvas.h"

#include "ui/model/patch_preview.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/theme.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <cmath>

namespace prt::ui {

namespace {

constexpr float kTurn = 0.01f;      // radians a pixel
constexpr float kKeyTurn = 0.1f;    // radians a key press
constexpr double kZoomStep = 1.15;  // a notch of the wheel

}  // namespace

PatchCanvas::PatchCanvas(PatchPreview& preview, QWidget* parent) : QWidget(parent), preview_(preview) {
  setObjectName(QStringLiteral("patchCanvas"));
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::OpenHandCursor);
  setFixedHeight(sizeHint().height());
  setToolTip(tr("One period of the patch, cut out. Drag turns it, the wheel zooms, a double click resets."));
  connect(&preview_, &PatchPreview::changed, this, &PatchCanvas::follow);
}

void PatchCanvas::follow() {
  picture_ = preview_.picture().empty() ? QImage() : toQImage(preview_.picture(), {});
  picture_.setDevicePixelRatio(devicePixelRatioF());
  update();
}

QString PatchCanvas::message() const {
  if (!preview_.hasShape()) return tr("No patch.\nChoose one below to give\nthe surface a fine structure.");
  return preview_.error().isEmpty() ? QString() : tr("This patch cannot be made.");
}

void PatchCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme().window);
  painter.drawRoundedRect(rect(), 3, 3);
  if (!picture_.isNull()) painter.drawImage(QPointF(0, 0), picture_);
  if (const QString text = message(); !text.isEmpty()) {
    painter.setPen(theme().muted);
    painter.drawText(rect(), Qt::AlignCenter, text);
  }
  if (hasFocus()) {
    painter.setPen(QPen(theme().accent, 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
  }
}

void PatchCanvas::resizeEvent(QResizeEvent*) {
  preview_.setSize(int(std::lround(width() * devicePixelRatioF())),
                   int(std::lround(height() * devicePixelRatioF())));
}

void PatchCanvas::showEvent(QShowEvent*) {
  preview_.setWatched(true);
}

void PatchCanvas::hideEvent(QHideEvent*) {
  preview_.setWatched(false);
}

void PatchCanvas::mousePressEvent(QMouseEvent* event) {
  last_ = event->position();
}

void PatchCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & (Qt::LeftButton | Qt::MiddleButton))) return;
  const QPointF by = event->position() - last_;
  last_ = event->position();
  preview_.turn(-kTurn * float(by.x()), kTurn * float(by.y()));
}

void PatchCanvas::mouseDoubleClickEvent(QMouseEvent*) {
  preview_.setView({});
}

void PatchCanvas::wheelEvent(QWheelEvent* event) {
  preview_.zoom(float(std::pow(kZoomStep, event->angleDelta().y() / 120.0)));
  event->accept();
}

void PatchCanvas::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Left:
      return preview_.turn(kKeyTurn, 0);
    case Qt::Key_Right:
      return preview_.turn(-kKeyTurn, 0);
    case Qt::Key_Up:
      return preview_.turn(0, kKeyTurn);
    case Qt::Key_Down:
      return preview_.turn(0, -kKeyTurn);
    case Qt::Key_Home:
      return preview_.setView({});
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace prt::ui
