#include "libprt/mesh/weld.h"

#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/dense_index.h"

namespace prt {
namespace {

using Key = DenseIndex<6>::Key;

bool finite(const DVec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

Key keyOf(const DVec3& p) {
  Key key;
  for (int i = 0; i < 3; ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(p[i] + 0.0);
    key[std::size_t(2 * i)] = std::uint32_t(bits);
    key[std::size_t(2 * i + 1)] = std::uint32_t(bits >> 32);
  }
  return key;
}

template <class Point>
std::vector<std::uint32_t> weld(std::span<const Point> positions, Job& job) {
  CancelCheck check(job);
  DenseIndex<6> index(positions.size());
  std::vector<std::uint32_t> firstOf, representative(positions.size());
  firstOf.reserve(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    check();
    representative[v] = std::uint32_t(v);
    const DVec3 p(positions[v]);
    if (!finite(p)) continue;
    const std::uint32_t number = index.insert(keyOf(p));
    if (number == firstOf.size()) firstOf.push_back(std::uint32_t(v));
    representative[v] = firstOf[number];
  }
  return representative;
}

}  // namespace

std::vector<std::uint32_t> weldByPosition(std::span<const DVec3> positions, Job& job) {
  return weld(positions, job);
}
std::vector<std::uint32_t> weldByPosition(std::span<const Vec3> positions, Job& job) {
  return weld(positions, job);
}

}  // namespace prt
