#pragma once
// Objects of a recipe that stand around the others (ObjectRecipe::captured), and the light of a scene with
// them: the one way in which the command line, the studio and exports light what is baked.

#include "libprt/light/captured.h"
#include "libprt/project/lights.h"
#include "libprt/project/products.h"
#include "libprt/project/recipe.h"
#include "libprt/shade/surroundings.h"

#include <memory>
#include <optional>
#include <vector>

namespace prt {

/// Whether the object stands around the others, and is seen.
bool isCaptured(const ObjectRecipe& object);
bool hasCaptured(const Recipe& recipe);
/// The same scene with all of it in the bake, as a path tracer sees it.
Recipe withCapturedInside(Recipe recipe);
/// [objects] what each sends of its own: nothing where it is not captured. Empty when none does.
std::vector<Rgb> emissionOf(const Recipe& recipe);
/// All that are, as the recipe has them now, not lit yet; objects keep their numbers. A copy of their meshes:
/// a millisecond or so. Null meshes are left out. Nothing where nothing is left, or the meshes are not as
/// many as the objects. Throws as flattenScene() does.
Surroundings surroundingsOf(const Recipe& recipe, const MeshProduct& meshes);

/// What surfaces are lit with.
struct SceneLight {
  ShRgb light;                ///< of the baked model, surroundings included, windowed as the method says
  Surroundings surroundings;  ///< seen with the model, as they are lit
};

/// Keeps what stays the same from one picture to the next: the cube while objects and model stay, the
/// environment's points while the map stays.
class SceneLighting {
 public:
  /// Points of a map that somebody has made already; made at first need otherwise.
  void know(std::shared_ptr<const EnvironmentMap> map, std::shared_ptr<const EnvironmentPoints> points);

  /// `environment`: projectEnvironment() of the rig's map; its bands are the result's, bit by bit that of
  /// lightFor() where nothing stands around. `middle`: of the model, from where its surroundings are seen.
  SceneLight light(const LightRig& rig, const ShRgb& environment, const MethodRecipe& method,
                   const Surroundings& surroundings, const Vec3& middle, Job& job);

 private:
  const EnvironmentPoints* pointsOf(const LightRig& rig, Job& job);

  std::shared_ptr<const EnvironmentMap> map_;
  std::shared_ptr<const EnvironmentPoints> points_;
  std::shared_ptr<const Scene> seen_;  // what view_ is of
  Vec3 middle_{0};
  std::optional<CubeView> view_;
};

}  // namespace prt
