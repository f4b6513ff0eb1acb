#pragma once
// Where a bake is wrong: estimates of its error at every vertex, by cause.
//
//   Monte Carlo    the bake's rays are random: the standard error of what it stored. Where it is, the scatter
//   of a
//                  few independent bakes with fewer rays tells; how much of it the product has left, some
//                  vertices that are baked again with as many rays.
//   interpolation  pictures interpolate between vertices: the difference to the truth at points inside the
//   faces,
//                  each estimated twice with rays of its own, so that noise cancels (as
//                  interpolation_floor.h).
//   truncation     light has more bands than the product holds, and may be windowed: what the bands up to
//                  kErrorBands would add. Light in bands beyond those is not seen; of sharp lights the number
//                  is a lower bound.
//
// All are errors of irradiance, as root-mean-squares, relative to the root-mean-square irradiance of the
// surface. The tracing (ErrorProbe) knows no light: one probe serves any light, at the price of a few matrix
// products.

#include "libprt/core/job.h"
#include "libprt/transport/transfer_bake.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace prt {

/// Bands that truncation is judged with.
inline constexpr int kErrorBands = 10;

/// The light that errors are judged under.
struct JudgedLight {
  ShRgb whole;  ///< what the light is, kErrorBands bands (fewer: the rest is 0)
  ShRgb shown;  ///< what pictures are made with: in the product's bands, windowed
};

/// Errors of one bake under one light.
struct ErrorMap {
  enum Component { MonteCarlo, Interpolation, Truncation };
  /// [V] the three components; all -1 at vertices inside of something, where nothing is seen.
  std::vector<Vec3> vertices;
  DVec3 rms{0};  ///< of each component over the surface, by area
  double meanIrradiance =
      0;  ///< what everything is relative to: root-mean-square over the surface, length of RGB

  /// All causes together at a vertex: they are independent, so squares add up. -1 where unknown.
  float total(std::size_t vertex) const;
  double totalRms() const;
  /// Share of a component in the mean square, 0..1.
  double share(Component component) const;
};

struct ErrorProbeOptions {
  std::uint64_t seed = 1;
  std::size_t mostPoints = 200000;  ///< inside faces; of larger meshes a part of the faces is looked at
};

struct ProbedVertices;
struct ProbedPoints;

class ErrorProbe {
 public:
  /// Measures a finished product of the scene's vertices. Costs about one more bake. `preview`, if given,
  /// gets the probe as soon as all but interpolation is known. A product of form None has no errors. Throws
  /// ValueError when the parts do not fit, ResourceError when memory does not suffice, Cancelled.
  static ErrorProbe measure(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
                            const SampleSet& vertices, std::shared_ptr<const Transfer> transfer,
                            const TransferSettings& settings, Job& job,
                            const std::function<void(ErrorProbe)>& preview = {},
                            const ErrorProbeOptions& options = {});

  /// Errors under a light. Quick: proportional to vertices and functions.
  ErrorMap under(const JudgedLight& light) const;
  /// Errors under the prior of interpolation_floor.h: a white sky plus random light whose coefficients fall
  /// as 1/(l+1), here up to kErrorBands bands.
  ErrorMap underPrior() const;

  bool knowsInterpolation() const;
  std::size_t vertexCount() const;

 private:
  std::shared_ptr<const ProbedVertices> vertices_;
  std::shared_ptr<const ProbedPoints> points_;
};

}  // namespace prt
