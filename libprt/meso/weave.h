#pragma once
// Cloth in plain weave, as real geometry: "interleaved, deformed cylinders" (Bi-Scale Radiance Transfer,
// section 4.2). Yarns along u and along v pass over and under each other in turn; each is a closed elliptic
// tube about a cosine, so that at a crossing the two centres lie at +A and -A. Behind the gaps lies an opaque
// backing plane.

#include "libprt/meso/patch.h"

namespace prt {

struct WeaveOptions {
  int yarns = 6;         ///< along each direction, even, 2..32
  float radius = 0.42f;  ///< half a yarn's width against the distance of yarns, 0.05..0.49
  float depth = 0.12f;   ///< whole thickness 2 (A + r) against the patch's width, 0.001..2
  /// Crossing amplitude: A against the least one that keeps the yarns apart, 1..4. More of it makes flatter
  /// yarns that wind more.
  float amplitude = 1.1f;
  int sides = 24;  ///< of a tube, 6..128
  int along = 16;  ///< rings of a tube from crossing to crossing, 4..128
  Rgb weft{0.5f};  ///< albedo of the yarns along u
  Rgb warp{0.5f};  ///< and along v
  Rgb backing{0.5f};
};

/// Throws ValueError when an option is out of range.
Patch weave(const WeaveOptions& options, Job* job = nullptr);

/// Half heights of tube and wave: r and A, with 2 (A + r) = depth. Yarns of neighbouring directions do not
/// meet when A cos(pi radius t) >= r sqrt(1 - t^2) for every t in 0..1 (ALGORITHMS 6.3 states it for t = 0
/// only, where wide yarns cut each other).
struct WeaveShape {
  double tube = 0;
  double wave = 0;
};
WeaveShape weaveShape(const WeaveOptions& options);

}  // namespace prt
