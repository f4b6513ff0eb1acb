#include "libprt/shade/patch_filter.h"

#include "libprt/atlas/geometry_image.h"
#include "libprt/core/half.h"
#include "libprt/core/parallel.h"
#include "libprt/meso/rtt_compress.h"
#include "libprt/shade/half_lanes.h"
#include "libprt/synthesis/surface_point.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace prt {
namespace {

using sh_kernel::kLanes;
using sh_kernel::Lanes;

constexpr std::size_t kTerms = PatchFilter::kTerms;
static_assert(kTerms % std::size_t(kLanes) == 0);

/// Weight of a texel that a chart only reaches into: nothing where others count, all where none does.
constexpr float kRim = 1e-3f;

/// E_t as the table of a patch of 4 x 4 texels.
Rtt tableOfTerms(const RttFactors& factors) {
  Rtt out(4, factors.views, factors.bands, factors.channels);
  out.colour = factors.colour;
  std::copy(factors.responses.begin(), factors.responses.end(), out.values.begin());
  return out;
}

int wrapped(int x, int n) {
  const int rest = x % n;
  return rest < 0 ? rest + n : rest;
}

}  // namespace

/// One level of one chart while it is made.
struct PatchFilter::Level {
  int x = 0, y = 0, width = 0, height = 0;
  std::vector<float> values;   // [height][width][terms]
  std::vector<float> weights;  // [height][width] texels of level 0 that count

  void resize() {
    values.assign(std::size_t(width) * std::size_t(height) * kTerms, 0.0f);
    weights.assign(std::size_t(width) * std::size_t(height), 0.0f);
  }
  std::size_t at(int cx, int cy) const {
    return std::size_t(cy - y) * std::size_t(width) + std::size_t(cx - x);
  }
  void add(std::size_t to, const float* from, float weight) {
    for (std::size_t t = 0; t < kTerms; ++t) values[to * kTerms + t] += weight * from[t];
    weights[to] += weight;
  }
  /// Sums become means.
  void divide() {
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i] > 0)
        for (std::size_t t = 0; t < kTerms; ++t) values[i * kTerms + t] /= weights[i];
  }
  void take(std::size_t to, const float* from) {
    std::copy_n(from, kTerms, values.begin() + std::ptrdiff_t(to * kTerms));
  }

  Level parent() const {
    Level up;
    up.x = x >> 1, up.y = y >> 1;
    up.width = ((x + width - 1) >> 1) - up.x + 1, up.height = ((y + height - 1) >> 1) - up.y + 1;
    up.resize();
    for (int cy = y; cy < y + height; ++cy)
      for (int cx = x; cx < x + width; ++cx) {
        const std::size_t i = at(cx, cy);
        if (weights[i] > 0) up.add(up.at(cx >> 1, cy >> 1), values.data() + i * kTerms, weights[i]);
      }
    up.divide();
    return up;
  }
  /// Texels without a value of their own, around the chart, take the next level's.
  void fillFrom(const Level& up) {
    for (int cy = y; cy < y + height; ++cy)
      for (int cx = x; cx < x + width; ++cx)
        if (const std::size_t i = at(cx, cy); !(weights[i] > 0))
          take(i, up.values.data() + up.at(cx >> 1, cy >> 1) * kTerms);
  }
  /// The last level's take the chart's mean.
  void fillWithMean() {
    Level all;
    all.width = all.height = 1;
    all.resize();
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i] > 0) all.add(0, values.data() + i * kTerms, weights[i]);
    all.divide();
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (!(weights[i] > 0)) take(i, all.values.data());
  }
};

PatchFilter::PatchFilter(std::shared_ptr<const PatchCover> cover, const Rtt& rtt, Job& job)
    : cover_(std::move(cover)), texels_(rtt.texels), size_(cover_->map() ? cover_->map()->size : 0) {
  const RttFactors factors = compressRtt(rtt, int(kTerms), job);
  error_ = factors.errors.back();
  terms_ = std::make_shared<ResponseTable>(tableOfTerms(factors));
  // [texels][terms], padded with zeros where the patch has fewer.
  const auto count = std::size_t(rtt.layers) * std::size_t(texels_ * texels_);
  std::vector<float> texels(count * kTerms, 0.0f);
  for (std::size_t q = 0; q < count; ++q)
    std::copy_n(factors.coefficients.begin() + std::ptrdiff_t(q * std::size_t(factors.terms)), factors.terms,
                texels.begin() + std::ptrdiff_t(q * kTerms));
  corners_ = cover_->cornerCoordinates();
  const int side = size_ > 0 ? size_ : texels_;
  for (Vec2& c : corners_) c = float(side) * (size_ > 0 ? Vec2(c.x, 1 - c.y) : c);
  const int levels = std::max(1, int(std::bit_width(unsigned(side - 1))));
  for (int l = 0; l <= levels; ++l)
    scale_.push_back(size_ > 0 ? Vec2(std::ldexp(1.0f, -l))
                               : Vec2(float((side + (1 << l) - 1) >> l) / float(side)));
  if (size_ > 0)
    buildCharts(texels, job);
  else
    buildRepeated(texels);
}

