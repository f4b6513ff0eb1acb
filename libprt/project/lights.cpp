#include "libprt/project/lights.h"

#include "libprt/core/error.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/environment_io.h"
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

}  // namespace prt
