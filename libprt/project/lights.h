#pragma once
// The lights of a recipe, as renderers take them.

#include "libprt/light/built_in_skies.h"
#include "libprt/light/light_rig.h"
#include "libprt/project/recipe.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace prt {

/// Environment maps that were read already, so that turning a light does not read its file again. A map
/// is read anew when its file has changed. Keeps those that were asked for last.
class EnvironmentCache {
 public:
  /// Maps that are kept.
  static constexpr std::size_t kKept = 8;

  /// What an environment light shows, at its own angle and intensity. `folder`: what its path is relative to.
  /// Throws FileError and ValueError.
  std::shared_ptr<const EnvironmentMap> get(const LightRecipe& light, const std::filesystem::path& folder);
  /// A file relative to `folder`, or builtin:NAME with its usual settings.
  std::shared_ptr<const EnvironmentMap> get(const std::string& path, const std::string& mapping,
                                            const std::filesystem::path& folder);

 private:
  struct Entry {
    std::string key;
    std::shared_ptr<const EnvironmentMap> map;
  };
  std::vector<Entry> entries_;  // the last one asked for at the end
};

/// Whether the light is the built-in sky whose sun can be moved.
bool hasSun(const LightRecipe& light);
/// That sky. Its sun stands in the map's frame: the light's rotation is not in it.
ClearSky clearSkyOf(const LightRecipe& light);
/// Everything that decides what an environment light's map shows, but for the contents of its file.
std::string mapKey(const LightRecipe& light);
/// Where a circle, a directional light or the sun of a clear sky stands in the world: unit, the light's own
/// rotation applied.
Vec3 worldDirection(const LightRecipe& light);

/// All lights that are on, together. Throws ValueError when more than one environment is lit (intensity above
/// 0).
LightRig makeLightRig(std::span<const LightRecipe> lights, const std::filesystem::path& folder,
                      EnvironmentCache& cache);

/// Light damped against ringing: "none", "hann", "lanczos", "fejer", or "dering" for as little of the latter
/// as leaves no negative light. Throws ValueError for other names.
ShRgb windowed(const ShRgb& light, const std::string& window);
/// The window of light that is written as a picture, which holds nothing negative: the one that is asked for,
/// or for "none" the sharpest that leaves no negative light, "fejer". Negative light that "hann" and
/// "lanczos" leave becomes 0.
std::string windowOfPictures(const std::string& window);

/// Light in the bands of a transfer product, windowed as the method says.
ShRgb lightFor(const LightRig& lights, int bands, const MethodRecipe& method);
/// The same with the environment's projection at hand (projectEnvironment of as many bands).
ShRgb lightFor(const LightRig& lights, const ShRgb& environment, const MethodRecipe& method);

}  // namespace prt
