#pragma once
// Environment maps of our own making, for the built-in scenes, tests and demonstrations. All are lat-long
// maps whose pixels are means over their texels.

#include "libprt/basis/sh.h"
#include "libprt/light/environment.h"

#include <functional>
#include <span>
#include <string>

namespace prt {

/// A lat-long map of a function of direction: each pixel the mean of `samples` x `samples` values spread
/// evenly over its solid angle.
EnvironmentMap environmentFromFunction(int width, int height,
                                       const std::function<Rgb(const DVec3&)>& function, int samples = 2,
                                       const std::string& name = "function");

/// Clear sky with sun. Luminance over the sky: CIE standard clear sky (ISO 15469 type 12). Sun to sky: IES
/// daylight availability for clear weather (direct 127.5 exp(-0.21 m), diffuse 0.8 + 15.5 sqrt(sin h), in
/// klx) at relative air mass m (Kasten and Young 1989). Colours are a simple choice of ours: blue away from
/// the sun, paler to the horizon, the sun reddened by Rayleigh and haze extinction. Scaled so that a level
/// white plane looks 1.
struct ClearSky {
  Vec3 sunDirection{0.5f, 0.7071068f, 0.5f};  ///< unit, above the horizon
  bool sun = true;  ///< with the disc of 0.2665 degrees half-angle; its energy is exact at any size
  Rgb ground{0.2f, 0.18f, 0.15f};  ///< albedo of the ground below the horizon
};
/// Throws ValueError when the sun is not at least one degree above the horizon.
EnvironmentMap clearSky(const ClearSky& sky = {}, int width = 512, int height = 256);

/// The same sky in a moment, to follow a sun that is dragged. `map` is coarse, `coefficients` are not made
/// from it: the sky and ground are projected from its pixels without the sun, and the sun's disc is added in
/// closed form, so that it moves smoothly. Within 1 % of projecting clearSky() (relative, all bands
/// together).
struct QuickSky {
  EnvironmentMap map;
  ShRgb coefficients;
};
/// Throws as clearSky does, and ValueError unless 1 <= bands <= kMaxShBands.
QuickSky quickClearSky(const ClearSky& sky, int bands, int width = 128, int height = 64);

/// CIE overcast sky, luminance (1 + 2 sin h) / 3 of the zenith's, over dark ground; a level white plane
/// looks 1.
EnvironmentMap overcastSky(int width = 512, int height = 256);

/// A dim room with three softboxes: a large warm key from the left front, a weak cool fill from the right,
/// a narrow bright rim light behind.
EnvironmentMap softboxStudio(int width = 512, int height = 256);

/// Shows orientation at a glance: each side of a cube in its own colour with its axis written on it, upright
/// and readable from the inside. +X red, -X cyan, +Y green, -Y magenta, +Z blue, -Z yellow.
EnvironmentMap orientationMap(int width = 512, int height = 256);

struct BuiltInSky {
  std::string name;  ///< "clear-sky", "overcast", "studio", "orientation"
  std::string description;
  EnvironmentMap (*make)(int width, int height);
};
std::span<const BuiltInSky> builtInSkies();
/// Throws ValueError that lists the names.
EnvironmentMap builtInSky(const std::string& name, int width = 512, int height = 256);

}  // namespace prt
