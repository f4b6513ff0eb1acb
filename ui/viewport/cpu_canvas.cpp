#include "ui/viewport/cpu_canvas.h"

#include "libprt/shade/render.h"

#include <QElapsedTimer>
#include <QPainter>

namespace prt::ui {

namespace {

constexpr double kCoarseWhileInteracting = 0.5;  // of the resolution
constexpr int kSmoothGrid = 2;                   // samples per pixel and side when still

QImage toQImage(const Image& image) {
  QImage out(image.width, image.height, QImage::Format_RGB32);
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<QRgb*>(out.scanLine(y));
    for (int x = 0; x < image.width; ++x) {
      const Rgb c = image.rgb(x, y);
      row[x] = qRgb(qRound(255 * c.x), qRound(255 * c.y), qRound(255 * c.z));
    }
  }
  return out;
}

}  // namespace

CpuCanvas::CpuCanvas(CanvasContext context, QWidget* parent) : QWidget(parent), context_(std::move(context)) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_OpaquePaintEvent);
}

void CpuCanvas::setInteracting(bool interacting) {
  if (interacting == interacting_) return;
  interacting_ = interacting;
  update();
}

void CpuCanvas::followScene() {
  const Relighter& lit = context_.relighter;
  if (sceneVersion_ == lit.sceneVersion() && materialVersion_ == lit.materialVersion()) return;
  if (sceneVersion_ != lit.sceneVersion()) scene_ = *lit.scene();
  scene_.materials = lit.materials();
  samples_ = samplesAtVertices(scene_);
  sceneVersion_ = lit.sceneVersion();
  materialVersion_ = lit.materialVersion();
}

QImage CpuCanvas::draw() {
  Relighter& lit = context_.relighter;
  followScene();
  const double scale = devicePixelRatioF() * (interacting_ ? kCoarseWhileInteracting : 1);
  const int w = std::max(1, qRound(width() * scale)), h = std::max(1, qRound(height() * scale));
  Transfer unshadowed;
  unshadowed.bands = lit.bands();
  const bool behind = context_.view.background() == BackgroundMode::Environment;
  const bool baked = lit.transfer() && lit.samples();
  const RenderInput input{.scene = scene_,
                          .samples = baked ? *lit.samples() : samples_,
                          .transfer = baked ? *lit.transfer() : unshadowed,
                          .light = lit.light(),
                          .background = behind ? &lit.rig() : nullptr};
  Job patient;
  const Image radiance = prt::render(input, context_.view.camera(), w, h, interacting_ ? 1 : kSmoothGrid, patient);
  Image shown = toDisplay(radiance, context_.view.tone());
  layOver(shown, scale);
  return toQImage(shown);
}

void CpuCanvas::layOver(Image& picture, double scale) const {
  const SurfaceLayers& layers = context_.layers;
  const bool fits = layers.values().size() == scene_.mesh.vertexCount();
  if (layers.marks().empty() && (layers.values().empty() || !fits)) return;
  OverlayPicture over = overlayPicture(context_.view.camera(), size(), scale, interacting_);
  over.width = picture.width, over.height = picture.height;
  Job patient;
  const Image layer = drawSurfaceOverlay(scene_.mesh, fits ? std::span<const float>(layers.values()) : std::span<const float>(),
                                         layers.marks(), over, patient);
  for (std::size_t i = 0; i < picture.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = picture.data[std::size_t(picture.channels) * i + c];
      value = layer.data[4 * i + c] + (1 - layer.data[4 * i + 3]) * value;
    }
}

void CpuCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), QColor(0x1e, 0x1e, 0x1e));
  if (context_.relighter.scene()) {
    QElapsedTimer timer;
    timer.start();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(rect(), draw());
    milliseconds_ = timer.nsecsElapsed() * 1e-6;
  }
  context_.paintOverlay(painter);
}

QImage CpuCanvas::grabPicture() {
  return context_.relighter.scene() ? draw() : QImage();
}

}  // namespace prt::ui
