#pragma once
// Random directions towards light, for the path tracer: a mixture of the environment's texels (by their
// power, exactly, row then column), circle lights and the constant. Directional lights cannot be hit and are
// listed apart. sample(), pdf() and radiance() describe the same piecewise-constant function.

#include "libprt/core/math.h"
#include "libprt/light/light_rig.h"

#include <span>
#include <vector>

namespace prt {

struct LightSample {
  Vec3 direction{0, 1, 0};
  Rgb radiance{0};  ///< all light from that direction
  float pdf = 0;    ///< per solid angle; 0 = no sample: nothing shines
};

/// Thread-safe once made. Costs one pass over the environment map.
class LightSampler {
 public:
  /// Keeps a copy of the rig (maps are shared). Throws ValueError as validate() does.
  explicit LightSampler(LightRig rig);

  /// One direction from u in [0,1)^2. Well-spread u give well-spread directions: u is stretched, not hashed.
  LightSample sample(const Vec2& u) const;
  /// Density, per solid angle, with which sample() yields unit direction `d`.
  float pdf(const Vec3& d) const;
  /// radiance(rig, d).
  Rgb radiance(const Vec3& d) const { return prt::radiance(rig_, toMap_, d); }

  std::span<const DirectionalLight> directionals() const { return rig_.directionals; }
  /// False when every sample has pdf 0: no light but perhaps directional ones.
  bool shines() const { return total_ > 0; }

 private:
  void addEnvironment();
  Vec3 sampleEnvironment(double u, double v) const;
  double environmentPdf(const Vec3& d) const;

  LightRig rig_;
  Mat3 toWorld_{1.0f}, toMap_{1.0f};
  // Power (luminance times solid angle) of each part; the sum. Parts are chosen in this order.
  double environmentPower_ = 0, constantPower_ = 0, total_ = 0;
  std::vector<double> circlePower_;
  // Cumulative share of power, in double: beside a sun a dim texel's share is below float's last digit.
  std::vector<double> rowCdf_;     // [height + 1]
  std::vector<double> columnCdf_;  // [height, width + 1], within each row
};

}  // namespace prt
