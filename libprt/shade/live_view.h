#pragma once
// What a camera sees, in the form that LiveRenderer shades again and again while camera and mesh stay.

#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/live_pixels.h"
#include "libprt/shade/raster.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Fragments of a rectangle of pixels that reflect light, row by row; arrays end with copies of the last one,
/// without a share, up to a multiple of kLiveLanes.
struct LiveTile : PixelTile {
  std::size_t count = 0;             ///< fragments, without the copies
  std::vector<std::uint32_t> pixel;  ///< row * width + column
  std::vector<float> share;          ///< of the pixel
  std::vector<std::uint32_t> object;
  std::vector<std::array<std::uint32_t, 4>> slot;  ///< of the samples around, in LiveView::samples
  std::vector<Vec4> weight;                        ///< and their weights
  std::array<std::vector<float>, 3> normal, view;  ///< unit, on the side that is seen; towards the viewer
};

inline constexpr std::size_t kLiveLanes = 8;

struct LiveView {
  std::vector<LiveTile> tiles;
  int around = 3;                      ///< samples that weigh something; the fourth of 3 weighs nothing
  std::vector<std::uint32_t> samples;  ///< those that anything seen needs, ascending
};

/// `covering`: samples that cover the scene's surface; null: its vertices, no backs. `twoSided` [objects]
/// tells which reflect on their back sides. grid x grid samples a pixel. What `occluder` hides is left out.
LiveView makeLiveView(const Scene& scene, const SampleSet* covering, const std::vector<bool>& twoSided,
                      const Camera& camera, int width, int height, int grid, Job& job,
                      const Occluder& occluder = {});

}  // namespace prt
