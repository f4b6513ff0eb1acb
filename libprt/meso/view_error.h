#pragma once
// What a radiance transfer texture gets wrong between the views that it holds: the same surface, under the
// same light, seen exactly from views that it must interpolate. Nothing but the views differs, so this is
// the error that more views lower (ALGORITHMS 6.2; for lobes cos^s of s = 1 / 4 / 8 / 16 a square of 8 x 8
// views is 6 / 9 / 14 / 24 % off, one of 16 x 16 2.2 / 2.8 / 4.9 / 8 %).

#include "libprt/meso/rtt_bake.h"

namespace prt {

/// Relative root-mean-square errors of exit radiance over texels and views, for lights of all directions
/// together: independent coefficients that fall as 1/(l+1).
struct ViewError {
  double between = 0;  ///< views between the centres of cells
  double beyond = 0;   ///< views lower than the outermost centres, where the outermost values go on
};

/// Above this, more views are worth their memory: what a matte lobe (s = 4) costs with 8 x 8 views.
inline constexpr double kMuchViewError = 0.09;

/// Measures it along kViewErrorViews views of each kind, on every fourth row of texels. `rtt` was made from
/// the same patch, light and settings. A table of one view has no views to interpolate: both are against that
/// one. Deterministic.
inline constexpr int kViewErrorViews = 18;
ViewError measureViewError(const PatchScene& patch, const PatchLight& light, const RttSettings& settings,
                           const Rtt& rtt, Job& job);

}  // namespace prt
