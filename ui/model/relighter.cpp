#include "ui/model/relighter.h"

#include "libprt/project/lights.h"

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {

bool sameGeometry(const Scene& a, const Scene& b) {
  return a.mesh.positions == b.mesh.positions && a.mesh.normals == b.mesh.normals && a.mesh.triangles == b.mesh.triangles;
}

}  // namespace

void Relighter::setScene(std::shared_ptr<const Scene> scene) {
  if (scene == scene_) return;
  const bool same = scene && scene_ && sameGeometry(*scene, *scene_);
  scene_ = std::move(scene);
  if (!same) {
    samples_.reset();
    nextSamples_.reset();
    transfer_.reset();
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

void Relighter::setEnvironment(std::shared_ptr<const EnvironmentMap> map, ShRgb coefficients) {
  rig_.environment = std::move(map);
  environmentCoefficients_ = std::move(coefficients);
  ++environmentVersion_;
  touchLight();
  Q_EMIT environmentChanged();
}

void Relighter::setLights(const LightRig& rig, const MethodRecipe& method) {
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

const ShRgb& Relighter::light() {
  apply();
  return light_;
}

ShRgb Relighter::wholeLight() const {
  constexpr int kBandsWithoutMap = 10;
  return projectLights(rig_, environmentCoefficients_.c.empty() ? ShRgb(kBandsWithoutMap) : environmentCoefficients_);
}

const SurfaceLight& Relighter::surface() {
  apply();
  return surface_;
}

void Relighter::touchLight() {
  ++lightVersion_;
  Q_EMIT changed();
}

// Brings the light to the surface when something changed since the last time.
void Relighter::apply() {
  if (appliedVersion_ == lightVersion_) return;
  appliedVersion_ = lightVersion_;
  ShRgb environment(bands());
  const std::size_t known = std::min(environment.c.size(), environmentCoefficients_.c.size());
  std::copy_n(environmentCoefficients_.c.begin(), known, environment.c.begin());
  light_ = lightFor(rig_, environment, method_);
  Transfer unshadowed;
  unshadowed.bands = bands();
  const bool ready = transfer_ && samples_;
  surface_ = surfaceLight(ready ? *transfer_ : unshadowed, light_, ready ? *samples_ : SampleSet{});
}

}  // namespace prt::ui
