#pragma once
// Patches made of heights on a grid, from an image or from a function. Bi-Scale Radiance Transfer,
// section 4.2: "patch geometry can be modeled as a height field"; the built-in ones are in patch_generate.h.

#include "libprt/meso/patch.h"

#include <functional>

namespace prt {

/// Heights on a periodic grid: row 0 is v = 0; value (i, j) stands at u = i / columns, v = j / rows.
struct HeightGrid {
  int columns = 0, rows = 0;
  std::vector<float> heights;  ///< [rows * columns], relative to the patch's width

  float at(int i, int j) const {  ///< any i and j: they repeat
    const int x = (i % columns + columns) % columns, y = (j % rows + rows) % rows;
    return heights[std::size_t(y) * std::size_t(columns) + std::size_t(x)];
  }
};

/// Most vertices along a side.
inline constexpr int kMaxHeightGrid = 512;

/// Heights of a function of (u, v), at `side` x `side` places.
HeightGrid sampleHeights(int side, const std::function<float(const Vec2& uv)>& height);

/// Heights of an image's luminance: its darkest pixel is 0, its brightest `depth`; every pixel is a vertex,
/// or where the image has more than `mostSide` pixels along a side, the mean of some. The image repeats; its
/// top row is v = 1. Throws ValueError when a pixel is not finite or the image is empty or constant.
HeightGrid heightsFromImage(const Image& image, float depth, int mostSide = 256);

/// The patch: a triangulated grid with smooth normals.
Patch heightField(const HeightGrid& grid, const Rgb& albedo, Job* job = nullptr);

/// A flat patch at height 0; what is on it is up to its textures.
Patch flatPatch(const Rgb& albedo);

/// A V-groove along v with sharp edges, for tests of closed forms: both walls rise from u = 1/2 at the
/// opening angle (radians, between the walls), cut into `cells` strips each.
Patch vGroove(double openingAngle, int cells, const Rgb& albedo);

}  // namespace prt
