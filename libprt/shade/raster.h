#pragma once
// What a camera sees of a mesh, by tiled rasterisation on the CPU. A pixel holds grid x grid regular
// samples; each sees the nearest triangle. Samples of one pixel that see the same triangle become one
// Fragment, to be shaded once.
//
// Vertices are snapped to 1/256 of a sample (coarser above 5460 samples a side, 1/16 at 65536) and edges
// follow the top-left rule in exact integer arithmetic: triangles that share an edge leave no gap and
// never claim a sample twice (Pineda 1988, "A Parallel Algorithm for Polygon Rasterization"). Triangles
// are clipped at a near plane so close (1e-9 of the scene) that it never shows. Both sides are drawn.
// The result does not depend on the number of threads.

#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/mesh/mesh.h"
#include "libprt/shade/camera.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace prt {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// Part of a pixel that shows one triangle.
struct Fragment {
  std::uint32_t triangle = kNoTriangle;
  Vec2 barycentric{0};        ///< weights of corners 1 and 2 at the mean of the samples, perspective-correct
  std::uint16_t samples = 0;  ///< of the pixel's grid * grid
  bool back = false;          ///< seen from behind
};

/// Samples of a rectangle of pixels, row by row at grid times the pixel resolution.
struct SampleTile {
  int x = 0, y = 0;                     ///< first pixel
  int width = 0, height = 0;            ///< in pixels
  int stride = 0;                       ///< samples from one row to the next
  std::vector<std::uint32_t> triangle;  ///< kNoTriangle where nothing is seen
  /// Larger = nearer: 1 / distance along the optical axis, for parallel rays 2 (nearest) to 1; 0 where
  /// nothing is seen.
  std::vector<float> nearness;
};

/// Fragments of a rectangle of pixels.
struct FragmentTile {
  int x = 0, y = 0;
  int width = 0, height = 0;
  std::vector<std::uint32_t> first;  ///< [width * height + 1] where each pixel's fragments begin
  std::vector<Fragment> fragments;

  /// Fragments of the pixel with index row * width + column inside the tile.
  std::span<const Fragment> pixel(std::size_t index) const {
    return {fragments.data() + first[index], fragments.data() + first[index + 1]};
  }
};

/// Everything a camera sees: reusable while camera and mesh stay, whatever the light does.
struct FragmentImage {
  int width = 0, height = 0;
  int grid = 1;
  std::vector<FragmentTile> tiles;  ///< cover the image without overlap
};

/// Another mesh in the same picture: samples where it is nearer show nothing of this one. Two meshes that are
/// each other's occluders share the picture: every sample is one's or the other's.
struct Occluder {
  const TriMesh* mesh = nullptr;  ///< null: none
  bool winsTies = false;          ///< hides what is as near too
};

/// Triangles set up and sorted into tiles; tiles can then be drawn independently, from any thread.
class Rasterizer {
 public:
  /// `grid` in 1..16; width and height >= 1 with grid * max(width, height) <= 65536. Throws ValueError.
  /// Keeps references to `mesh` and the occluder's, whose positions must be finite.
  Rasterizer(const TriMesh& mesh, const Camera& camera, int width, int height, int grid, Job& job,
             const Occluder& occluder = {});
  ~Rasterizer();

  std::size_t tileCount() const;
  /// Draws a tile; `out` is reused between calls to save allocation.
  void drawSamples(std::size_t tile, SampleTile& out) const;
  /// Draws a tile into `samples` and gathers its fragments.
  void drawFragments(std::size_t tile, SampleTile& samples, FragmentTile& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Draws the whole image.
FragmentImage rasterize(const TriMesh& mesh, const Camera& camera, int width, int height, int grid, Job& job,
                        const Occluder& occluder = {});

}  // namespace prt
