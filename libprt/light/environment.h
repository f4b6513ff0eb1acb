#pragma once
// Light from far away in all directions, as an image: its pixels, its mapping, its lookups.
// Reading files: environment_io.h.
//
// The map is piecewise constant: every direction inside a texel has the radiance of that texel's pixel.
// Lookups, projection (projection.h) and the path tracer's sampler (light_sampler.h) all treat the very
// same function, so that they agree exactly. Environment intensity and rotation belong to the LightRig.

#include "libprt/core/image.h"
#include "libprt/core/math.h"
#include "libprt/light/environment_mapping.h"

#include <cstddef>
#include <string>

namespace prt {

/// What was found, and mended, in the covered pixels of an environment image.
struct EnvironmentReport {
  std::string source;  ///< file or generator
  EnvironmentMapping mapping = EnvironmentMapping::LatLong;
  int width = 0, height = 0;
  std::size_t covered = 0;    ///< pixels that hold light
  std::size_t negative = 0;   ///< pixels with a negative channel, set to 0
  std::size_t nonFinite = 0;  ///< with NaN (set to 0), infinity or more than kMaxRadiance (set to 65504)
  std::size_t atHalfMax = 0;  ///< pixels with a channel at 65504, the largest half: the light may be clipped
  std::size_t labels = 0;     ///< pixels outside the mapping that held something (labels) and are masked
  float smallest = 0;         ///< smallest positive luminance
  float largest = 0;          ///< largest luminance
  Rgb mean{0};                ///< mean radiance over the sphere

  /// log2 of largest over smallest positive luminance.
  double stops() const;
  /// One line for the user about what was mended or may be wrong; empty when there is nothing to say.
  std::string warning() const;
};

/// Radiance above this cannot be meant (the sun is at about 2e7 W/m2/sr, 2e9 cd/m2).
inline constexpr float kMaxRadiance = 1e12f;

/// Immutable once made; share it as std::shared_ptr<const EnvironmentMap>.
class EnvironmentMap {
 public:
  /// Takes the first three channels (or the only one). Masks what lies outside the mapping, clamps
  /// negative and non-finite values. Throws ValueError when the size does not fit the mapping or there
  /// are no pixels.
  EnvironmentMap(const Image& image, EnvironmentMapping mapping, std::string source = {});

  const MapGeometry& geometry() const { return geometry_; }
  const EnvironmentReport& report() const { return report_; }
  int width() const { return geometry_.width(); }
  int height() const { return geometry_.height(); }

  /// Radiance arriving from unit direction `d` (pointing to where it comes from).
  Rgb radiance(const Vec3& d) const {
    const Vec2 p = geometry_.toImage(d);
    return pixels_.rgb(int(p.x), int(p.y));
  }
  /// The pixels, three channels; 0 where nothing is covered.
  const Image& pixels() const { return pixels_; }

  /// f(x, y, direction, solidAngle, radiance) for each covered texel, row by row: DVec3 direction of its
  /// centre, exact solid angle (double).
  template <class F>
  void forEachTexel(F&& f) const {
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x)
        if (geometry_.covers(x, y))
          f(x, y, geometry_.center(x, y), geometry_.solidAngle(x, y), pixels_.rgb(x, y));
  }

 private:
  void clean();
  void fillRim();
  void mask();
  void measure();

  MapGeometry geometry_;
  Image pixels_;
  EnvironmentReport report_;
};

}  // namespace prt
