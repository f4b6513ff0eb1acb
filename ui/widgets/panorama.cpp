#include "ui/widgets/panorama.h"

#include "libprt/light/environment.h"
#include "libprt/shade/tonemap.h"
#include "ui/widgets/theme.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {
constexpr int kPictureWidth = 512, kPictureHeight = 256;
constexpr float kMiddleGrey = 0.25f;
}  // namespace

QImage panoramaPicture(const EnvironmentMap& map, int width, int height) {
  // Few directions are enough for a small picture; the sun counts by its share of the mean only.
  const float mean = std::max(luminance(map.report().mean), 1e-6f);
  const ToneSettings tone{.exposure = std::log2(kMiddleGrey / mean), .curve = ToneCurve::Filmic};
  QImage picture(width, height, QImage::Format_RGB32);
  for (int y = 0; y < height; ++y) {
    auto* row = reinterpret_cast<QRgb*>(picture.scanLine(y));
    const double theta = (y + 0.5) * kPi / height;
    for (int x = 0; x < width; ++x) {
      const double phi = (x + 0.5) * 2 * kPi / width - kPi;
      const Vec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
      const Rgb c = toDisplay(map.radiance(d), tone);
      row[x] = qRgb(qRound(255 * c.x), qRound(255 * c.y), qRound(255 * c.z));
    }
  }
  return picture;
}

Panorama::Panorama(QWidget* parent) : QWidget(parent) {
  setCursor(Qt::SizeHorCursor);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  setMinimumHeight(80);
  setToolTip(tr("The environment as it lights now; the middle is \u2212Z.\nDrag sideways to turn it, drop an HDR or EXR to change it."));
}

void Panorama::setEnvironment(const std::shared_ptr<const EnvironmentMap>& map) {
  if (map == map_) return;
  map_ = map;
  picture_ = map ? panoramaPicture(*map, kPictureWidth, kPictureHeight) : QImage();
  update();
}

void Panorama::setAngle(double degrees) {
  if (degrees == angle_) return;
  angle_ = degrees;
  update();
}

void Panorama::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  QPainterPath frame;
  frame.addRoundedRect(QRectF(rect()), 3, 3);
  painter.setClipPath(frame);
  painter.fillRect(rect(), theme().field);
  if (picture_.isNull()) return;
  // Counter-clockwise from above moves the sky to the left.
  double left = std::fmod(-angle_ / 360.0 * width(), width());
  if (left > 0) left -= width();
  for (double x = left; x < width(); x += width()) painter.drawImage(QRectF(x, 0, width(), height()), picture_);
  painter.setPen(QPen(theme().accent, 1));
  painter.drawLine(QPointF(0.5 * width(), height() - 6), QPointF(0.5 * width(), height()));
}

void Panorama::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  dragging_ = true;
  lastX_ = event->position().x();
  Q_EMIT gestureBegan();
}

void Panorama::mouseMoveEvent(QMouseEvent* event) {
  if (!dragging_) return;
  const double moved = event->position().x() - lastX_;
  lastX_ = event->position().x();
  Q_EMIT turned(-360.0 * moved / width());
}

void Panorama::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !dragging_) return;
  dragging_ = false;
  Q_EMIT gestureEnded();
}

}  // namespace prt::ui
