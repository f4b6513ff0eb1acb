#pragma once
// The lights of a recipe, as renderers take them.

#include "libprt/light/light_rig.h"
#include "libprt/project/recipe.h"

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace prt {

/// Environment maps that were read already, so that turning a light does not read its file again. A map
/// is read anew when its file has changed.
class EnvironmentCache {
 public:
  /// `path`: a file relative to `folder`, or builtin:NAME. Throws FileError and ValueError.
  std::shared_ptr<const EnvironmentMap> get(const std::string& path, const std::string& mapping,
                                            const std::filesystem::path& folder);

 private:
  std::map<std::string, std::shared_ptr<const EnvironmentMap>> maps_;
};

/// All lights together. Throws ValueError when more than one environment is lit (intensity above 0).
LightRig makeLightRig(std::span<const LightRecipe> lights, const std::filesystem::path& folder, EnvironmentCache& cache);

/// Light damped against ringing: "none", "hann", "lanczos", "fejer", or "dering" for as little of the latter
/// as leaves no negative light. Throws ValueError for other names.
ShRgb windowed(const ShRgb& light, const std::string& window);

/// Light in the bands of a transfer product, windowed as the method says.
ShRgb lightFor(const LightRig& lights, int bands, const MethodRecipe& method);
/// The same with the environment's projection at hand (projectEnvironment of as many bands).
ShRgb lightFor(const LightRig& lights, const ShRgb& environment, const MethodRecipe& method);

}  // namespace prt
