#include "ui/viewport/gl_canvas.h"

#include "libprt/gl/headless_context.h"
#include "libprt/gl/scene_renderer.h"
#include "libprt/gl/surface_overlay.h"
#include "libprt/gl/transfer_pass.h"
#include "libprt/shade/ground_grid.h"
#include "libprt/shade/turned_transfer.h"
#include "ui/model/job_runner.h"

#include <QElapsedTimer>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLPaintDevice>
#include <QPainter>
#include <QPointer>
#include <QSurfaceFormat>
#include <QTimer>

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {
constexpr int kSamples = 4;         // per pixel, where that is cheap
constexpr int kPasses = 16;         // where it is not: one after the other, while nothing changes
constexpr double kCheap = 12;       // milliseconds
const Rgb kPlainBackground(0.16f);  // as the screen shows it

QSurfaceFormat wantedFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(4, 5);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(0);    // the renderer has its own
  format.setStencilBufferSize(8);  // QPainter's clipping
  return format;
}
}  // namespace

GlCanvas::GlCanvas(CanvasContext context, QWidget* parent)
    : QOpenGLWidget(parent), context_(std::move(context)), keeps_(support() == GlSupport::Hardware) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  connect(this, &QOpenGLWidget::frameSwapped, this, [this] { ++frames_; });
}

GlCanvas::~GlCanvas() {
  release();
  if (context())  // it goes with the base class, when this is no canvas any more
    disconnect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &GlCanvas::release);
}

void GlCanvas::requestFormat() {
  QSurfaceFormat::setDefaultFormat(wantedFormat());
}

GlSupport GlCanvas::support() {
  static const GlSupport found = [] {
    QOpenGLContext context;
    context.setFormat(wantedFormat());
    QOffscreenSurface surface;
    surface.setFormat(wantedFormat());
    surface.create();
    if (!context.create() || !context.makeCurrent(&surface)) return GlSupport::None;
    const bool sufficient = gl::contextIsSufficient(), software = gl::contextIsSoftware();
    context.doneCurrent();
    return !sufficient ? GlSupport::None : software ? GlSupport::Software : GlSupport::Hardware;
  }();
  return found;
}

void GlCanvas::invalidate() {
  pass_ = 0;
  finished_ = false;
  update();
}

void GlCanvas::setInteracting(bool interacting) {
  if (interacting == interacting_) return;
  interacting_ = interacting;
  update();
}

void GlCanvas::setThorough(bool thorough) {
  thorough_ = thorough;
  inPasses_ = inPasses_ || thorough;
  invalidate();
}

bool GlCanvas::settled() const {
  return broken_ || (finished_ && !interacting_);
}

void GlCanvas::initializeGL() {
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &GlCanvas::release);
  try {
    renderer_ = std::make_unique<gl::SceneRenderer>();
    description_ = QString::fromStdString(gl::describeContext());
    scene_ = light_ = materials_ = 0;
    backdrop_.reset();
    patch_.reset();
    turnedOf_.reset(), turned_.reset();
    kept_ = false;
    mostKept_ = gl::TransferPass::mostBytes();
    pass_ = 0;  // what another context has shown is gone with it
    finished_ = broken_ = false;
  } catch (const std::exception& error) {
    broken_ = true;
    Q_EMIT failed(QString::fromUtf8(error.what()));
  }
}

// The objects live in the context: it must be current when they go.
void GlCanvas::release() {
  if (!renderer_) return;
  makeCurrent();
  renderer_.reset();
  layers_.reset();
  doneCurrent();
}

// What was summed is of another size.
void GlCanvas::resizeGL(int, int) {
  invalidate();
}

