#pragma once
// What surfaces show of their patch where texels are smaller than pixels, or larger (the paper leaves both as
// future work).
//
// Exit radiance is linear in the response, and the response of a texel q of the patch is nearly
// sum over t of c_t(q) E_t (meso/rtt_compress.h). So c_t at the places that the id map names is a texture
// like any other: its mip levels 1, 2, .. hold means over 2 x 2, 4 x 4, .. texels of the map, and a pixel
// that covers many texels takes few numbers and meets them with the E_t (ALGORITHMS 6.5). Level 0 is no part
// of this: it is the id map and the whole radiance transfer texture, exactly.
//
// Every chart has levels of its own, so charts and gutters never bleed into each other however coarse a level
// is; only texels whose centres lie in the chart count. A patch laid by texture coordinates has one set of
// levels, of the patch itself, which repeats.

#include "libprt/core/job.h"
#include "libprt/meso/rtt.h"
#include "libprt/shade/footprint.h"
#include "libprt/shade/patch_cover.h"
#include "libprt/shade/response_table.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace prt {

/// Where a point of the surface lies in what is filtered.
struct FilterPlace {
  Vec2 at{0};  ///< in texels of the id map, from its top left; or of the patch, repeated
  std::uint32_t chart = 0;
};

/// Texels of level 0 around a place that belong to its chart, of each layer that they show; weights add up to
/// 1, or there are none.
struct FilterTexels {
  static constexpr std::size_t kMost = 4 * LayerShares::kMost;
  std::array<std::uint32_t, kMost> texel{};  ///< of the patch, see ResponseTable::layers()
  std::array<float, kMost> weight{};
  std::size_t count = 0;

  bool empty() const { return count == 0; }
  void add(std::uint32_t t, float w) { texel[count] = t, weight[count++] = w; }
};

class PatchFilter {
 public:
  static constexpr int kTerms = 16;
  /// Levels are chosen this much finer than a sample is wide: interpolation between texels blurs too.
  static constexpr float kSharper = 0.6f;
  using Coefficients = std::array<float, kTerms>;

  /// Of one chart at one level: texels [first, first + width * height), rows from the top.
  struct Rectangle {
    std::uint32_t first = 0;
    std::int32_t x = 0, y = 0;  ///< of the first texel, in texels of the level
    std::int32_t width = 0, height = 0;
  };

  /// Throws ValueError when the table is not that of `rtt`, Cancelled.
  PatchFilter(std::shared_ptr<const PatchCover> cover, const Rtt& rtt, Job& job);

  FilterPlace place(std::uint32_t triangle, const Vec2& barycentric) const;
  /// How a step of the weights of corners 1 and 2 moves it.
  Vec2 placeStep(std::uint32_t triangle, const Vec2& weights) const;
  /// Level of a sample so wide, in texels: 0 or less is level 0 alone, otherwise at most levels().
  float levelOf(float width) const;

  FilterTexels texelsAround(const FilterPlace& place) const;
  /// Adds weight times the coefficients at a level >= 1, between texels and levels.
  void add(const FilterPlace& place, float level, float weight, Coefficients& sum) const;
  /// False where the chart has not one texel of its own: level 0 alone shows it.
  bool holds(std::uint32_t chart) const { return rectangle(chart, 1).width > 0; }

  /// E_t as a table of 4 x 4 texels: texel t is term t.
  const ResponseTable& terms() const { return *terms_; }
  /// Relative error of the terms over the radiance transfer texture.
  double error() const { return error_; }
  int levels() const { return int(scale_.size()) - 1; }
  std::size_t bytes() const;

  // What shaders read.
  int size() const { return size_; }  ///< texels of the id map a side; 0: the patch repeats
  bool repeats() const { return size_ == 0; }
  std::span<const Rectangle> rectangles() const { return rectangles_; }          ///< [charts][levels]
  std::span<const Vec2> scales() const { return scale_; }                        ///< [levels + 1]
  std::span<const std::uint16_t> coefficients() const { return coefficients_; }  ///< halfs [texels][terms]
  std::span<const std::uint16_t> owners() const { return owner_; }               ///< [size * size]
  std::span<const std::uint32_t> charts() const { return chartOf_; }             ///< [F]

 private:
  struct Level;
  void buildCharts(const std::vector<float>& texels, Job& job);
  void buildRepeated(const std::vector<float>& texels);
  void store(const Level& level, Rectangle& rectangle);
  const Rectangle& rectangle(std::uint32_t chart, int level) const {
    return rectangles_[std::size_t(chart) * std::size_t(levels()) + std::size_t(level - 1)];
  }
  int patchTexel(const Vec2& uv) const;
  void addLevel(const FilterPlace& place, int level, float weight, Coefficients& sum) const;

  std::shared_ptr<const PatchCover> cover_;
  std::shared_ptr<const ResponseTable> terms_;
  int texels_ = 0;  // of the patch, a side
  int size_ = 0;    // of the id map; 0: there is none
  double error_ = 0;
  std::vector<Vec2> corners_;           // [3F] places, in level 0's texels
  std::vector<std::uint32_t> chartOf_;  // [F]
  std::vector<std::uint16_t> owner_;    // whose texel of the id map it is: the chart's number, low 16 bits
  std::vector<Vec2> scale_;             // texels of a level per texel of level 0
  std::vector<Rectangle> rectangles_;
  std::vector<std::uint16_t> coefficients_;
};

}  // namespace prt
