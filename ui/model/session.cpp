#include "ui/model/session.h"

#include "libprt/basis/sh.h"
#include "libprt/core/error.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/projection.h"
#include "libprt/project/captured_objects.h"
#include "libprt/project/lights.h"
#include "libprt/project/products.h"
#include "libprt/project/scenes.h"
#include "ui/model/captured_scene.h"
#include "ui/model/chart_editor.h"
#include "ui/model/defect_view.h"
#include "ui/model/error_estimate.h"
#include "ui/model/expression.h"
#include "ui/model/field_editor.h"
#include "ui/model/id_view.h"
#include "ui/model/layer_editor.h"
#include "ui/model/painting.h"
#include "ui/model/scene_editor.h"
#include "ui/model/wish_editor.h"

#include <QDir>
#include <QFileInfo>

#include <algorithm>

namespace prt::ui {

namespace {

constexpr int kLightBands = 10;  // as many as transfer can have

bool isEnvironmentFile(const QString& path) {
  const QString ending = QFileInfo(path).suffix().toLower();
  return ending == u"hdr" || ending == u"exr" || ending == u"png";
}

QString nameOf(TransferForm form) {
  switch (form) {
    case TransferForm::None:
      return QObject::tr("nothing (light arrives unchanged)");
    case TransferForm::Diffuse:
      return QObject::tr("a diffuse vector");
    case TransferForm::Visibility:
      return QObject::tr("the visibility function");
    case TransferForm::Matrix:
      return QObject::tr("a transfer matrix");
  }
  return {};
}

}  // namespace

Session::Session(QObject* parent)
    : QObject(parent),
      bakes_(jobs_),
      project_(document_, bakes_, jobs_, log_),
      environments_(std::make_shared<EnvironmentCache>()),
      sceneEditor_(std::make_unique<SceneEditor>(*this)),
      captured_(std::make_unique<CapturedScene>(*this)),
      charts_(std::make_unique<ChartEditor>(*this)),
      defects_(std::make_unique<DefectView>(*this)),
      errors_(std::make_unique<ErrorEstimate>(*this)),
      painting_(std::make_unique<Painting>(*this)),
      field_(std::make_unique<FieldEditor>(*this)),
      wishes_(std::make_unique<WishEditor>(*this)),
      patchLayers_(std::make_unique<LayerEditor>(*this)),
      ids_(std::make_unique<IdView>(*this)) {
  connect(&document_, &Document::recipeChanged, this, &Session::follow);
  connect(&document_, &Document::stateChanged, this, &Session::finishSky);
  connect(&bakes_, &BakeController::productArrived, this, &Session::take);
  connect(&bakes_, &BakeController::changed, this, &Session::statusChanged);
  connect(&bakes_, &BakeController::failed, this,
          [this](const QString& text) { report(Severity::Error, text, Place::Transfer); });
  connect(&project_, &ProjectKeeper::leaving, this, &Session::forget);
  connect(&project_, &ProjectKeeper::statusChanged, this, &Session::statusChanged);
  connect(&project_, &ProjectKeeper::failed, this,
          [this](const QString& text) { report(Severity::Error, text); });
  connect(&project_, &ProjectKeeper::notice, this,
          [this](const QString& text) { report(Severity::Warning, text); });
}

Session::~Session() {
  jobs_.stop();
}

QStringList Session::sampleScenes() const {
  QStringList names;
  for (const std::string& name : builtinSceneNames()) names << QString::fromStdString(name);
  return names;
}

// ---- opening ----

void Session::open(const QString& what) {
  isEnvironmentFile(what) ? openEnvironment(what) : project_.open(what);
}

// What belonged to the document before.
void Session::forget() {
  frameNext_ = true;
  selectedObject_ = 0;
  environmentShown_.clear();
  relighter_.setScene(nullptr);
  Q_EMIT selectionChanged(selectedObject_);
}

void Session::openEnvironment(const QString& path) {
  const QString file = QFileInfo(path).absoluteFilePath();
  const LightRecipe light{.path = file.toStdString()};
  startEnvironment(light, [this, file, light] {
    environmentShown_ = shownKey(light);  // it is there already
    lights_.setEnvironment(file);
  });
}

// ---- the light ----

double Session::environmentAngle() const {
  const int index = lights_.environment();
  return index < 0 ? 0 : double(document_.recipe().lights[std::size_t(index)].rotation);
}

void Session::setEnvironmentAngle(double degrees) {
  const int index = lights_.environment();
  if (index < 0) return;
  Recipe next = document_.recipe();
  next.lights[std::size_t(index)].rotation = float(std::remainder(degrees, 360.0));
  document_.edit(tr("Turn environment"), next);
}

QString Session::environmentFile() const {
  const int index = lights_.environment();
  return index < 0 ? QString() : QString::fromStdString(document_.recipe().lights[std::size_t(index)].path);
}

QString Session::absolutePath(const LightRecipe& light) const {
  const QString path = QString::fromStdString(light.path);
  return isBuiltin(light.path)
             ? path
             : QString::fromStdString((document_.folder() / light.path).lexically_normal().string());
}

// The same wherever the project is.
std::string Session::shownKey(LightRecipe light) const {
  light.path = absolutePath(light).toStdString();
  return mapKey(light);
}

QString Session::environmentPath() const {
  const int index = lights_.environment();
  return index < 0 ? QString() : absolutePath(document_.recipe().lights[std::size_t(index)]);
}

void Session::useEnvironment(const QString& path) {
  if (path.startsWith(u"builtin:"))
    lights_.setEnvironment(path);
  else
    openEnvironment(path);
}

// Reads a map and its coefficients behind the interface, then shows it; `loaded` runs right before.
void Session::startEnvironment(const LightRecipe& light, std::function<void()> loaded) {
  struct Result {
    std::shared_ptr<const EnvironmentMap> map;
    ShRgb coefficients;
    Backdrop backdrop;
  };
  auto result = std::make_shared<Result>();
  const auto work = [result, light, folder = document_.folder(), cache = environments_](Job& job) {
    result->map = cache->get(light, folder);
    result->coefficients = projectEnvironment(*result->map, kLightBands, job);
    result->backdrop = makeBackdrop(result->map, job);
  };
  const auto finish = [this, result, light, loaded = std::move(loaded)](const JobInfo& job) {
    if (job.state == JobState::Failed) report(Severity::Error, job.error, Place::Light);
    if (job.state != JobState::Done) {
      if (skyJobKey_ == shownKey(light)) skyJobKey_.clear();  // a coarse sky still waits for its exact one
      return;
    }
    loaded();
    if (environmentShown_ != shownKey(light)) return;  // another one is wanted by now
    environmentExact_ = true;
    probes_.note(absolutePath(light));
    relighter_.setEnvironment(result->map, result->coefficients, result->backdrop);
    const std::string warning = result->map->report().warning();
    if (!warning.empty()) report(Severity::Warning, QString::fromStdString(warning), Place::Light);
  };
  jobs_.start(QStringLiteral("light"), tr("Load light"), work, finish);
}

void Session::applyLights() {
  const int index = lights_.environment();
  std::vector<LightRecipe> others;
  for (const LightRecipe& light : document_.recipe().lights)
    if (light.kind != LightKind::Environment) others.push_back(light);
  EnvironmentCache none;
  LightRig rig = makeLightRig(others, {}, none);
  if (index < 0) {
    relighter_.setLights(rig, document_.recipe().method);
    if (!std::exchange(environmentShown_, {}).empty()) relighter_.setEnvironment(nullptr, {}, {});
    return;
  }
  const LightRecipe& light = document_.recipe().lights[std::size_t(index)];
  rig.rotation = float(radians(light.rotation));
  rig.intensity = light.on ? light.intensity : 0;
  relighter_.setLights(rig, document_.recipe().method);
  if (std::exchange(environmentShown_, shownKey(light)) == shownKey(light)) return;
  if (!hasSun(light)) return startEnvironment(light, [] {});
  showQuickSky(light);
  finishSky();
}

// A sun that is dragged moves at once; the sky in full follows when it rests.
void Session::showQuickSky(const LightRecipe& light) {
  QuickSky sky = quickClearSky(clearSkyOf(light), kLightBands);
  environmentExact_ = false;
  skyJobKey_.clear();
  const auto map = std::make_shared<const EnvironmentMap>(std::move(sky.map));
  Job patient;  // this map is small
  const bool blurred = view_.background() == BackgroundMode::Blurred;
  relighter_.setEnvironment(map, std::move(sky.coefficients),
                            blurred ? makeBackdrop(map, patient) : Backdrop{map, nullptr});
}

void Session::finishSky() {
  if (environmentExact_ || document_.inGesture() || skyJobKey_ == environmentShown_) return;
  skyJobKey_ = environmentShown_;
  startEnvironment(document_.recipe().lights[std::size_t(lights_.environment())], [] {});
}

// ---- what follows from an edit ----

void Session::follow() {
  if (selectedObject_ >= int(document_.recipe().objects.size()))
    selectObject(int(document_.recipe().objects.size()) - 1);
  applyLights();
  QStringList environments;
  for (const LightRecipe& light : document_.recipe().lights)
    if (light.kind == LightKind::Environment) environments << absolutePath(light);
  probes_.setProject(environments);
  applyMaterials();
  bakes_.setRecipe(document_.recipe());
  Q_EMIT statusChanged();
}

void Session::applyMaterials() {
  const auto& scene = relighter_.scene();
  const auto& objects = document_.recipe().objects;
  if (!scene || scene->materials.size() != objects.size()) return;
  std::vector<Material> materials;
  for (const ObjectRecipe& object : objects) materials.push_back(object.material);
  relighter_.setMaterials(std::move(materials));
}

void Session::take(const QString& stage, const ProductState& state) {
  if (stage == u"mesh") {
    meshes_ = std::dynamic_pointer_cast<const MeshProduct>(state.product);
    meshRecipes_.clear();
    for (const ObjectRecipe& object : document_.recipe().objects) meshRecipes_.push_back(object.mesh);
    Q_EMIT meshesChanged();
  } else if (stage == u"scene") {
    const auto scene = std::dynamic_pointer_cast<const SceneProduct>(state.product)->scene;
    objectBounds_.assign(scene->names.size(), Box3{});
    for (std::size_t v = 0; v < scene->vertexObject.size(); ++v)
      objectBounds_[scene->vertexObject[v]].extend(scene->mesh.positions[v]);
    relighter_.setScene(scene);
    applyMaterials();
    if (std::exchange(frameNext_, false)) showFirst();
  } else if (stage == u"samples") {
    relighter_.setSamples(std::dynamic_pointer_cast<const SamplesProduct>(state.product)->samples);
  } else if (stage == u"transfer") {
    const auto product = std::dynamic_pointer_cast<const TransferProduct>(state.product);
    relighter_.setTransfer(std::shared_ptr<const Transfer>(product, &product->transfer));
    level_ = state.level;
    levels_ = state.levels;
  }
  Q_EMIT statusChanged();
}

// The view of a scene that was just opened: its own camera, or one that shows everything.
void Session::showFirst() {
  const auto& cameras = document_.recipe().cameras;
  view_.setHome(cameras.empty() ? frameBox(allBounds()) : cameras.front().camera());
  view_.reset();
}

// ---- what the windows ask ----

void Session::selectObject(int index) {
  if (index == selectedObject_ || index < 0 || index >= int(document_.recipe().objects.size())) return;
  selectedObject_ = index;
  Q_EMIT selectionChanged(index);
}

PictureStatus Session::status() const {
  PictureStatus status;
  const auto& transfer = relighter_.transfer();
  const auto& materials = relighter_.materials();
  const bool glossy =
      std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.glossy(); });
  status.bands = relighter_.bands();
  status.method = relighter_.shownPatch()                                            ? tr("Bi-scale")
                  : glossy && !(transfer && transfer->form == TransferForm::Diffuse) ? tr("Glossy")
                                                                                     : tr("Diffuse");
  if (!transfer) return status;
  status.level = level_;
  status.levels = levels_;
  status.rays = transfer->raysPerSample;
  status.raysWanted = transfer->raysWanted;
  status.bounces = transfer->bounces;
  if (errors_->complete()) status.estimatedError = errors_->map()->totalRms();
  return status;
}

