#pragma once
// As rigid as possible (Liu et al. 2008): a quick flat map of near isometric charts from a rough one. It may
// turn triangles over or overlap; whoever uses it looks, and falls back on a map that cannot.

#include "libprt/atlas/flat_chart.h"

namespace prt {

/// Alternates the best rotation of each triangle and one linear solve, with a matrix factored once.
/// Cotangents are limited to 0.02 .. 20.
std::vector<DVec2> asRigidAsPossible(const FlatChart& chart, std::vector<DVec2> start, int rounds, Job& job);

}  // namespace prt