void PatchFilter::store(const Level& level, Rectangle& rectangle) {
  rectangle.x = level.x, rectangle.y = level.y, rectangle.width = level.width,
  rectangle.height = level.height;
  rectangle.first = std::uint32_t(coefficients_.size() / kTerms);
  for (const float c : level.values)
    coefficients_.push_back(toHalf(std::clamp(c, -kLargestHalf, kLargestHalf)));
}

void PatchFilter::buildCharts(const std::vector<float>& texels, Job& job) {
  const Atlas& atlas = *cover_->atlas();
  const IdMap& map = *cover_->map();
  chartOf_ = atlas.chartOf;
  const GeometryImage image = makeGeometryImage(atlas, size_, -1, job);
  owner_.assign(image.triangle.size(), 0);
  struct Extent {
    int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
  };
  std::vector<Extent> extents(atlas.chartCount);
  for (int y = 0; y < size_; ++y)
    for (int x = 0; x < size_; ++x) {
      const std::size_t i = image.index(x, y);
      if (image.triangle[i] == kNowhere || map.empty(i)) continue;
      const std::uint32_t chart = chartOf_[image.triangle[i]];
      owner_[i] = std::uint16_t(chart + 1);
      Extent& e = extents[chart];
      e.x0 = std::min(e.x0, x), e.x1 = std::max(e.x1, x), e.y0 = std::min(e.y0, y), e.y1 = std::max(e.y1, y);
    }
  rectangles_.resize(extents.size() * std::size_t(levels()));
  std::vector<std::vector<Level>> made(extents.size());
  job.begin("filtered patch", double(extents.size()), "charts");
  parallelFor(job, 0, extents.size(), 1, [&](std::size_t chart, std::size_t) {
    const Extent& e = extents[chart];
    if (e.x1 < 0) return;
    std::vector<Level>& all = made[chart];
    Level& first = all.emplace_back();
    first.x = e.x0 >> 1, first.y = e.y0 >> 1;
    first.width = (e.x1 >> 1) - first.x + 1, first.height = (e.y1 >> 1) - first.y + 1;
    first.resize();
    bool any = false;
    for (int y = e.y0; y <= e.y1; ++y)
      for (int x = e.x0; x <= e.x1; ++x) {
        const std::size_t i = image.index(x, y);
        if (image.triangle[i] == kNowhere || chartOf_[image.triangle[i]] != chart || map.empty(i)) continue;
        const TexelKind kind = image.kind[i];
        if (kind == TexelKind::Gutter) continue;
        const float weight = kind == TexelKind::Inside ? 1 : kRim;
        const auto q = std::size_t(patchTexel(map.at(i)));
        const LayerShares shares = layerShares(map, i);
        for (std::size_t n = 0; n < shares.count; ++n)
          first.add(first.at(x >> 1, y >> 1),
                    texels.data() + (q + shares.layer[n] * std::size_t(texels_ * texels_)) * kTerms,
                    weight * shares.weight[n]);
        any = true;
      }
    if (!any) return all.clear();
    first.divide();
    while (int(all.size()) < levels()) all.push_back(all.back().parent());
    all.back().fillWithMean();
    for (std::size_t l = all.size() - 1; l-- > 0;) all[l].fillFrom(all[l + 1]);
  });
  for (std::size_t chart = 0; chart < made.size(); ++chart) {
    for (std::size_t l = 0; l < made[chart].size(); ++l)
      store(made[chart][l], rectangles_[chart * std::size_t(levels()) + l]);
    made[chart] = {};
  }
}

/// Levels need not divide the patch: texels count by the part that they share.
void PatchFilter::buildRepeated(const std::vector<float>& texels) {
  chartOf_.assign(corners_.size() / 3, 0);
  rectangles_.resize(std::size_t(levels()));
  for (int l = 1; l <= levels(); ++l) {
    Level level;
    level.width = level.height = int(std::lround(scale_[std::size_t(l)].x * float(texels_)));
    level.resize();
    const double step = double(texels_) / level.width;
    const auto shared = [&](int cell, int texel) {
      return float(
          std::max(0.0, std::min((cell + 1) * step, texel + 1.0) - std::max(cell * step, double(texel))));
    };
    for (int y = 0; y < level.height; ++y)
      for (int x = 0; x < level.width; ++x)
        for (int v = int(y * step); v < texels_ && v < (y + 1) * step; ++v)
          for (int u = int(x * step); u < texels_ && u < (x + 1) * step; ++u)
            level.add(level.at(x, y), texels.data() + std::size_t(v * texels_ + u) * kTerms,
                      shared(x, u) * shared(y, v));
    level.divide();
    store(level, rectangles_[std::size_t(l - 1)]);
  }
}

