#include "ui/viewport/cpu_canvas.h"

#include "libprt/core/parallel.h"
#include "libprt/shade/ground_grid.h"

#include <QElapsedTimer>
#include <QPainter>

#include <utility>

namespace prt::ui {

namespace {

constexpr double kCoarse = 0.5;                    // of the resolution, while frames take too long
constexpr double kTooLong = 40, kShortAgain = 8;   // milliseconds of a full and of a coarse frame
constexpr int kSmoothGrid = 4, kThoroughGrid = 8;  // samples per pixel and side
constexpr int kRestMilliseconds = 90;              // without a change, before the smooth picture is begun
const Rgb kPlainBackground(0.16f);                 // as the screen shows it

/// False colour and marks; `layer` is premultiplied and as the screen shows it.
void layOver(QImage& image, const Image& layer) {
  for (int y = 0; y < image.height(); ++y) {
    auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < image.width(); ++x) {
      const float* over = layer.pixel(x, y);
      if (over[3] <= 0) continue;
      const auto mixed = [&](int c, int below) {
        return qRound(255 * over[c] + (1 - over[3]) * float(below));
      };
      row[x] = qRgb(mixed(0, qRed(row[x])), mixed(1, qGreen(row[x])), mixed(2, qBlue(row[x])));
    }
  }
}

}  // namespace

void CpuCanvas::drawInto(QImage& image, LiveRenderer& renderer, const LiveScene& scene,
                         const LivePicture& picture, const Layers& layers, Job& job) {
  const int width = picture.width, height = picture.height;
  if (image.size() != QSize(width, height)) image = QImage(width, height, QImage::Format_RGB32);
  // Rows of 32-bit pixels have no padding.
  renderer.draw(scene, picture,
                {reinterpret_cast<std::uint32_t*>(image.bits()), std::size_t(width) * std::size_t(height)},
                job);
  const bool fits = scene.scene && layers.values.size() == scene.scene->mesh.vertexCount();
  const SurfacePaint& paint = layers.paint;
  const bool painted = scene.scene && !paint.empty() &&
                       (paint.colors.empty() || paint.colors.size() == scene.scene->mesh.triangleCount());
  if (!scene.scene || (!fits && !painted && layers.marks.empty())) return;
  const OverlayPicture over{picture.camera, width, height, layers.grid, layers.pixelScale};
  layOver(image, drawSurfaceOverlay(scene.scene->mesh,
                                    fits ? std::span<const float>(layers.values) : std::span<const float>(),
                                    painted ? paint : SurfacePaint{}, layers.marks, over, job));
}

CpuCanvas::CpuCanvas(CanvasContext context, QWidget* parent) : QWidget(parent), context_(std::move(context)) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_OpaquePaintEvent);
  smoothing_.setMaxThreadCount(1);
  rest_.setSingleShot(true);
  connect(&rest_, &QTimer::timeout, this, &CpuCanvas::startSmooth);
}

CpuCanvas::~CpuCanvas() {
  if (smooth_) smooth_->job.cancel();
  smoothing_.waitForDone();
}

void CpuCanvas::invalidate() {
  ++version_;
  broken_ = false;  // what was refused may be another thing by now
  if (smooth_) smooth_->job.cancel();
  update();
}

void CpuCanvas::setInteracting(bool interacting) {
  if (interacting == interacting_) return;
  interacting_ = interacting;
  if (!interacting && coarse_) ++version_;
  update();
}

void CpuCanvas::setThorough(bool thorough) {
  if (thorough == thorough_) return;
  thorough_ = thorough;
  invalidate();
}

bool CpuCanvas::settled() const {
  return broken_ || (!interacting_ && smooth_ && smooth_->version == version_ && !smooth_->image.isNull());
}

int CpuCanvas::smoothGrid() const {
  return thorough_ ? kThoroughGrid : kSmoothGrid;
}

QSize CpuCanvas::pixels(double scale) const {
  const double ratio = devicePixelRatioF() * scale;
  return {std::max(1, qRound(width() * ratio)), std::max(1, qRound(height() * ratio))};
}

