#include "libprt/synthesis/exemplar.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "tests/synthesis/shapes.h"
#include "tests/synthesis/tables.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using namespace test;

Exemplar exemplarOf(const Rtt& rtt, ExemplarOptions options = {}) {
  Job job;
  if (options.spacings.empty()) options.spacings = {1, 2, 4};
  return makeExemplar(rtt, options, job);
}

double squared(const Exemplar& e, int level, int turn, std::uint32_t a, int turnB, std::uint32_t b) {
  const float *x = e.levels[std::size_t(level)].at(turn, a, e.count()),
              *y = e.levels[std::size_t(level)].at(turnB, b, e.count());
  double sum = 0;
  for (int i = 0; i < kAppearance; ++i) sum += double(x[i] - y[i]) * double(x[i] - y[i]);
  return sum;
}

TEST(Exemplar, RandomTexelsAreAtDistanceOne) {
  const Exemplar e = exemplarOf(wavesTable(24));
  for (int level = 0; level < 3; ++level) {
    double sum = 0;
    for (std::uint32_t a = 0; a < e.count(); ++a)
      for (std::uint32_t b = 0; b < e.count(); ++b) sum += squared(e, level, 0, a, 0, b);
    EXPECT_NEAR(sum / double(e.count() * e.count()), 1, 1e-3) << level;
    EXPECT_GT(e.levels[std::size_t(level)].kept, 0.95);
  }
}

TEST(Exemplar, APatchOfOneColourHasNoAppearance) {
  const Exemplar e = exemplarOf(pictureTable(16, [](double, double) { return 0.7; }));
  for (const ExemplarLevel& level : e.levels)
    for (const float x : level.appearance) EXPECT_EQ(x, 0);
}

TEST(Exemplar, AppearanceRepeatsWhereThePatchDoes) {
  const Exemplar e = exemplarOf(stripesTable(24));
  for (std::uint32_t t = 0; t < e.count(); ++t) {
    const std::uint32_t third = (t / 24) * 24 + (t + 8) % 24;
    EXPECT_LT(squared(e, 0, 0, t, 0, third), 1e-6);
  }
}

TEST(Exemplar, SimilarTexelsAreTheNearestOfAll) {
  const Exemplar e = exemplarOf(wavesTable(24));
  // Brute force: nothing outside of the texel's own surroundings is nearer.
  for (std::uint32_t t = 0; t < e.count(); ++t) {
    double best = 1e30;
    for (std::uint32_t s = 0; s < e.count(); ++s) {
      const int du = std::abs(int(t % 24) - int(s % 24)), dv = std::abs(int(t / 24) - int(s / 24));
      if (std::min(du, 24 - du) <= 1 && std::min(dv, 24 - dv) <= 1) continue;
      best = std::min(best, squared(e, 0, 0, t, 0, s));
    }
    EXPECT_NEAR(squared(e, 0, 0, t, 0, e.levels[0].similar[t * 3]), best, 1e-6);
  }
}

TEST(Exemplar, SimilarTexelsLieApart) {
  const Exemplar e = exemplarOf(boardTable(40));
  for (std::uint32_t t = 0; t < e.count(); ++t) {
    const std::uint32_t* s = &e.levels[0].similar[t * 3];
    for (int i = 0; i < 3; ++i)
      for (int j = -1; j < i; ++j) {
        const std::uint32_t other = j < 0 ? t : s[j];
        const int du = std::abs(int(s[i] % 40) - int(other % 40)),
                  dv = std::abs(int(s[i] / 40) - int(other / 40));
        EXPECT_GT(std::max(std::min(du, 40 - du), std::min(dv, 40 - dv)), 2);
      }
  }
}

TEST(Exemplar, ASymmetricPatchLooksAlikeWhenTurned) {
  // Turned by a quarter about the middle of a bump, the board is itself with the signs of bumps changed:
  // texel (u, v) looks like the one a quarter of the patch further.
  const Exemplar e = exemplarOf(boardTable(24), {.turns = 4, .spacings = {1, 2}});
  for (int level = 0; level < 2; ++level)
    for (std::uint32_t t = 0; t < e.count(); ++t)
      for (int turn = 1; turn < 4; ++turn) {
        const std::uint32_t found =
            e.levels[std::size_t(level)].similar[(std::size_t(turn) * e.count() + t) * 3];
        EXPECT_LT(squared(e, level, turn, t, 0, found), 0.02);
      }
}

TEST(Exemplar, TurnedResponsesAnswerToTurnedViewsAndLights) {
  Rtt rtt(2, 4, 3, 3);
  for (std::size_t i = 0; i < rtt.values.size(); ++i) rtt.values[i] = hashUniform(3, i) - 0.3f;
  ShRgb light(3);
  for (std::size_t k = 0; k < light.c.size(); ++k)
    light.c[k] = Rgb(hashUniform(4, k), hashUniform(5, k), 0.2f);
  for (int quarters = 0; quarters < 4; ++quarters) {
    const Rtt turned = turnedResponses(rtt, quarters);
    const double angle = quarters * kPi / 2;
    const Mat3 back(Vec3(float(std::cos(angle)), float(-std::sin(angle)), 0),
                    Vec3(float(std::sin(angle)), float(std::cos(angle)), 0), Vec3(0, 0, 1));
    const ShRgb turnedLight = ShRotation(3, back).apply(light);
    const ViewSquare square(4);
    for (int view = 0; view < 16; ++view) {
      const Rgb direct = turned.exitRadiance(1, 0, view, light),
                other = rtt.exitRadiance(1, 0, square.nearest(back * square.centre(view)), turnedLight);
      EXPECT_LT(distance(direct, other), 1e-5f) << quarters << " " << view;
    }
  }
}

TEST(Exemplar, IsTheSameForAnyNumberOfThreads) {
  std::vector<Exemplar> made;
  for (const int threads : {1, 2, 3}) {
    const Threads set(threads);
    made.push_back(exemplarOf(wavesTable(24), {.turns = 2, .spacings = {1, 3}}));
  }
  for (const std::size_t i : {1u, 2u})
    for (std::size_t level = 0; level < 2; ++level) {
      EXPECT_EQ(made[i].levels[level].appearance, made[0].levels[level].appearance);
      EXPECT_EQ(made[i].levels[level].similar, made[0].levels[level].similar);
    }
}

TEST(Exemplar, RefusesOptionsOutOfRange) {
  EXPECT_THROW(exemplarOf(wavesTable(8), {.turns = 3}), ValueError);
  EXPECT_THROW(exemplarOf(wavesTable(8), {.similar = 0}), ValueError);
}

}  // namespace
}  // namespace prt