void GlCanvas::paintGL() {
  QOpenGLFunctions* f = QOpenGLContext::currentContext()->functions();
  if (broken_ || !renderer_) {
    f->glClearColor(0.12f, 0.12f, 0.12f, 1);
    f->glClear(GL_COLOR_BUFFER_BIT);
    return;
  }
  try {
    QElapsedTimer timer;
    timer.start();
    if (finished_) {
      renderer_->showAgain(defaultFramebufferObject());  // uncovered, or grabbed
    } else {
      uploadChanges();
      drawScene();
    }
    drawLayers();
    f->glFinish();  // else the time would be that of handing the work over
    const double milliseconds = timer.nsecsElapsed() * 1e-6;
    if (pass_ == 0 && !finished_) milliseconds_ = milliseconds;
    if (!finished_) goOn(milliseconds);
  } catch (const std::exception& error) {
    broken_ = true;
    Q_EMIT failed(QString::fromUtf8(error.what()));
    return;
  }
  // Onto what is bound now: a painter on the widget would go elsewhere while the window is being grabbed.
  QOpenGLPaintDevice device(size() * devicePixelRatioF());
  device.setDevicePixelRatio(devicePixelRatioF());
  QPainter painter(&device);
  context_.paintOverlay(painter);
}

// After a frame: another pass for smoother edges, while nothing changes.
void GlCanvas::goOn(double milliseconds) {
  if (!inPasses_ && milliseconds > kCheap) inPasses_ = true;
  finished_ = !inPasses_ || pass_ >= kPasses - 1;
  if (finished_ || interacting_) return;
  ++pass_;
  QTimer::singleShot(0, this, qOverload<>(&QWidget::update));
}

void GlCanvas::uploadChanges() {
  Relighter& lit = context_.relighter;
  if (!lit.scene()) return;
  if (scene_ != lit.sceneVersion()) {
    if (lit.samples())
      renderer_->setScene(*lit.scene(), *lit.samples());
    else
      renderer_->setScene(*lit.scene());
    scene_ = lit.sceneVersion();
    light_ = materials_ = 0;
  }
  if (materials_ != lit.materialVersion()) {
    renderer_->setMaterials(lit.materials());
    materials_ = lit.materialVersion();
  }
  const auto backdrop = skyBehind(lit, context_.view).map;
  if (backdrop && backdrop != backdrop_) {
    renderer_->setEnvironment(*backdrop);
    backdrop_ = backdrop;
  }
  const auto patch = lit.shownPatch();
  if (patch != patch_) {
    renderer_->setPatch(patch);
    patch_ = patch;
    light_ = 0;
    turnedOf_.reset(), turned_.reset();
    kept_ = false;
  }
  if (light_ != lit.lightVersion()) uploadLight();
}

void GlCanvas::uploadLight() {
  Relighter& lit = context_.relighter;
  if (patch_)
    uploadPatchLight();
  else
    renderer_->setLight(lit.surface());
  renderer_->setSurroundings(lit.surroundings());
  light_ = lit.lightVersion();
}

void GlCanvas::uploadPatchLight() {
  Relighter& lit = context_.relighter;
  const bool baked = lit.transfer() && lit.samples();
  if (keeps_ && baked && lit.transfer()->final()) turnTransfer();
  if (kept_ && turnedOf_ == lit.transfer()) return renderer_->setPatchLight(lit.light());
  Transfer unshadowed;
  unshadowed.bands = lit.bands();
  Job patient;
  renderer_->setPatchLight(baked ? *lit.samples() : SampleSet{}, baked ? *lit.transfer() : unshadowed,
                           lit.light(), patient);
}

