#include "libprt/project/recipe.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace prt {
namespace {

/// Letters to insert, delete, replace or swap with their neighbour (optimal string alignment).
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearestName(const std::string& name, const std::vector<std::string>& names) {
  if (name.empty() || name.size() > 200) return {};
  std::string best;
  std::size_t bestDistance = 1 + std::max<std::size_t>(2, name.size() / 2);
  for (const std::string& candidate : names) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < bestDistance) best = candidate, bestDistance = distance;
  }
  return best;
}

}  // namespace prt
