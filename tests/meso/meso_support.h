#pragma once
// What tests of patches share.

#include "libprt/meso/height_field.h"
#include "libprt/meso/rtt_bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace prt::test {

inline PatchScene sceneOf(Patch patch) {
  Job job;
  return makePatchScene(std::make_shared<Patch>(std::move(patch)), job);
}

inline Rtt baked(Patch patch, const RttSettings& settings) {
  Job job;
  return bakeRtt(sceneOf(std::move(patch)), settings, job);
}

/// A quick setting for tests.
inline RttSettings small(int texels, int views, int rays = 256, int bounces = 0) {
  RttSettings s;
  s.texels = texels, s.views = views, s.rays = rays, s.bounces = bounces, s.supersamples = 2;
  return s;
}

/// Exit radiance under a sky of 1 of every texel towards a view.
inline std::vector<double> underWhiteSky(const Rtt& rtt, int view) {
  std::vector<double> out;
  for (int v = 0; v < rtt.texels; ++v)
    for (int u = 0; u < rtt.texels; ++u)
      out.push_back(double(rtt.block(u, v, view)[0]) * double(rtt.colour.x) * std::sqrt(4 * kPi));
  return out;
}

inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / double(values.size());
}

/// A white patch under a white sky gives 1 towards every view: mean within 0.5 %, 1st to 99th percentile
/// within 3 %.
inline void expectWhiteFurnace(const Rtt& rtt) {
  std::vector<double> all;
  for (int view = 0; view < rtt.viewCount(); ++view)
    for (const double x : underWhiteSky(rtt, view)) all.push_back(x);
  std::sort(all.begin(), all.end());
  EXPECT_NEAR(mean(all), 1, 0.005);
  EXPECT_NEAR(all[all.size() / 100], 1, 0.03);
  EXPECT_NEAR(all[all.size() * 99 / 100], 1, 0.03);
}

/// A smooth bumpy surface that has no symmetry.
inline HeightGrid bumps(int side, float depth) {
  return sampleHeights(side, [&](const Vec2& uv) {
    const float a = 2 * kPiF * uv.x, b = 2 * kPiF * uv.y;
    return depth * (0.5f + 0.25f * std::sin(a + 0.4f) * std::cos(2 * b) + 0.25f * std::sin(2 * a - b));
  });
}

}  // namespace prt::test
