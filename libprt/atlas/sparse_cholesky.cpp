#include "libprt/atlas/sparse_cholesky.h"

#include "libprt/atlas/elimination_order.h"
#include "libprt/atlas/surface.h"
#include "libprt/mesh/cancel_check.h"

#include <algorithm>

namespace prt {
namespace {

template <int K>
using Block = typename SparseCholesky<K>::Block;

/// c -= a * b
template <int K>
inline void subtractProduct(Block<K>& c, const Block<K>& a, const Block<K>& b) {
  if constexpr (K == 1) {
    c[0] -= a[0] * b[0];
  } else {
    c[0] -= a[0] * b[0] + a[1] * b[2];
    c[1] -= a[0] * b[1] + a[1] * b[3];
    c[2] -= a[2] * b[0] + a[3] * b[2];
    c[3] -= a[2] * b[1] + a[3] * b[3];
  }
}

template <int K>
inline Block<K> transpose(const Block<K>& a) {
  if constexpr (K == 1)
    return a;
  else
    return {a[0], a[2], a[1], a[3]};
}

template <int K>
inline Block<K> product(const Block<K>& a, const Block<K>& b) {
  if constexpr (K == 1)
    return {a[0] * b[0]};
  else
    return {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2],
            a[2] * b[1] + a[3] * b[3]};
}

/// Inverse of a symmetric block; false when it is not positive definite.
template <int K>
inline bool invert(const Block<K>& a, Block<K>& inverse) {
  if constexpr (K == 1) {
    inverse = {1 / a[0]};
    return a[0] > 0;
  } else {
    const double det = a[0] * a[3] - a[1] * a[2], scale = 1 / det;
    inverse = {a[3] * scale, -a[1] * scale, -a[2] * scale, a[0] * scale};
    return a[0] > 0 && det > 0;
  }
}

}  // namespace

template <int K>
SparseCholesky<K>::SparseCholesky(std::size_t nodes,
                                  std::span<const std::pair<std::uint32_t, std::uint32_t>> edges, Job& job)
    : diagonal_(nodes), values_(edges.size()) {
  clear();
  job.checkCancelled();
  order_ = eliminationOrder(nodes, edges, job);
  job.checkCancelled();
  std::vector<std::uint32_t> position(nodes);
  for (std::uint32_t k = 0; k < nodes; ++k) position[order_[k]] = k;
  columnStart_.assign(nodes + 1, 0);
  for (const auto& [i, j] : edges) ++columnStart_[std::max(position[i], position[j]) + 1];
  for (std::size_t k = 0; k < nodes; ++k) columnStart_[k + 1] += columnStart_[k];
  rows_.resize(edges.size());
  edgeOf_.resize(edges.size());
  transposed_.resize(edges.size());
  std::vector<std::uint32_t> fill(columnStart_.begin(), columnStart_.end() - 1);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const std::uint32_t i = position[edges[e].first], j = position[edges[e].second];
    const std::uint32_t slot = fill[std::max(i, j)]++;
    rows_[slot] = std::min(i, j);
    edgeOf_[slot] = e;
    transposed_[slot] = i > j;
  }
  analyse(job);
}

template <int K>
void SparseCholesky<K>::clear() {
  for (Block& b : diagonal_) b.fill(0);
  for (Block& b : values_) b.fill(0);
}

template <int K>
void SparseCholesky<K>::analyse(Job& job) {
  const std::size_t n = order_.size();
  CancelCheck check(job);
  parent_.assign(n, kNowhere);
  std::vector<std::uint32_t> count(n, 0), flag(n, kNowhere);
  for (std::uint32_t k = 0; k < n; ++k) {
    flag[k] = k;
    for (std::uint32_t p = columnStart_[k]; p < columnStart_[k + 1]; ++p)
      for (std::uint32_t i = rows_[p]; flag[i] != k; i = parent_[i]) {
        check();
        if (parent_[i] == kNowhere) parent_[i] = k;
        ++count[i];
        flag[i] = k;
      }
  }
  factorStart_.assign(n + 1, 0);
  for (std::size_t k = 0; k < n; ++k) factorStart_[k + 1] = factorStart_[k] + count[k];
  factorRows_.resize(factorStart_[n]);
  factor_.resize(factorStart_[n]);
  pivotInverse_.resize(n);
}

template <int K>
bool SparseCholesky<K>::factorise(Job& job) {
  const std::size_t n = order_.size();
  std::vector<std::uint32_t> filled(n, 0), flag(n, kNowhere), pattern(n), stack(n);
  std::vector<Block> work(n);
  for (Block& b : work) b.fill(0);
  std::size_t done = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    if (done > 200000) {  // blocks: well under a millisecond
      job.checkCancelled();
      done = 0;
    }
    // Pattern of row k of L: everything up the elimination tree from the entries of column k.
    std::size_t top = n;
    flag[k] = k;
    for (std::uint32_t p = columnStart_[k]; p < columnStart_[k + 1]; ++p) {
      const Block& value = values_[edgeOf_[p]];
      work[rows_[p]] = transposed_[p] ? transpose<K>(value) : value;  // block (row, k)
      std::size_t length = 0;
      for (std::uint32_t i = rows_[p]; flag[i] != k; i = parent_[i]) {
        stack[length++] = i;
        flag[i] = k;
      }
      while (length > 0) pattern[--top] = stack[--length];
    }
    // Solve with the columns done so far.
    Block pivot = diagonal_[order_[k]];
    for (; top < n; ++top) {
      const std::uint32_t i = pattern[top];
      const Block y = work[i];
      work[i].fill(0);
      const std::uint32_t first = factorStart_[i], last = first + filled[i];
      for (std::uint32_t p = first; p < last; ++p) subtractProduct<K>(work[factorRows_[p]], factor_[p], y);
      done += last - first + 1;
      const Block row = transpose<K>(product<K>(pivotInverse_[i], y));  // L(k, i)
      subtractProduct<K>(pivot, row, y);
      factorRows_[last] = k;
      factor_[last] = row;
      ++filled[i];
    }
    if (!invert<K>(pivot, pivotInverse_[k])) return false;
  }
  return true;
}

template <int K>
void SparseCholesky<K>::solve(std::vector<Vector>& x) const {
  const std::size_t n = order_.size();
  std::vector<Vector> y(n);
  for (std::size_t k = 0; k < n; ++k) y[k] = x[order_[k]];
  for (std::size_t k = 0; k < n; ++k)
    for (std::uint32_t p = factorStart_[k]; p < factorStart_[k + 1]; ++p)
      for (std::size_t r = 0; r < K; ++r)
        for (std::size_t c = 0; c < K; ++c) y[factorRows_[p]][r] -= factor_[p][r * K + c] * y[k][c];
  for (std::size_t k = 0; k < n; ++k) {
    const Vector v = y[k];
    for (std::size_t r = 0; r < K; ++r) {
      y[k][r] = 0;
      for (std::size_t c = 0; c < K; ++c) y[k][r] += pivotInverse_[k][r * K + c] * v[c];
    }
  }
  for (std::size_t k = n; k-- > 0;)
    for (std::uint32_t p = factorStart_[k]; p < factorStart_[k + 1]; ++p)
      for (std::size_t r = 0; r < K; ++r)
        for (std::size_t c = 0; c < K; ++c) y[k][c] -= factor_[p][r * K + c] * y[factorRows_[p]][r];
  for (std::size_t k = 0; k < n; ++k) x[order_[k]] = y[k];
}

template class SparseCholesky<1>;
template class SparseCholesky<2>;

}  // namespace prt
