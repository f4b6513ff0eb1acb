#pragma once
// What figures are made with: a patch on a model, baked, and pictures of it. Internal to study.

#include "libprt/core/image.h"
#include "libprt/light/light_rig.h"
#include "libprt/mesh/mesh.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/recipe.h"
#include "libprt/shade/biscale_view.h"
#include "libprt/shade/camera.h"
#include "libprt/study/figures.h"

#include <chrono>
#include <memory>
#include <string>

namespace prt {

/// A model that carries a patch, with settings that suit pictures: the request's mesh, or this built-in one.
Recipe figureRecipe(const FigureRequest& request, const char* builtIn);

/// Linear radiance, as the screen shows it.
void writeFigurePicture(const std::filesystem::path& file, const Image& linear);
/// Numbers that are shown already.
void writeEncodedPicture(const std::filesystem::path& file, const Image& encoded);

/// A circle light from the upper left before a dim sky: one that casts shadows.
LightRig figureLamp();

/// A three-quarter view, as near as the model fits into a picture of this size with a small margin.
Camera figureCamera(const TriMesh& mesh, int width, int height);

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const;

 private:
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// Bakes again and again what changes; 4:3 pictures of what was baked last.
class FigureModel {
 public:
  static constexpr int kWidth = 960, kHeight = 720;

  void bake(const Recipe& recipe, Job& job);
  /// By the method and with the settings of `recipe`, which asks for the same bake.
  Image picture(const Recipe& recipe, const LightRig& rig, Job& job) const;
  Camera camera() const;
  const Products& products() const { return products_; }
  std::shared_ptr<const BiscaleSurface> patch() const { return patch_; }

 private:
  Pipeline pipeline_{nullptr, {}};
  Products products_;
  std::shared_ptr<const BiscaleSurface> patch_;
};

}  // namespace prt
