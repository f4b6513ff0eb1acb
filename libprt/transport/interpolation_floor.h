#pragma once
// The interpolation floor: how far a picture that interpolates baked vertices, or texels, must be from the
// truth, even if every one were exact. It is their resolution against the sharpness of the shadows; no number
// of rays lowers it, more vertices or texels do. Every bake reports it, so that errors of pictures can be
// judged.

#include "libprt/core/job.h"
#include "libprt/transport/transfer_bake.h"

#include <cstddef>
#include <memory>
#include <span>

namespace prt {

struct FloorOptions {
  std::size_t points = 1024;  ///< random surface points that are compared, 16 .. 100 000
  int maxRays = 256;          ///< rays at each, if the bake has more: noise is cancelled, not averaged out
  std::uint64_t seed = 1;
};

/// Relative root-mean-square errors of irradiance over the surface, noise separated: every mean square is the
/// product of two independent estimates, so that their noise averages to zero instead of adding up.
struct InterpolationFloor {
  double interpolation = 0;       ///< exact samples, interpolated, against exact points: the floor
  double interpolationError = 0;  ///< standard error of that, from the choice of points
  double product = 0;             ///< the baked samples, interpolated, against exact points
  double sampling = 0;     ///< what the product's own sampling noise adds: sqrt(product^2 - interpolation^2)
  std::size_t points = 0;  ///< compared; points or samples inside of something are left out
};

/// Measures the floor of a finished bake at the scene's vertices or texels, `surface`. `lights` are what it
/// is judged by, all together; none = a prior over all lights: a white sky plus independent random
/// coefficients whose standard deviation falls as 1/(l+1). A product of form None interpolates nothing: all
/// zero. Costs about 8 bakes of `points` samples.
InterpolationFloor measureInterpolationFloor(std::shared_ptr<const Scene> scene,
                                             std::shared_ptr<const RayScene> rays, const SampleSet& surface,
                                             const Transfer& transfer, const TransferSettings& settings,
                                             std::span<const ShRgb> lights, Job& job,
                                             const FloorOptions& options = {});

}  // namespace prt
