#pragma once
// The frames that benches of bi-scale pictures draw: 512 x 512 of one baked scene, light and view both
// changing from frame to frame.

#include "libprt/light/light_rig.h"
#include "libprt/project/pipeline.h"
#include "libprt/shade/live_renderer.h"

namespace prt {

/// A woven rock: what the benches bake.
Recipe biscaleBenchRecipe();

class BiscaleStage {
 public:
  static constexpr int kSide = 512;

  /// `products`: stagesOfPicture() of the recipe.
  BiscaleStage(const Recipe& recipe, const Products& products);

  /// Turns lights and camera to where they are in a frame.
  void step(int frame);
  /// Projects the lights: the scene's light is the frame's.
  void light();

  const LiveScene& scene() const { return scene_; }
  const LivePicture& picture() const { return picture_; }

 private:
  MethodRecipe method_;
  LiveScene scene_;
  LivePicture picture_;
  LightRig rig_;
  ShRgb environment_;
  Camera home_;
};

}  // namespace prt
