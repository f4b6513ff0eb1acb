#include "libprt/project/errors.h"

#include "libprt/project/lights.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/products.h"

#include <algorithm>

namespace prt {
namespace {

TransferForm formOf(TransferKind kind) {
  switch (kind) {
    case TransferKind::None:
      return TransferForm::None;
    case TransferKind::Visibility:
      return TransferForm::Visibility;
    case TransferKind::Matrix:
      return TransferForm::Matrix;
    default:
      return TransferForm::Diffuse;
  }
}

ShRgb inBands(const ShRgb& light, int bands) {
  ShRgb out(bands);
  std::copy_n(light.c.begin(), std::min(light.c.size(), out.c.size()), out.c.begin());
  return out;
}

}  // namespace

TransferSettings transferSettings(const Recipe& recipe) {
  const TransferRecipe t = resolved(recipe).transfer;
  TransferSettings settings;
  settings.form = formOf(t.kind);
  settings.bands = t.bands;
  settings.rays = t.rays;
  settings.bounces = t.bounces;
  settings.shadows = t.shadows;
  settings.stopThreshold = t.threshold;
  settings.storage = t.storage == TransferStorage::Half ? DType::f16 : DType::f32;
  settings.seed = t.seed;
  check(settings);
  return settings;
}

ErrorProbe probeErrors(const Scene& geometry, const SampleSet& samples,
                       std::shared_ptr<const Transfer> transfer, const Recipe& recipe, Job& job,
                       const std::function<void(ErrorProbe)>& preview) {
  const auto scene = std::make_shared<const Scene>(withMaterials(geometry, recipe));
  const auto rays = std::make_shared<const RayScene>(*scene, job);
  return ErrorProbe::measure(scene, rays, samples, std::move(transfer), transferSettings(recipe), job,
                             preview);
}

JudgedLight judgedLight(const ShRgb& whole, int bands, const MethodRecipe& method) {
  return {inBands(whole, std::max(bands, kErrorBands)), windowed(inBands(whole, bands), method.window)};
}

JudgedLight judgedLight(const LightRig& lights, int bands, const MethodRecipe& method) {
  return judgedLight(projectLights(lights, std::max(bands, kErrorBands)), bands, method);
}

}  // namespace prt
