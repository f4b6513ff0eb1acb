#include "libprt/mesh/edges.h"

#include <algorithm>
#include <utility>

namespace prt {

MeshEdges::MeshEdges(std::span<const UVec3> triangles) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[f][i], b = triangles[f][(i + 1) % 3];
      if (a != b) sides.emplace_back(edgeKey(a, b), std::uint32_t(f));
    }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());  // a triangle a-b-a has its edge once
  faces_.reserve(sides.size());
  for (const auto& [key, face] : sides) {
    if (keys_.empty() || keys_.back() != key) {
      starts_.push_back(std::uint32_t(faces_.size()));
      keys_.push_back(key);
    }
    faces_.push_back(face);
  }
  starts_.push_back(std::uint32_t(faces_.size()));
}

std::size_t MeshEdges::find(std::uint32_t a, std::uint32_t b) const {
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), edgeKey(a, b));
  return found != keys_.end() && *found == edgeKey(a, b) ? std::size_t(found - keys_.begin()) : size();
}

}  // namespace prt
