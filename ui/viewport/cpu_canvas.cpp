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

QImage CpuCanvas::surfaceOf(LiveRenderer& renderer, const LiveScene& scene, const LivePicture& picture,
                            Job& job) {
  const int width = picture.width, height = picture.height;
  QImage image(width, height, QImage::Format_RGB32);
  // Rows of 32-bit pixels have no padding.
  renderer.draw(scene, picture,
                {reinterpret_cast<std::uint32_t*>(image.bits()), std::size_t(width) * std::size_t(height)},
                job);
  return image;
}

QImage CpuCanvas::withLayers(const QImage& surface, const LiveScene& scene, const Camera& camera,
                             const Layers& layers, Job& job) {
  const bool fits = scene.scene && layers.values.size() == scene.scene->mesh.vertexCount();
  const SurfacePaint& paint = layers.paint;
  const bool painted = scene.scene && !paint.empty() && paint.fits(scene.scene->mesh.triangleCount());
  if (!scene.scene || (!fits && !painted && layers.marks.empty())) return surface;
  const OverlayPicture over{camera, surface.width(), surface.height(), layers.grid, layers.pixelScale};
  QImage image = surface;
  layOver(image, drawSurfaceOverlay(scene.scene->mesh,
                                    fits ? std::span<const float>(layers.values) : std::span<const float>(),
                                    painted ? paint : SurfacePaint{}, layers.marks, over, job));
  return image;
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
  surfaceVersion_ = version_ + 1;
  change();
}

void CpuCanvas::invalidateLayers() {
  change();
}

void CpuCanvas::change() {
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
  scene.surroundings = lit.surroundings();
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
  const LiveScene scene = liveScene();
  if (drawn_ < surfaceVersion_ || surface_.size() != pixels(scale))
    surface_ = surfaceOf(renderer_, scene, livePicture(pixels(scale), 1), patient);
  frame_ = withLayers(surface_, scene, context_.view.camera(), layersNow(scale, 1), patient);
  drawn_ = version_;
  milliseconds_ = double(timer.nsecsElapsed()) * 1e-6;
  if (interacting_) coarse_ = coarse ? milliseconds_ > kShortAgain : milliseconds_ > kTooLong;
}

// Behind the interface; what it needs is immutable or copied.
void CpuCanvas::startSmooth() {
  if (interacting_ || (smooth_ && smooth_->version == version_)) return;
  if (smooth_) smooth_->job.cancel();
  const auto before = std::exchange(smooth_, std::make_shared<Smooth>());
  smooth_->version = version_;
  if (before && before->version >= surfaceVersion_ && before->surface.size() == pixels(1))
    smooth_->surface = before->surface;
  smoothing_.start([this, smooth = smooth_, scene = liveScene(),
                    picture = livePicture(pixels(1), smoothGrid()), layers = layersNow(1, 2)] {
    // Nobody waits for it: charts and bakes that the hand has just changed come first or beside it.
    const BackgroundWork background;
    QImage surface = smooth->surface, image;
    try {
      LiveRenderer renderer;
      if (surface.isNull()) surface = surfaceOf(renderer, scene, picture, smooth->job);
      image = withLayers(surface, scene, picture.camera, layers, smooth->job);
    } catch (const std::exception&) {
      return;  // cancelled; or the frame on the screen told already
    }
    QMetaObject::invokeMethod(
        this,
        [this, smooth, surface, image] {
          smooth->surface = surface;
          smooth->image = image;
          if (smooth == smooth_ && smooth->version == version_) update();
        },
        Qt::QueuedConnection);
  });
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
  Job patient;
  LiveRenderer renderer;
  const LiveScene scene = liveScene();
  return withLayers(surfaceOf(renderer, scene, livePicture(pixels(1), smoothGrid()), patient), scene,
                    context_.view.camera(), layersNow(1, 2), patient);
}

}  // namespace prt::ui
