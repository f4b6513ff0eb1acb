#include "libprt/basis/sh_turns.h"

#include "libprt/basis/sh_rotation.h"

#include <cmath>

namespace prt {
namespace {

ShTurns<double>::Turn turnTowards(double x, double y) {
  const double length = std::hypot(x, y);
  if (!(length > 0)) return {1, 0};
  return {x / length, y / length};
}

}  // namespace

ShTurns<double> shTurns(const glm::dmat3& r) {
  // c is what is left of R when a and b are taken off, which holds at the poles too, where any a will do.
  ShTurns<double> turns;
  const double lean = std::hypot(r[2].x, r[2].y);
  const auto& a = turns.a = turnTowards(r[2].x, r[2].y);
  const auto& b = turns.b = turnTowards(r[2].z, lean);
  const double along = a.cosine * r[0].x + a.sine * r[0].y, across = a.cosine * r[0].y - a.sine * r[0].x;
  turns.c = turnTowards(b.cosine * along - b.sine * r[0].z, across);
  return turns;
}

const ShQuarterTurn& ShQuarterTurn::instance() {
  static const ShQuarterTurn made;
  return made;
}

ShQuarterTurn::ShQuarterTurn() {
  const ShRotation all(kMaxShOnceBands, glm::dmat3(DVec3(1, 0, 0), DVec3(0, 0, -1), DVec3(0, 1, 0)));
  for (int l = 0; l < kMaxShOnceBands; ++l)
    for (int m = -l; m <= l; ++m) {
      rows_[std::size_t(shIndex(l, m))] = elements_.size();
      for (int k = -l; k <= l; ++k) {
        const double value = all.block(l)[std::size_t((m + l) * (2 * l + 1) + k + l)];
        if (std::abs(value) > 1e-13) elements_.push_back({value, float(value), shIndex(l, k)});
      }
    }
  rows_.back() = elements_.size();
}

}  // namespace prt