QString Session::transferSummary() const {
  const auto& transfer = relighter_.transfer();
  if (!transfer) return tr("Nothing is baked yet: the surface is lit without shadows.");
  QString text = tr("Stored per sample: %1. %2 samples, %3 functions, %4 MB.")
                     .arg(nameOf(transfer->form), formatCount(qint64(transfer->samples)))
                     .arg(transfer->functions())
                     .arg(double(transfer->bytes()) / 1e6, 0, 'f', 1);
  for (const std::string& line : contradictions(document_.recipe()))
    text += QStringLiteral("\n\n") + QString::fromStdString(line);
  return text;
}

bool Session::settled() const {
  return !opening() && jobs_.idle() && relighter_.scene() != nullptr;
}

Box3 Session::bounds() const {
  return relighter_.scene() ? relighter_.scene()->mesh.bounds() : Box3{};
}

Box3 Session::allBounds() const {
  Box3 box = bounds();
  for (int i = 0; i < int(document_.recipe().objects.size()); ++i)
    if (isCaptured(document_.recipe().objects[std::size_t(i)]))
      if (const Box3 around = objectBounds(i); !around.empty())
        box.extend(around.low), box.extend(around.high);
  return box;
}

Box3 Session::objectBounds(int object) const {
  const auto& objects = document_.recipe().objects;
  if (object >= 0 && object < int(objects.size()) && isCaptured(objects[std::size_t(object)]))
    return sceneEditor_->boundsOf(object);  // where it is now
  return object >= 0 && object < int(objectBounds_.size()) ? objectBounds_[std::size_t(object)] : Box3{};
}

void Session::report(Severity severity, const QString& text, Place place) {
  log_.add(severity, text);
  if (severity != Severity::Info) Q_EMIT message(severity, text, place);
}

}  // namespace prt::ui
