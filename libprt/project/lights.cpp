#include "libprt/project/lights.h"

#include "libprt/basis/sh_window.h"
#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/environment_io.h"
#include "libprt/light/projection.h"
#include "libprt/project/source_hash.h"

#include <optional>

namespace prt {
namespace {

EnvironmentMap readMap(const std::string& path, const std::string& mapping, const std::filesystem::path& folder) {
  if (path.starts_with("builtin:")) return builtInSky(path.substr(8));
  std::optional<EnvironmentMapping> named;
  if (mapping != "auto") named = environmentMappingFromString(mapping);
  return loadEnvironment(folder / path, named);
}

void addEnvironment(LightRig& rig, const LightRecipe& light, const std::filesystem::path& folder, EnvironmentCache& cache) {
  if (light.intensity == 0) return;
  if (rig.environment)
    throw ValueError("two environments are lit", "lights: " + light.name, "set the intensity of all but one to 0");
  rig.environment = cache.get(light.path, light.mapping, folder);
  rig.rotation = float(radians(light.rotation));
  rig.intensity = light.intensity;
}

/// Direction of a light after its own rotation about +Y.
Vec3 turned(const LightRecipe& light) {
  return environmentRotation(float(radians(light.rotation))) * normalize(light.direction);
}

}  // namespace

std::shared_ptr<const EnvironmentMap> EnvironmentCache::get(const std::string& path, const std::string& mapping,
                                                            const std::filesystem::path& folder) {
  const std::string contents = isBuiltin(path) ? path : hashSource(folder / path);
  std::shared_ptr<const EnvironmentMap>& map = maps_[contents + " " + mapping];
  if (!map) map = std::make_shared<EnvironmentMap>(readMap(path, mapping, folder));
  return map;
}

LightRig makeLightRig(std::span<const LightRecipe> lights, const std::filesystem::path& folder, EnvironmentCache& cache) {
  LightRig rig;
  for (const LightRecipe& light : lights) {
    const Rgb color = light.radiance * light.intensity;
    switch (light.kind) {
      case LightKind::Environment: addEnvironment(rig, light, folder, cache); break;
      case LightKind::Circle: rig.circles.push_back({turned(light), float(radians(light.angle / 2)), color}); break;
      case LightKind::Directional: rig.directionals.push_back({turned(light), color}); break;
      case LightKind::Constant: rig.constant += color; break;
    }
  }
  validate(rig);
  return rig;
}

ShRgb windowed(const ShRgb& light, const std::string& window) {
  if (window == "none") return light;
  if (window == "dering") return dering(light).light;
  ShRgb out = light;
  if (window == "hann") scaleBands(hannWindow(light.bands), out);
  else if (window == "lanczos") scaleBands(lanczosWindow(light.bands), out);
  else if (window == "fejer") scaleBands(fejerWindow(light.bands), out);
  else throw ValueError("there is no window '" + window + "'", "method.window", "use none, hann, lanczos, fejer or dering");
  return out;
}

ShRgb lightFor(const LightRig& lights, int bands, const MethodRecipe& method) {
  return windowed(projectLights(lights, bands), method.window);
}

ShRgb lightFor(const LightRig& lights, const ShRgb& environment, const MethodRecipe& method) {
  return windowed(projectLights(lights, environment), method.window);
}

}  // namespace prt
