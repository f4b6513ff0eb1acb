#include "libprt/meso/view_error.h"

#include "libprt/basis/view_square.h"
#include "libprt/core/sampling.h"

#include <cmath>
#include <vector>

namespace prt {
namespace {

constexpr int kEveryRow = 4;

/// Distance of a place on the view square from its nearest border, 0 .. 0.5.
float depthInSquare(const Vec2& p) {
  return std::min(std::min(p.x, 1 - p.x), std::min(p.y, 1 - p.y));
}

/// kViewErrorViews directions between the cells' centres, then as many beyond the outermost; evenly spread.
std::vector<Vec3> directionsFor(int views, std::uint64_t seed) {
  const float border = 0.5f / float(views);
  std::vector<Vec3> between, beyond;
  for (std::uint64_t i = 0; between.size() < kViewErrorViews || beyond.size() < kViewErrorViews; ++i) {
    const Vec2 p(hashUniform(seed, i, 201), hashUniform(seed, i, 202));
    std::vector<Vec3>& kind = depthInSquare(p) >= border ? between : beyond;
    if (kind.size() < kViewErrorViews) kind.push_back(viewFromSquare(p));
  }
  between.insert(between.end(), beyond.begin(), beyond.end());
  return between;
}

/// Squares of what is wrong and of what is right, weighted by the lights that are expected.
struct Squares {
  double wrong = 0, right = 0;

  void add(const Rtt& exact, const float* block, std::span<const Rgb> interpolated) {
    for (int l = 0, k = 0; l < exact.bands; ++l)
      for (; k < shCount(l + 1); ++k)
        for (int c = 0; c < 3; ++c) {
          const double weight = 1.0 / ((l + 1) * (l + 1));
          const double truth = double(exact.colour[c]) * block[k * exact.channels + c % exact.channels];
          const double off = double(interpolated[std::size_t(k)][c]) - truth;
          wrong += weight * off * off, right += weight * truth * truth;
        }
  }
  double relative() const { return right > 0 ? std::sqrt(wrong / right) : 0; }
};

}  // namespace

ViewError measureViewError(const PatchScene& patch, const PatchLight& light, const RttSettings& settings,
                           const Rtt& rtt, Job& job) {
  const std::vector<Vec3> directions = directionsFor(std::max(settings.views, 2), settings.seed);
  const Rtt exact = picturesOfPatch(patch, light, settings, directions, kEveryRow, job);
  Squares between, beyond;
  std::vector<Rgb> interpolated(std::size_t(rtt.functions()));
  for (int v = 0; v < rtt.texels; v += kEveryRow)
    for (int u = 0; u < rtt.texels; ++u)
      for (int i = 0; i < int(directions.size()); ++i) {
        rtt.response(u, v, directions[std::size_t(i)], interpolated);
        (i < kViewErrorViews ? between : beyond).add(exact, exact.block(u, v, i), interpolated);
      }
  return {between.relative(), beyond.relative()};
}

}  // namespace prt
