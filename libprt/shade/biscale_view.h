#pragma once
// What a camera sees of a surface that carries a patch, in the form that is shaded again and again while
// camera, mesh and patch stay: for every fragment the frames that its light comes from, its texel of the
// patch and the views between which the table is interpolated.

#include "libprt/core/job.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/live_pixels.h"
#include "libprt/shade/patch_cover.h"
#include "libprt/shade/patch_filter.h"
#include "libprt/shade/plain_objects.h"
#include "libprt/shade/raster.h"
#include "libprt/shade/response_table.h"
#include "libprt/shade/shading_frames.h"
#include "libprt/transport/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace prt {

/// What stays while the light and the camera change. Shared, immutable.
struct BiscaleSurface {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const TangentFrames> frames;  ///< of the scene's mesh; the patch lies along them
  std::shared_ptr<const PatchCover> cover;
  std::shared_ptr<const ResponseTable> responses;
  ShadingFrames shading;
  /// Not null: pictures are filtered in space, see patch_filter.h. Of this cover and these responses.
  std::shared_ptr<const PatchFilter> filter = {};
  /// Not null: some objects show their material in place of the patch. Of this scene, of as many bands as
  /// the responses.
  std::shared_ptr<const PlainObjects> plain = {};

  /// Every place answers as a matte plane does: diffuse vectors hold all that it shows.
  bool matte = false;

  BiscaleSurface(std::shared_ptr<const Scene> scene, std::shared_ptr<const TangentFrames> frames,
                 std::shared_ptr<const PatchCover> cover, std::shared_ptr<const ResponseTable> responses);
};

/// One part of a pixel that shows the surface.
struct BiscaleFragment {
  std::uint32_t pixel = 0;                ///< row * width + column
  float share = 0;                        ///< of the pixel
  std::array<std::uint32_t, 3> corner{};  ///< in BiscaleView::frames
  Vec3 weight{0};                         ///< and their weights
  std::uint32_t texel = 0;  ///< of the patch, or of PlainObjects; filtered: place in BiscaleTile::responses
  bool filtered = false;    ///< its response is one of the tile's, views interpolated: of more than one texel
  bool plain = false;       ///< shows its material: texel and views are of PlainObjects
  std::array<std::uint16_t, 4> view{};  ///< cells of the view square
  Vec4 viewWeight{0};                   ///< add up to 1
};

struct BiscaleTile : PixelTile {
  std::vector<BiscaleFragment> fragments;  ///< by pixel, row by row
  std::vector<std::uint16_t> responses;    ///< of filtered fragments: halfs [channels][padded] each
};

struct BiscaleView {
  int width = 0, height = 0;
  std::vector<BiscaleTile> tiles;
  std::vector<std::uint32_t>
      frames;  ///< those of BiscaleSurface::shading that anything seen needs, ascending
};

struct BiscaleViewOptions {
  int grid = 1;               ///< grid x grid samples a pixel
  bool viewDependent = true;  ///< false: the patch, not the rest, looks from everywhere as from above
  Occluder occluder = {};     ///< seen in front of the surface
};

/// Surfaces seen from behind (two-sided ones too), and places that the id map leaves empty, are black. Throws
/// Cancelled.
BiscaleView makeBiscaleView(const BiscaleSurface& surface, const Camera& camera, int width, int height,
                            const BiscaleViewOptions& options, Job& job);

}  // namespace prt