int PatchFilter::patchTexel(const Vec2& uv) const {
  const auto cell = [n = texels_](float x) { return std::min(int((x - std::floor(x)) * float(n)), n - 1); };
  return cell(uv.y) * texels_ + cell(uv.x);
}

FilterPlace PatchFilter::place(std::uint32_t triangle, const Vec2& barycentric) const {
  const Vec2* c = &corners_[3 * std::size_t(triangle)];
  return {interpolated(c[0], c[1], c[2], barycentric), chartOf_[triangle]};
}

Vec2 PatchFilter::placeStep(std::uint32_t triangle, const Vec2& weights) const {
  const Vec2* c = &corners_[3 * std::size_t(triangle)];
  return weights.x * (c[1] - c[0]) + weights.y * (c[2] - c[0]);
}

float PatchFilter::levelOf(float width) const {
  const float level = std::log2(kSharper * width);
  return level > 0 ? std::min(level, float(levels())) : 0.0f;
}

FilterTexels PatchFilter::texelsAround(const FilterPlace& place) const {
  const Vec2 p = place.at - 0.5f, low = floor(p), part = p - low;
  FilterTexels out;
  float sum = 0;
  for (int i = 0; i < 4; ++i) {
    const int x = int(low.x) + (i & 1), y = int(low.y) + (i >> 1);
    const float weight = (i & 1 ? part.x : 1 - part.x) * (i >> 1 ? part.y : 1 - part.y);
    if (!(weight > 0)) continue;
    if (repeats()) {
      out.add(std::uint32_t(wrapped(y, texels_) * texels_ + wrapped(x, texels_)), weight);
    } else {
      if (x < 0 || y < 0 || x >= size_ || y >= size_) continue;
      const std::size_t texel = std::size_t(y) * std::size_t(size_) + std::size_t(x);
      if (owner_[texel] != std::uint16_t(place.chart + 1)) continue;
      const auto q = std::uint32_t(patchTexel(cover_->map()->at(texel)));
      const LayerShares shares = layerShares(*cover_->map(), texel);
      for (std::size_t n = 0; n < shares.count; ++n)
        out.add(q + shares.layer[n] * std::uint32_t(texels_ * texels_), weight * shares.weight[n]);
    }
    sum += weight;
  }
  for (std::size_t n = 0; n < out.count; ++n) out.weight[n] /= sum;
  return out;
}

void PatchFilter::addLevel(const FilterPlace& place, int level, float weight, Coefficients& sum) const {
  const Rectangle& r = rectangle(place.chart, level);
  const Vec2 p = place.at * scale_[std::size_t(level)] - Vec2(float(r.x), float(r.y)) - 0.5f;
  const Vec2 low = floor(p), part = p - low;
  const auto cell = [&](int x, int n) { return repeats() ? wrapped(x, n) : std::clamp(x, 0, n - 1); };
  for (int i = 0; i < 4; ++i) {
    const int x = cell(int(low.x) + (i & 1), r.width), y = cell(int(low.y) + (i >> 1), r.height);
    const float share = weight * (i & 1 ? part.x : 1 - part.x) * (i >> 1 ? part.y : 1 - part.y);
    const std::uint16_t* from =
        coefficients_.data() + (std::size_t(r.first) + std::size_t(y * r.width + x)) * kTerms;
    for (std::size_t t = 0; t < kTerms; t += std::size_t(kLanes))
      sh_kernel::store(sh_kernel::load(&sum[t]) + share * loadHalfs(from + t), &sum[t]);
  }
}

void PatchFilter::add(const FilterPlace& place, float level, float weight, Coefficients& sum) const {
  const float at = std::clamp(level, 1.0f, float(levels()));
  const int below = std::min(int(at), std::max(1, levels() - 1));
  const float between = at - float(below);
  if (between < 1) addLevel(place, below, weight * (1 - between), sum);
  if (between > 0) addLevel(place, below + 1, weight * between, sum);
}

std::size_t PatchFilter::bytes() const {
  return coefficients_.size() * sizeof(std::uint16_t) + owner_.size() * sizeof(std::uint16_t) +
         rectangles_.size() * sizeof(Rectangle) + corners_.size() * sizeof(Vec2) +
         chartOf_.size() * sizeof(std::uint32_t) + terms_->halfs().size_bytes();
}

}  // namespace prt
