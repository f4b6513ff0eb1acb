#pragma once
// Pictures that change many times a second, on the CPU: the twin of gl/scene_renderer.h for machines without
// a graphics card. The same picture as render.h makes (tests compare them), as the screen shows it: eight
// bits, sRGB.
//
// What it works out is kept for as long as its inputs stay the same: what the camera sees (triangle, weights,
// normal and view of every fragment), light at the samples, tables of lobes. When only the light turns,
// transfer is applied at the samples that are seen, and the fragments are shaded again, eight at a time;
// nothing is rasterised.

#include "libprt/basis/sh.h"
#include "libprt/core/job.h"
#include "libprt/light/environment.h"
#include "libprt/light/light_rig.h"
#include "libprt/shade/biscale.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/display_table.h"
#include "libprt/shade/live_shading.h"
#include "libprt/shade/live_view.h"
#include "libprt/shade/surroundings.h"
#include "libprt/shade/tonemap.h"
#include "libprt/transport/transfer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace prt {

/// What is drawn. Shared products are immutable: a new one is told from the old one by its address.
struct LiveScene {
  std::shared_ptr<const Scene> scene;                 ///< null: nothing but the background
  std::shared_ptr<const SampleSet> samples;           ///< of the transfer; null: there is none yet
  std::shared_ptr<const Transfer> transfer;           ///< null: light arrives without shadows
  std::vector<Material> materials;                    ///< [objects], in place of the scene's
  ShRgb light;                                        ///< of at most 10 bands
  std::shared_ptr<const EnvironmentMap> environment;  ///< behind the model, lat-long; null: none
  float environmentRotation = 0;                      ///< radians, counter-clockwise seen from +Y
  float environmentIntensity = 1;
  // Further light that is seen behind the model. With none of the three there is `behind`.
  std::vector<CircleLight> circles = {};
  Rgb constant{0};
  /// Not null: the scene carries a patch, shown by biscale.h; `materials` have no part in it.
  std::shared_ptr<const BiscaleSurface> patch = {};
  bool viewDependent = true;       ///< false: the patch looks from everywhere as it does from above
  Surroundings surroundings = {};  ///< objects that are seen with the scene, as they are lit
};

struct LivePicture {
  Camera camera;
  int width = 0;
  int height = 0;
  int grid = 1;   ///< grid x grid samples per pixel, averaged as the screen shows them
  Rgb behind{0};  ///< where nothing is drawn, as the screen shows it
  ToneSettings tone = {};
  float gridSpacing = 0;  ///< of the ground grid, see ground_grid.h; 0: none
};

class LiveRenderer {
 public:
  /// Fills pixels[width * height], rows from the top, with 0xffRRGGBB. Throws ValueError when transfer and
  /// samples do not belong to the scene, and Cancelled.
  void draw(const LiveScene& scene, const LivePicture& picture, std::span<std::uint32_t> pixels, Job& job);

 private:
  void followView(const LiveScene& scene, const LivePicture& picture, Job& job);
  void followLight(const LiveScene& scene, Job& job);
  void viewAround(const LiveScene& scene, const LivePicture& picture, Job& job);
  void lightAround(const LiveScene& scene, Job& job);

  // What the view was made from, and the light.
  struct ViewKey {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const SampleSet> samples;
    std::vector<bool> twoSided;
    Camera camera;
    int width = 0, height = 0, grid = 0;
    std::shared_ptr<const BiscaleSurface> patch;
    bool viewDependent = true;
    std::shared_ptr<const Scene> surroundings;
    bool operator==(const ViewKey&) const = default;
  };
  struct LightKey {
    std::shared_ptr<const Transfer> transfer;
    std::vector<Rgb> light;
    std::uint64_t view = 0;
    bool operator==(const LightKey&) const = default;
  };
  std::optional<ViewKey> viewKey_;
  std::optional<LightKey> lightKey_;
  std::uint64_t viewNumber_ = 0;

  LiveView view_;
  LiveLight light_;
  LiveMaterials materials_;
  LiveView around_;  // without tiles where there is nothing around
  LiveLight aroundLight_;
  LiveMaterials aroundMaterials_;
  BiscaleView patchView_;
  BiscaleLight patchLight_;
  std::optional<DisplayTable> display_;
};

}  // namespace prt