// Begun once for each bake; until it is there light takes the other way. What was made is sent and given up.
void GlCanvas::turnTransfer() {
  const auto& transfer = context_.relighter.transfer();
  if (turnedOf_ == transfer) {
    if (turned_) kept_ = renderer_->keepPatchTransfer(*std::exchange(turned_, nullptr));
    return;
  }
  turnedOf_ = transfer;
  turned_.reset();
  kept_ = false;
  auto made = std::make_shared<std::shared_ptr<const TurnedTransfer>>();
  context_.jobs.startQuietly(
      QStringLiteral("transfer on the card"), tr("Transfer for the graphics card"),
      [made, patch = patch_, samples = context_.relighter.samples(), transfer, most = mostKept_](Job& job) {
        *made =
            std::make_shared<const TurnedTransfer>(turnedTransfer(*patch, *samples, *transfer, most, job));
      },
      [self = QPointer(this), made, patch = patch_, transfer](const JobInfo&) {
        if (!self || !*made || self->patch_ != patch || self->turnedOf_ != transfer) return;
        self->turned_ = *made;
        self->light_ = 0;
        self->invalidate();
      });
}

void GlCanvas::setKeepsTransfer(bool keeps) {
  keeps_ = keeps;
  kept_ = false;
  turnedOf_.reset(), turned_.reset();
  light_ = 0;
  invalidate();
}

void GlCanvas::drawScene() {
  gl::Picture picture;
  picture.camera = context_.view.camera();
  picture.width = qRound(width() * devicePixelRatioF());
  picture.height = qRound(height() * devicePixelRatioF());
  picture.samples = inPasses_ ? 1 : kSamples;
  picture.pass = inPasses_ ? std::min(pass_, kPasses - 1) : 0;
  const Sky sky = skyBehind(context_.relighter, context_.view);
  picture.background = sky.any() ? gl::Background::Environment : gl::Background::Black;
  picture.behind = kPlainBackground;
  picture.environmentRotation = context_.relighter.rig().rotation;
  // The renderer keeps the last map that it was given, also when the recipe has none any more.
  picture.environmentIntensity = sky.map ? context_.relighter.rig().intensity : 0;
  picture.circles = sky.circles;
  picture.constant = sky.constant;
  picture.smoothEnvironment = true;
  picture.viewDependent = context_.relighter.method().viewDependent;
  picture.tone = context_.view.tone();
  if (context_.view.grid() && context_.relighter.scene())
    picture.gridSpacing = gridSpacing(context_.relighter.scene()->mesh.bounds());
  renderer_->draw(picture, defaultFramebufferObject());
}

// False colour and marks over the picture, with a depth pass of their own.
void GlCanvas::drawLayers() {
  const Relighter& lit = context_.relighter;
  const SurfaceLayers& over = context_.layers;
  if (over.empty() || !lit.scene()) return;
  if (!layers_) {
    layers_ = std::make_unique<gl::SurfaceOverlay>();
    layersScene_ = layersValues_ = layersPaint_ = layersMarks_ = 0;
  }
  if (layersScene_ != lit.sceneVersion()) {
    layers_->setMesh(lit.scene()->mesh);
    layersScene_ = lit.sceneVersion();
    layersValues_ = layersPaint_ = 0;
  }
  if (layersValues_ != over.valuesVersion()) {
    const bool fits = over.values().size() == lit.scene()->mesh.vertexCount();
    layers_->setValues(fits ? std::span<const float>(over.values()) : std::span<const float>());
    layersValues_ = over.valuesVersion();
  }
  if (layersPaint_ != over.paintVersion()) {
    const bool fits = over.paint().fits(lit.scene()->mesh.triangleCount());
    layers_->setPaint(fits ? over.paint() : SurfacePaint{});
    layersPaint_ = over.paintVersion();
  }
  if (layersMarks_ != over.marksVersion()) {
    layers_->setMarks(over.marks());
    layersMarks_ = over.marksVersion();
  }
  layers_->draw(overlayPicture(context_.view.camera(), size(), devicePixelRatioF(), interacting_),
                defaultFramebufferObject());
}

QImage GlCanvas::grabPicture() {
  const auto overlay = std::exchange(context_.paintOverlay, [](QPainter&) {});
  const QImage image = grabFramebuffer();
  context_.paintOverlay = overlay;
  return image;
}

}  // namespace prt::ui
