#pragma once
// Environment maps at another size, or in the mapping that everybody else reads.

#include "libprt/core/job.h"
#include "libprt/light/environment.h"

namespace prt {

/// The same light as a lat-long map: each pixel the mean over its region of the sphere. Total energy is kept
/// to float rounding, that of each lamp or sun to about 1e-3, and a constant map stays constant. From
/// lat-long maps all overlaps of texels are exact; from other mappings they are measured at sample points.
EnvironmentMap toLatLong(const EnvironmentMap& map, int width, int height);
/// The same for maps so large that somebody may not want to wait.
EnvironmentMap toLatLong(const EnvironmentMap& map, int width, int height, Job& job);

/// The map seen out of focus: each texel of a coarse lat-long map is the mean of all light, weighted with a
/// Gaussian of this standard deviation (radians, at least 0.08) about its direction. To be shown between
/// texels. A few milliseconds, and the time of toLatLong().
EnvironmentMap blurredLatLong(const EnvironmentMap& map, double deviation);
EnvironmentMap blurredLatLong(const EnvironmentMap& map, double deviation, Job& job);

}  // namespace prt
