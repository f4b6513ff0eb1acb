#include "libprt/meso/rtt_layers.h"

#include "libprt/core/error.h"
#include "tests/support/patched_world.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using test::variedLight;
using test::variedRtt;

std::shared_ptr<const Rtt> tableOf(int channels, const Rgb& colour, float factor) {
  Rtt rtt = variedRtt(4, 2, channels);
  for (float& x : rtt.values) x *= factor;
  rtt.colour = colour;
  return std::make_shared<const Rtt>(std::move(rtt));
}

/// One table out of a stack.
Rtt layerOf(const Rtt& stack, int layer) {
  Rtt out = stack;
  const std::size_t each = stack.values.size() / std::size_t(stack.layers);
  out.layers = 1;
  out.values.assign(stack.values.begin() + std::ptrdiff_t(each * std::size_t(layer)),
                    stack.values.begin() + std::ptrdiff_t(each * std::size_t(layer + 1)));
  return out;
}

TEST(StackedRtt, KeepsWhatEachTableAnswers) {
  const Rgb red(0.9f, 0.2f, 0.1f), blue(0.1f, 0.2f, 0.8f);
  const std::vector<std::vector<std::shared_ptr<const Rtt>>> cases{
      {tableOf(1, red, 1), tableOf(1, red, 0.5f)},
      {tableOf(1, red, 1), tableOf(1, blue, 0.5f)},
      {tableOf(3, red, 1), tableOf(1, blue, 0.5f), tableOf(3, blue, 2)}};
  for (const auto& tables : cases) {
    const Rtt stack = stackedRtt(tables);
    EXPECT_EQ(stack.layers, int(tables.size()));
    EXPECT_EQ(stack.channels, &tables == &cases[0] ? 1 : 3) << "one channel where one colour does";
    for (int n = 0; n < stack.layers; ++n) {
      const Rtt one = layerOf(stack, n);
      for (int v = 0; v < 4; ++v)
        for (int u = 0; u < 4; ++u) {
          const Vec3 view = normalize(Vec3(0.2f * float(u), 0.3f, 1));
          const Rgb a = one.exitRadiance(u, v, view, variedLight()),
                    b = tables[std::size_t(n)]->exitRadiance(u, v, view, variedLight());
          ASSERT_LT(distance(a, b), 1e-5f) << n;
        }
    }
  }
}

TEST(StackedRtt, RefusesTablesOfOtherSizes) {
  const std::vector<std::shared_ptr<const Rtt>> tables{tableOf(1, Rgb(1), 1),
                                                       std::make_shared<const Rtt>(variedRtt(4, 3, 1))};
  EXPECT_THROW(stackedRtt(tables), ValueError);
}

}  // namespace
}  // namespace prt
