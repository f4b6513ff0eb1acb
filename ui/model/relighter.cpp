#include "ui/model/relighter.h"

#include "libprt/light/resample.h"
#include "libprt/project/lights.h"

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {

constexpr int kBackdropWidth = 2048;  // of maps in other mappings than lat-long
constexpr double kBlurDegrees = 10;

bool sameGeometry(const Scene& a, const Scene& b) {
  return a.mesh.positions == b.mesh.positions && a.mesh.normals == b.mesh.normals &&
         a.mesh.triangles == b.mesh.triangles;
}

bool sameLights(const LightRig& a, const LightRig& b) {
  return a.rotation == b.rotation && a.intensity == b.intensity && a.circles == b.circles &&
         a.directionals == b.directionals && a.constant == b.constant;
}

}  // namespace

Backdrop makeBackdrop(const std::shared_ptr<const EnvironmentMap>& map, Job& job) {
  if (!map) return {};
  Backdrop backdrop{map, nullptr, std::make_shared<const EnvironmentPoints>(*map, job)};
  if (map->report().mapping != EnvironmentMapping::LatLong)
    backdrop.sharp =
        std::make_shared<EnvironmentMap>(toLatLong(*map, kBackdropWidth, kBackdropWidth / 2, job));
  backdrop.blurred =
      std::make_shared<EnvironmentMap>(blurredLatLong(*backdrop.sharp, radians(kBlurDegrees), job));
  return backdrop;
}

void Relighter::setScene(std::shared_ptr<const Scene> scene) {
  if (scene == scene_) return;
  const bool same = scene && scene_ && sameGeometry(*scene, *scene_);
  scene_ = std::move(scene);
  middle_ = scene_ ? scene_->mesh.bounds().center() : Vec3(0);
  if (!same) {
    samples_.reset();
    nextSamples_.reset();
    transfer_.reset();
    patch_.reset();
  }
  materials_ = scene_ ? scene_->materials : std::vector<Material>{};
  ++sceneVersion_;
  ++materialVersion_;
  touchLight();
  Q_EMIT sceneChanged();
}

void Relighter::setSamples(std::shared_ptr<const SampleSet> samples) {
  nextSamples_.reset();
  if (samples == samples_) return;
  if (samples && transfer_ && transfer_->samples != samples->size()) {
    nextSamples_ = std::move(samples);
    return;
  }
  samples_ = std::move(samples);
  ++sceneVersion_;
  touchLight();
}

void Relighter::setTransfer(std::shared_ptr<const Transfer> transfer) {
  if (transfer == transfer_) return;
  if (transfer && nextSamples_ && transfer->samples == nextSamples_->size()) {
    samples_ = std::exchange(nextSamples_, nullptr);
    ++sceneVersion_;
  }
  if (transfer && samples_ && transfer->samples != samples_->size()) return;
  transfer_ = std::move(transfer);
  touchLight();
}

void Relighter::setEnvironment(std::shared_ptr<const EnvironmentMap> map, ShRgb coefficients,
                               Backdrop backdrop) {
  rig_.environment = std::move(map);
  environmentCoefficients_ = std::move(coefficients);
  backdrop_ = std::move(backdrop);
  lighting_.know(rig_.environment, backdrop_.points);
  ++environmentVersion_;
  touchLight();
  Q_EMIT environmentChanged();
}

void Relighter::setLights(const LightRig& rig, const MethodRecipe& method) {
  // Every edit of the recipe comes by here; most are of other things, and a picture takes time.
  if (sameLights(rig, rig_) && method == method_) return;
  const auto environment = rig_.environment;
  rig_ = rig;
  rig_.environment = environment;
  method_ = method;
  touchLight();
}

void Relighter::setMaterials(std::vector<Material> materials) {
  if (materials == materials_) return;
  materials_ = std::move(materials);
  ++materialVersion_;
  Q_EMIT changed();
}

void Relighter::setSurroundings(Surroundings surroundings) {
  if (surroundings.empty() && surroundings_.empty()) return;
  surroundings_ = std::move(surroundings);
  touchLight();
}

void Relighter::setEmission(std::vector<Rgb> emission) {
  if (surroundings_.empty() || emission.size() != surroundings_.emission.size()) return;
  surroundings_.emission = std::move(emission);
  touchLight();
}

void Relighter::setPatch(std::shared_ptr<const BiscaleSurface> patch) {
  if (patch == patch_ || (patch && (!scene_ || !sameGeometry(*patch->scene, *scene_)))) return;
  patch_ = std::move(patch);
  Q_EMIT changed();
}

std::shared_ptr<const BiscaleSurface> Relighter::shownPatch() const {
  const bool held = !transfer_ || transfer_->form != TransferForm::Diffuse || (patch_ && patch_->matte);
  return method_.name == "biscale" && held ? patch_ : nullptr;
}

const SceneLight& Relighter::lit() {
  if (std::exchange(lightOf_, lightVersion_) == lightVersion_) return light_;
  ShRgb environment(bands());
  const std::size_t known = std::min(environment.c.size(), environmentCoefficients_.c.size());
  std::copy_n(environmentCoefficients_.c.begin(), known, environment.c.begin());
  Job patient;
  return light_ = lighting_.light(rig_, environment, method_, surroundings_, middle_, patient);
}

ShRgb Relighter::wholeLight() const {
  constexpr int kBandsWithoutMap = 10;
  return projectLights(
      rig_, environmentCoefficients_.c.empty() ? ShRgb(kBandsWithoutMap) : environmentCoefficients_);
}

const SurfaceLight& Relighter::surface() {
  if (std::exchange(surfaceOf_, lightVersion_) == lightVersion_) return surface_;
  Transfer unshadowed;
  unshadowed.bands = bands();
  return surface_ = surfaceLight(shadowed() ? *transfer_ : unshadowed, light(),
                                 shadowed() ? *samples_ : SampleSet{});
}

void Relighter::touchLight() {
  ++lightVersion_;
  Q_EMIT changed();
}

}  // namespace prt::ui
