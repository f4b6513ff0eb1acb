#include "libprt/atlas/elimination_order.h"

#include "libprt/atlas/sparse_cholesky.h"
#include "libprt/core/error.h"
#include "libprt/core/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace prt {
namespace {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Edges grid(std::uint32_t side, std::uint32_t first = 0) {
  Edges edges;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t v = first + y * side + x;
      if (x + 1 < side) edges.emplace_back(v, v + 1);
      if (y + 1 < side) edges.emplace_back(v, v + side);
      if (x + 1 < side && y + 1 < side) edges.emplace_back(v, v + side + 1);
    }
  return edges;
}

bool isPermutation(std::vector<std::uint32_t> order, std::size_t nodes) {
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> all(nodes);
  std::iota(all.begin(), all.end(), 0u);
  return order == all;
}

/// Entries of the factor below the diagonal, by the definition: eliminating a node joins its neighbours.
std::size_t fillOf(std::size_t nodes, const Edges& edges, const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> place(nodes);
  for (std::uint32_t k = 0; k < nodes; ++k) place[order[k]] = k;
  std::vector<std::set<std::uint32_t>> later(nodes);
  for (const auto& [a, b] : edges) later[std::min(place[a], place[b])].insert(std::max(place[a], place[b]));
  std::size_t sum = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    sum += later[k].size();
    if (later[k].size() < 2) continue;
    const std::uint32_t next = *later[k].begin();
    later[next].insert(std::next(later[k].begin()), later[k].end());
  }
  return sum;
}

TEST(EliminationOrder, TakesEveryNodeOnceHoweverItIsTakenApart) {
  Job job;
  Edges two = grid(20);  // and a part that does not hang together with it, and a node alone
  const Edges other = grid(7, 400);
  two.insert(two.end(), other.begin(), other.end());
  for (const std::size_t most : {2u, 10u, 60u, 1000u})
    EXPECT_TRUE(isPermutation(eliminationOrder(450, two, job, most), 450)) << most;
  Edges complete;
  for (std::uint32_t a = 0; a < 30; ++a)
    for (std::uint32_t b = a + 1; b < 30; ++b) complete.emplace_back(a, b);
  EXPECT_TRUE(isPermutation(eliminationOrder(30, complete, job, 5), 30));
  EXPECT_TRUE(eliminationOrder(0, {}, job).empty());
}

TEST(EliminationOrder, DissectionFillsInLittleMore) {
  Job job;
  const Edges edges = grid(100);
  const std::size_t whole = fillOf(10000, edges, eliminationOrder(10000, edges, job, 10000)),
                    parts = fillOf(10000, edges, eliminationOrder(10000, edges, job, 1500));
  EXPECT_LT(double(parts), 1.25 * double(whole));
}

// Large enough to be taken apart by itself.
TEST(EliminationOrder, LargeSystemsAreSolved) {
  Job job;
  constexpr std::uint32_t kSide = 140;
  const Edges edges = grid(kSide);
  SparseCholesky<1> solver(kSide * kSide, edges, job);
  std::vector<double> diagonal(kSide * kSide, 0.1);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    solver.addEdge(e, {-1.0});
    diagonal[edges[e].first] += 1, diagonal[edges[e].second] += 1;
  }
  for (std::uint32_t v = 0; v < diagonal.size(); ++v) solver.addDiagonal(v, {diagonal[v]});
  ASSERT_TRUE(solver.factorise(job));
  std::vector<std::array<double, 1>> right(diagonal.size()), x;
  for (std::size_t v = 0; v < right.size(); ++v) right[v] = {hashUniform(1, v, 0)};
  x = right;
  solver.solve(x);
  std::vector<double> left(right.size());
  for (std::size_t v = 0; v < left.size(); ++v) left[v] = diagonal[v] * x[v][0];
  for (const auto& [a, b] : edges) left[a] -= x[b][0], left[b] -= x[a][0];
  for (std::size_t v = 0; v < left.size(); ++v) ASSERT_NEAR(left[v], right[v][0], 1e-9);
}

TEST(EliminationOrder, EndsWhenCancelled) {
  Job job;
  job.cancel();
  EXPECT_THROW(eliminationOrder(100, grid(10), job), Cancelled);
}

}  // namespace
}  // namespace prt
