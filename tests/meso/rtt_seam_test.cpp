#include "libprt/meso/rtt_seam.h"
#include "libprt/core/math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace prt {
namespace {

/// A table whose every image is f(u, v) times a number of its own.
Rtt filled(int texels, const std::function<double(double, double)>& f) {
  Rtt rtt(texels, 2, 2, 3);
  for (int v = 0; v < texels; ++v)
    for (int u = 0; u < texels; ++u)
      for (int view = 0; view < rtt.viewCount(); ++view)
        for (std::size_t i = 0; i < rtt.blockSize(); ++i)
          rtt.block(u, v, view)[i] =
              float((1 + 0.1 * double(i) - 0.2 * view) * f((u + 0.5) / texels, (v + 0.5) / texels));
  return rtt;
}

double wave(double u, double v) {
  return 1 + 0.5 * std::sin(2 * kPi * (3 * u + v)) + 0.25 * std::cos(2 * kPi * (u - 5 * v));
}

double mean(const Rtt& rtt) {
  double sum = 0;
  for (const float x : rtt.values) sum += x;
  return sum / double(rtt.values.size());
}

TEST(RttSeam, AConstantAndANoiseTile) {
  EXPECT_EQ(seamStep(filled(16, [](double, double) { return 1.0; })), 1);
  Rtt noise(64, 2, 2, 3);
  std::mt19937 random(3);
  for (float& x : noise.values) x = std::uniform_real_distribution<float>()(random);
  EXPECT_NEAR(seamStep(noise), 1, 0.02);
}

TEST(RttSeam, ARampShows) {
  EXPECT_NEAR(seamStep(filled(32, [](double u, double) { return u; })), 31, 1e-3);
}

TEST(RttSeam, WhatIsTakenAwayIsTheRampAndTheWavesStay) {
  // On the torus, a plane in u and v plus periodic waves: the plane's steps are the only ones.
  const auto plane = [](double u, double v) { return 0.8 * u - 0.3 * v; };
  Rtt rtt = filled(48, [&](double u, double v) { return wave(u, v) + plane(u, v); });
  const Rtt waves = filled(48, wave);
  const double before = mean(rtt), visible = seamStep(rtt);
  Job job;
  makeSeamless(rtt, job);
  EXPECT_GT(visible, kVisibleSeam);
  EXPECT_LT(seamStep(rtt), 1.2);
  EXPECT_NEAR(mean(rtt), before, 1e-5);
  // Neighbours differ by a wave's slope and a rest of the plane: what tiles keeps its own shape to 3 %.
  double worst = 0;
  for (int v = 0; v < 48; ++v)
    for (int u = 8; u < 40; ++u)
      worst = std::max(worst, std::abs(double(rtt.block(u + 1, v, 0)[0] - rtt.block(u, v, 0)[0]) -
                                       double(waves.block(u + 1, v, 0)[0] - waves.block(u, v, 0)[0])));
  EXPECT_LT(worst, 0.03);
}

TEST(RttSeam, SmoothPartSolvesPoissonsEquation) {
  // The definition: inside its borders, the Laplacian of the result is the image's.
  const auto image = [](double u, double v) { return u * u * 3 + std::exp(v) - u * v; };
  const int n = 20;
  const Rtt before = filled(n, image);
  Rtt after = before;
  Job job;
  makeSeamless(after, job);
  const auto laplacian = [&](const Rtt& rtt, int u, int v) {
    const auto at = [&](int x, int y) { return double(rtt.block((x + n) % n, (y + n) % n, 1)[2]); };
    return at(u + 1, v) + at(u - 1, v) + at(u, v + 1) + at(u, v - 1) - 4 * at(u, v);
  };
  double sum = 0;
  for (int v = 1; v + 1 < n; ++v)
    for (int u = 1; u + 1 < n; ++u) EXPECT_NEAR(laplacian(after, u, v), laplacian(before, u, v), 1e-5);
  for (int v = 0; v < n; ++v)
    for (int u = 0; u < n; ++u) sum += laplacian(after, u, v);
  EXPECT_NEAR(sum, 0, 1e-3);
}

TEST(RttSeam, ATilingTextureChangesByOneStepInItsSize) {
  // Across a border that tiles there is a step as between any neighbours; it halves when texels do.
  const auto change = [](int texels) {
    Rtt rtt = filled(texels, wave);
    const Rtt before = rtt;
    Job job;
    makeSeamless(rtt, job);
    return relativeDifference(rtt, before);
  };
  EXPECT_LT(change(64), 0.03);
  EXPECT_LT(change(128), 0.55 * change(64));
}

}  // namespace
}  // namespace prt
