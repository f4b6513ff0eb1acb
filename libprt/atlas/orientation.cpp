#include "libprt/atlas/orientation.h"

#include <array>

namespace prt {
namespace {

/// Sign of the exact sum of six doubles: they are added one by one into an expansion, parts that do not
/// overlap, of which the last one that is not zero is the largest.
int signOfSum(const std::array<double, 6>& terms) {
  std::array<double, 6> parts{};
  std::size_t count = 0;
  for (double term : terms) {
    double carry = term;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double sum = carry + parts[i], virtualPart = sum - carry;
      const double error = (carry - (sum - virtualPart)) + (parts[i] - virtualPart);
      if (error != 0) parts[kept++] = error;
      carry = sum;
    }
    if (carry != 0) parts[kept++] = carry;
    count = kept;
  }
  if (count == 0) return 0;
  return parts[count - 1] > 0 ? 1 : -1;
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double ax = a.x, ay = a.y, bx = b.x, by = b.y, cx = c.x, cy = c.y;
  const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax), det = left - right;
  if (std::abs(det) > 4.5e-16 * (std::abs(left) + std::abs(right))) return det > 0 ? 1 : -1;
  return signOfSum({ax * by, -(ay * bx), bx * cy, -(by * cx), cx * ay, -(cy * ax)});
}

}  // namespace prt