LiveScene CpuCanvas::liveScene() const {
  Relighter& lit = context_.relighter;
  LiveScene scene{lit.scene(), lit.samples(), lit.transfer(),     lit.materials(),
                  lit.light(), nullptr,       lit.rig().rotation, lit.rig().intensity};
  const Sky sky = skyBehind(lit, context_.view);
  scene.environment = sky.map;
  scene.circles = sky.circles;
  scene.constant = sky.constant;
  scene.patch = lit.shownPatch();
  scene.viewDependent = lit.method().viewDependent;
  return scene;
}

CpuCanvas::Layers CpuCanvas::layersNow(double scale, int grid) const {
  return {context_.layers.values(), context_.layers.paint(), context_.layers.marks(),
          float(devicePixelRatioF() * scale), grid};
}

LivePicture CpuCanvas::livePicture(const QSize& size, int grid) const {
  const float spacing = context_.view.grid() && context_.relighter.scene()
                            ? gridSpacing(context_.relighter.scene()->mesh.bounds())
                            : 0;
  return {context_.view.camera(), size.width(),         size.height(), grid,
          kPlainBackground,       context_.view.tone(), spacing};
}

void CpuCanvas::drawFrame() {
  if (drawn_ == version_ && (frame_.size() == pixels(1) || interacting_)) return;
  QElapsedTimer timer;
  timer.start();
  const bool coarse = interacting_ && coarse_;
  Job patient;
  const double scale = coarse ? kCoarse : 1;
  drawInto(frame_, renderer_, liveScene(), livePicture(pixels(scale), 1), layersNow(scale, 1), patient);
  drawn_ = version_;
  milliseconds_ = double(timer.nsecsElapsed()) * 1e-6;
  if (interacting_) coarse_ = coarse ? milliseconds_ > kShortAgain : milliseconds_ > kTooLong;
}

// Behind the interface; what it needs is immutable or copied.
void CpuCanvas::startSmooth() {
  if (interacting_ || (smooth_ && smooth_->version == version_)) return;
  if (smooth_) smooth_->job.cancel();
  smooth_ = std::make_shared<Smooth>();
  smooth_->version = version_;
  smoothing_.start([this, smooth = smooth_, scene = liveScene(),
                    picture = livePicture(pixels(1), smoothGrid()), layers = layersNow(1, 2)] {
    // Nobody waits for it: charts and bakes that the hand has just changed come first or beside it.
    const BackgroundWork background;
    QImage image;
    try {
      LiveRenderer renderer;
      drawInto(image, renderer, scene, picture, layers, smooth->job);
    } catch (const std::exception&) {
      return;  // cancelled; or the frame on the screen told already
    }
    QMetaObject::invokeMethod(
        this,
        [this, smooth, image] {
          smooth->image = image;
          takeSmooth(smooth);
        },
        Qt::QueuedConnection);
  });
}

void CpuCanvas::takeSmooth(const std::shared_ptr<Smooth>& smooth) {
  if (smooth == smooth_ && smooth->version == version_) update();
}

void CpuCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (!context_.relighter.scene() || broken_) {
    painter.fillRect(rect(), QColor(0x1e, 0x1e, 0x1e));
  } else if (settled()) {
    painter.drawImage(rect(), smooth_->image);
  } else {
    try {
      drawFrame();
    } catch (const std::exception& error) {
      broken_ = true;
      const QString problem = QString::fromUtf8(error.what());
      if (std::exchange(problem_, problem) != problem) Q_EMIT failed(problem);
    }
    painter.setRenderHint(QPainter::SmoothPixmapTransform, frame_.size() != pixels(1));
    painter.drawImage(rect(), frame_);
    if (!interacting_ && !broken_) rest_.start(thorough_ ? 0 : kRestMilliseconds);
  }
  context_.paintOverlay(painter);
  ++frames_;
}

void CpuCanvas::resizeEvent(QResizeEvent*) {
  invalidate();
}

QImage CpuCanvas::grabPicture() {
  if (!context_.relighter.scene()) return {};
  QImage image;
  Job patient;
  LiveRenderer renderer;
  drawInto(image, renderer, liveScene(), livePicture(pixels(1), smoothGrid()), layersNow(1, 2), patient);
  return image;
}

}  // namespace prt::ui
