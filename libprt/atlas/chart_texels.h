#pragma once
// The texels of every chart for itself, at any resolution. What is worked out at them and interpolated
// between them never meets another chart's values, whatever lies beside the chart in the atlas and however
// coarse the texels are; so it takes no gutter.

#include "libprt/atlas/atlas.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace prt {

/// Where a triangle lies among the texels of its chart: shaders read it as it stands.
struct TexelTriangle {
  Vec2 corner{0};                 ///< corner 0, in texels from the centre of the rectangle's first one
  Vec2 edge1{0}, edge2{0};        ///< from there to corners 1 and 2
  std::uint32_t first = 0;        ///< where the chart's rectangle begins in TexelGrid::texels
  std::uint32_t widthHeight = 0;  ///< of the rectangle, 16 bits each, the width low
};
static_assert(sizeof(TexelTriangle) == 32);

/// Texels around a point and their bilinear weights.
struct TexelPlace {
  std::array<std::uint32_t, 4> texel;
  std::array<float, 4> weight;
};

/// How a point of the surface finds its texels.
struct TexelGrid {
  struct Rectangle {
    std::uint32_t first, width, height;
  };
  /// Set in the entries of `texels` that no point of the chart is near to; what is below names some texel.
  static constexpr std::uint32_t kFar = 0x80000000u;

  int size = 0;                          ///< texels along a side of the whole atlas
  std::size_t count = 0;                 ///< texels
  std::vector<TexelTriangle> triangles;  ///< [F]
  std::vector<Rectangle> charts;         ///< around each chart
  std::vector<std::uint32_t> texels;     ///< of all rectangles, row by row, v upwards: the number of a texel

  /// `barycentric`: weights of corners 1 and 2. Safe for any point; of the triangle's points all four texels
  /// belong to its chart and lie within a texel of it.
  TexelPlace at(std::uint32_t triangle, const Vec2& barycentric) const {
    const TexelTriangle& t = triangles[triangle];
    const Vec2 p = t.corner + barycentric.x * t.edge1 + barycentric.y * t.edge2;
    const std::uint32_t width = t.widthHeight & 0xffffu, height = t.widthHeight >> 16;
    const auto cell = [](float x, std::uint32_t extent) {
      return x > 0 ? std::min(std::uint32_t(x), extent - 2) : 0u;  // NaN gives 0
    };
    const std::uint32_t x = cell(p.x, width), y = cell(p.y, height);
    const auto part = [](float x01) { return x01 > 0 ? std::min(x01, 1.0f) : 0.0f; };
    const float fx = part(p.x - float(x)), fy = part(p.y - float(y));
    const std::uint32_t* row = texels.data() + t.first + std::size_t(y) * width + x;
    return {{row[0] & ~kFar, row[1] & ~kFar, row[width] & ~kFar, row[width + 1] & ~kFar},
            {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
  }
};

/// All texels that points of the charts are interpolated from, and the point of the surface that each shows:
/// that at its centre, beyond the chart's rim the nearest one on the rim.
struct ChartTexels {
  std::shared_ptr<const TexelGrid> grid;
  std::vector<std::uint32_t> triangle;  ///< [texels]
  std::vector<Vec2> barycentric;        ///< [texels] weights of corners 1 and 2
};

/// `size`: texels along a side of the atlas, 4 .. 16384. Throws ValueError beyond, Cancelled.
ChartTexels makeChartTexels(const Atlas& atlas, int size, Job& job);

}  // namespace prt
