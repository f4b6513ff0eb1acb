#pragma once
// Sparse symmetric positive definite systems over the vertices of a chart, with K unknowns per vertex. The
// factorisation is our own so that it can be cancelled at any time, and so is the order that is eliminated in
// (elimination_order.h). Serial: charts are what runs in parallel.

#include "libprt/core/job.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace prt {

/// L D L^T with K x K blocks, row by row (Davis 2005, "Algorithm 849: LDL"). K is 1 or 2.
template <int K>
class SparseCholesky {
 public:
  using Block = std::array<double, std::size_t(K* K)>;  ///< row by row
  using Vector = std::array<double, std::size_t(K)>;

  /// Nodes 0 .. n - 1; `edges` are the pairs (i, j), i != j, each once, whose blocks may be non-zero.
  SparseCholesky(std::size_t nodes, std::span<const std::pair<std::uint32_t, std::uint32_t>> edges, Job& job);

  /// All blocks zero.
  void clear();
  void addDiagonal(std::uint32_t node, const Block& block) { add(diagonal_[node], block); }
  /// Block (i, j) of the edge given as (i, j); block (j, i) is its transpose.
  void addEdge(std::size_t edge, const Block& block) { add(values_[edge], block); }
  Block& edgeBlock(std::size_t edge) { return values_[edge]; }
  Block& diagonalBlock(std::uint32_t node) { return diagonal_[node]; }

  /// False when the matrix is not positive definite. Throws Cancelled.
  bool factorise(Job& job);
  /// Solves in place, [n]. Needs factorise().
  void solve(std::vector<Vector>& x) const;

 private:
  static void add(Block& sum, const Block& block) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += block[i];
  }
  void analyse(Job& job);

  std::vector<Block> diagonal_, values_;
  std::vector<std::uint32_t> order_;  // node at each position
  // Column k of the upper triangle in that order: rows, edges, and whether the block must be transposed.
  std::vector<std::uint32_t> columnStart_, rows_, edgeOf_;
  std::vector<std::uint8_t> transposed_;
  std::vector<std::uint32_t> parent_, factorStart_;  // elimination tree; columns of L
  std::vector<std::uint32_t> factorRows_;
  std::vector<Block> factor_, pivotInverse_;
};

extern template class SparseCholesky<1>;
extern template class SparseCholesky<2>;

}  // namespace prt
