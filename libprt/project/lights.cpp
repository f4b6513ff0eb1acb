#include "libprt/project/lights.h"

#include "libprt/basis/sh_window.h"
#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"
#include "libprt/light/environment_io.h"
#include "libprt/light/projection.h"
#include "libprt/light/sky_angles.h"
#include "libprt/project/source_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace prt {
namespace {

EnvironmentMap readMap(const LightRecipe& light, const std::filesystem::path& folder) {
  if (hasSun(light)) return clearSky(clearSkyOf(light));
  if (light.path.starts_with("builtin:")) return builtInSky(light.path.substr(8));
  std::optional<EnvironmentMapping> named;
  if (light.mapping != "auto") named = environmentMappingFromString(light.mapping);
  return loadEnvironment(folder / light.path, named);
}

void addEnvironment(LightRig& rig, const LightRecipe& light, const std::filesystem::path& folder,
                    EnvironmentCache& cache) {
  if (light.intensity == 0) return;
  if (rig.environment)
    throw ValueError("two environments are lit", "lights: " + light.name, "switch all but one off");
  rig.environment = cache.get(light, folder);
  rig.rotation = float(radians(light.rotation));
  rig.intensity = light.intensity;
}

}  // namespace

bool hasSun(const LightRecipe& light) {
  return light.kind == LightKind::Environment && light.path == "builtin:clear-sky";
}

ClearSky clearSkyOf(const LightRecipe& light) {
  return {.sunDirection = directionOf(SkyAngles{radians(light.sunAzimuth), radians(light.sunElevation)})};
}

std::string mapKey(const LightRecipe& light) {
  if (hasSun(light)) return fmt::format("{} {} {}", light.path, light.sunAzimuth, light.sunElevation);
  return fmt::format("{} {}", light.path, light.mapping);
}

Vec3 worldDirection(const LightRecipe& light) {
  const Vec3 own = hasSun(light) ? clearSkyOf(light).sunDirection : normalize(light.direction);
  return environmentRotation(float(radians(light.rotation))) * own;
}

std::shared_ptr<const EnvironmentMap> EnvironmentCache::get(const LightRecipe& light,
                                                            const std::filesystem::path& folder) {
  std::string key = mapKey(light);
  if (!isBuiltin(light.path)) key += ' ' + hashSource(folder / light.path);
  const auto known =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
  if (known != entries_.end()) {
    std::rotate(known, known + 1, entries_.end());
  } else {
    entries_.push_back({key, std::make_shared<EnvironmentMap>(readMap(light, folder))});
    if (entries_.size() > kKept) entries_.erase(entries_.begin());
  }
  return entries_.back().map;
}

std::shared_ptr<const EnvironmentMap> EnvironmentCache::get(const std::string& path,
                                                            const std::string& mapping,
                                                            const std::filesystem::path& folder) {
  return get(LightRecipe{.path = path, .mapping = mapping}, folder);
}

LightRig makeLightRig(std::span<const LightRecipe> lights, const std::filesystem::path& folder,
                      EnvironmentCache& cache) {
  LightRig rig;
  for (const LightRecipe& light : lights) {
    if (!light.on) continue;
    const Rgb color = light.radiance * light.intensity;
    switch (light.kind) {
      case LightKind::Environment:
        addEnvironment(rig, light, folder, cache);
        break;
      case LightKind::Circle:
        rig.circles.push_back({worldDirection(light), float(radians(light.angle / 2)), color});
        break;
      case LightKind::Directional:
        rig.directionals.push_back({worldDirection(light), color});
        break;
      case LightKind::Constant:
        rig.constant += color;
        break;
    }
  }
  validate(rig);
  return rig;
}

ShRgb windowed(const ShRgb& light, const std::string& window) {
  if (window == "none") return light;
  if (window == "dering") return dering(light).light;
  ShRgb out = light;
  if (window == "hann")
    scaleBands(hannWindow(light.bands), out);
  else if (window == "lanczos")
    scaleBands(lanczosWindow(light.bands), out);
  else if (window == "fejer")
    scaleBands(fejerWindow(light.bands), out);
  else
    throw ValueError("there is no window '" + window + "'", "method.window",
                     "use none, hann, lanczos, fejer or dering");
  return out;
}

std::string windowOfPictures(const std::string& window) {
  return window == "none" ? "fejer" : window;
}

ShRgb lightFor(const LightRig& lights, int bands, const MethodRecipe& method) {
  return windowed(projectLights(lights, bands), method.window);
}

ShRgb lightFor(const LightRig& lights, const ShRgb& environment, const MethodRecipe& method) {
  return windowed(projectLights(lights, environment), method.window);
}

}  // namespace prt
