#include "libprt/shade/flip.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace prt {
namespace {

/// A reference with edges, ramps and (for top > 0) a bright spot, and a distorted copy, by formula.
struct Pair {
  Image reference{96, 64, 3}, image{96, 64, 3};
};
Pair pattern(float top) {
  Pair p;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      const float u = (float(x) + 0.5f) / 96, v = (float(y) + 0.5f) / 64;
      const float base = 0.1f + 0.5f * u, stripe = (x / 6 + y / 9) % 2 ? 0.25f : 0.0f;
      const float spot = top * std::exp(-60 * ((u - 0.7f) * (u - 0.7f) + (v - 0.4f) * (v - 0.4f)));
      const Rgb r(base + stripe * 0.8f + spot, 0.4f * base + stripe + spot * 0.7f,
                  0.2f + 0.6f * v + spot * 0.3f);
      const float d = 0.15f * std::sin(9 * u + 5 * v);
      const Rgb t(r.x * (1 + d), r.y * (1 - 0.5f * d) + (x > 48 && y > 32 ? 0.1f : 0), r.z * (1 + 0.7f * d));
      for (int c = 0; c < 3; ++c) p.reference.pixel(x, y)[c] = r[c], p.image.pixel(x, y)[c] = t[c];
    }
  return p;
}

void expectMap(const FlipResult& f, double mean, float at1010, float at7030, float at4833) {
  EXPECT_NEAR(f.mean, mean, 2e-4);
  EXPECT_NEAR(*f.map.pixel(10, 10), at1010, 1e-3);
  EXPECT_NEAR(*f.map.pixel(70, 30), at7030, 1e-3);
  EXPECT_NEAR(*f.map.pixel(48, 33), at4833, 1e-3);
}

// The authors' program (version 1.7, C++), run on the same formula, gives these numbers.
TEST(Flip, LdrAgreesWithTheAuthorsProgram) {
  Job job;
  const Pair plain = pattern(0), bright = pattern(300);
  expectMap(ldrFlip(plain.image, plain.reference, {}, job), 0.215814, 0.152988f, 0.133079f, 0.223216f);
  expectMap(ldrFlip(bright.image, bright.reference, {}, job), 0.164179, 0.152988f, 0.0f, 0.015750f);
}

TEST(Flip, HdrAgreesWithTheAuthorsProgram) {
  Job job;
  const Pair plain = pattern(0), bright = pattern(300);
  const FlipResult p = hdrFlip(plain.image, plain.reference, {}, job);
  expectMap(p, 0.172172, 0.164312f, 0.095577f, 0.115948f);
  EXPECT_EQ(p.exposures, 2);
  const double scale = std::log2(0.6);  // the authors' curve first multiplies by 0.6, ours does not
  EXPECT_NEAR(p.firstExposure, 1.879221 + scale, 1e-3);
  EXPECT_NEAR(p.lastExposure, 2.721099 + scale, 1e-3);
  const FlipResult b = hdrFlip(bright.image, bright.reference, {}, job);
  expectMap(b, 0.185916, 0.172591f, 0.098993f, 0.172656f);
  EXPECT_EQ(b.exposures, 10);
}

TEST(Flip, BlackAgainstWhiteIsAlmostOne) {
  Job job;
  Image black(40, 30, 3), white(40, 30, 3);
  for (float& v : white.data) v = 1;
  EXPECT_NEAR(ldrFlip(white, black, {}, job).mean, 0.967325, 1e-4);
}

TEST(Flip, SameImageGivesZero) {
  Job job;
  const Pair p = pattern(300);
  EXPECT_EQ(ldrFlip(p.reference, p.reference, {}, job).mean, 0);
  EXPECT_EQ(hdrFlip(p.reference, p.reference, {}, job).mean, 0);
}

TEST(Flip, LdrIsSymmetricAndTurnsWithTheImage) {
  Job job;
  const Pair p = pattern(0);
  const double forth = ldrFlip(p.image, p.reference, {}, job).mean;
  EXPECT_NEAR(forth, ldrFlip(p.reference, p.image, {}, job).mean, 1e-6);
  const auto turned = [](const Image& in) {
    Image out(in.height, in.width, 3);
    for (int y = 0; y < in.height; ++y)
      for (int x = 0; x < in.width; ++x)
        for (int c = 0; c < 3; ++c) out.pixel(y, in.width - 1 - x)[c] = in.pixel(x, y)[c];
    return out;
  };
  EXPECT_NEAR(forth, ldrFlip(turned(p.image), turned(p.reference), {}, job).mean, 1e-5);
}

TEST(Flip, HdrDoesNotDependOnTheUnitOfRadiance) {
  Job job;
  Pair p = pattern(300);
  const double before = hdrFlip(p.image, p.reference, {}, job).mean;
  for (Image* image : {&p.image, &p.reference})
    for (float& v : image->data) v *= 1024;
  EXPECT_NEAR(hdrFlip(p.image, p.reference, {}, job).mean, before, 1e-5);
}

TEST(Flip, MaskedPixelsDoNotCount) {
  Job job;
  Pair p = pattern(0);
  PixelMask mask(p.image.pixels(), 1);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = i % 96 < 48;
  const double before = ldrFlip(p.image, p.reference, mask, job).mean;
  for (int y = 0; y < 64; ++y) p.image.pixel(80, y)[1] = 100;
  const FlipResult after = ldrFlip(p.image, p.reference, mask, job);
  EXPECT_EQ(after.mean, before);
  EXPECT_EQ(*after.map.pixel(80, 5), 0.0f);
}

TEST(Flip, SurvivesBadPixelsAndRefusesBadSizes) {
  Job job;
  Pair p = pattern(0);
  p.image.data[5] = std::numeric_limits<float>::quiet_NaN(),
  p.image.data[900] = std::numeric_limits<float>::infinity();
  p.reference.data[77] = -3;
  EXPECT_TRUE(std::isfinite(hdrFlip(p.image, p.reference, {}, job).mean));
  EXPECT_THROW(ldrFlip(p.image, Image(3, 3, 3), {}, job), ValueError);
  EXPECT_THROW(ldrFlip(p.image, p.reference, PixelMask(5, 1), job), ValueError);
  EXPECT_EQ(hdrFlip(Image(8, 8, 3), Image(8, 8, 3), {}, job).mean, 0);
}

}  // namespace
}  // namespace prt
