#pragma once
// A scene that bakes in a moment, for tests of the studio.

#include "libprt/project/recipe.h"

namespace prt::test {

inline Recipe smallScene() {
  Recipe recipe;
  recipe.objects[0].name = "vase";
  recipe.objects[0].mesh.path = "builtin:vase";
  recipe.objects[0].mesh.detail = 0.25f;
  recipe.objects[0].material.albedo = Rgb(0.7f, 0.4f, 0.3f);
  recipe.transfer.rays = 256;
  recipe.transfer.bounces = 1;
  return recipe;
}

}  // namespace prt::test
