#include "libprt/light/built_in_skies.h"

#include "libprt/basis/sh_zonal.h"
#include "libprt/core/error.h"
#include "libprt/light/light_rig.h"
#include "libprt/light/projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace prt {
namespace {

constexpr double kSunHalfAngle = 0.2665 * kPi / 180;

// --- Clear sky -----------------------------------------------------------------------------------

/// CIE general sky, type 12, relative to nothing in particular: gradation times indicatrix.
double cieClearLuminance(double sinElevation, double sunAngle) {
  const double gradation = 1 - std::exp(-0.32 / std::max(sinElevation, 1e-3));
  const double indicatrix =
      1 + 10 * (std::exp(-3 * sunAngle) - std::exp(-3 * kPi / 2)) + 0.45 * std::pow(std::cos(sunAngle), 2);
  return gradation * indicatrix;
}

double airMass(double elevation) {
  return 1 / (std::sin(elevation) + 0.50572 * std::pow(degrees(elevation) + 6.07995, -1.6364));
}

/// `colour` scaled to luminance 1.
Rgb tint(const Rgb& colour) {
  return colour / luminance(colour);
}

/// Sky colour of luminance 1: deep blue, but pale where the path through the air is long and near the sun.
Rgb skyTint(double sinElevation, double sunAngle) {
  const float pale =
      float(std::clamp(0.15 + 0.75 * std::exp(-4 * sinElevation) + 0.5 * std::exp(-5 * sunAngle), 0.0, 1.0));
  return tint(mix(Rgb(0.25f, 0.45f, 1.0f), Rgb(0.85f, 0.92f, 1.0f), pale));
}

/// Sunlight of luminance 1 after `mass` air masses: optical depths of air and thin haze for R, G and B.
Rgb sunTint(double mass) {
  const float m = float(mass);
  return tint(Rgb(std::exp(-0.11f * m), std::exp(-0.15f * m), std::exp(-0.26f * m)));
}

/// Irradiance on a level plane.
Rgb levelIrradiance(const EnvironmentMap& map) {
  glm::dvec3 sum(0);
  map.forEachTexel([&](int, int, const DVec3& d, double solidAngle, const Rgb& c) {
    if (d.y > 0) sum += solidAngle * d.y * glm::dvec3(c);
  });
  return Rgb(sum);
}

/// Adds a disc of light of this irradiance (facing it): each texel gets the share of the disc it holds.
void addDisc(Image& image, const DVec3& direction, double halfAngle, const Rgb& irradiance) {
  const MapGeometry geometry(EnvironmentMapping::LatLong, image.width, image.height);
  const Frame frame = frameFromNormal(Vec3(direction));
  // points spread evenly over the disc, enough for a smooth edge at any size that fits in memory
  constexpr int rings = 64, spokes = 64;
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < spokes; ++s) {
      const double radius = std::sin(halfAngle) * std::sqrt((r + 0.5) / rings),
                   turn = 2 * kPi * (s + 0.5 * (r & 1)) / spokes;
      const DVec3 d =
          std::sqrt(1 - radius * radius) * direction +
          radius * (std::cos(turn) * DVec3(frame.tangent) + std::sin(turn) * DVec3(frame.bitangent));
      const Vec2 p = geometry.toImage(Vec3(d));
      const float share = float(1 / (rings * spokes * geometry.solidAngle(int(p.x), int(p.y))));
      float* pixel = image.pixel(int(p.x), int(p.y));
      for (int c = 0; c < 3; ++c) pixel[c] += share * irradiance[c];
    }
}

/// The lower half of the sphere becomes ground of this radiance, then all is scaled.
void addGround(Image& image, const Rgb& radiance, float scale) {
  for (int y = 0; y < image.height; ++y) {
    // the share of the row's solid angle that lies below the horizon
    const double top = std::cos(kPi * y / image.height), bottom = std::cos(kPi * (y + 1) / image.height);
    const float below = float(std::clamp(-bottom / (top - bottom), 0.0, 1.0));
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        float& value = image.pixel(x, y)[c];
        value = scale * (value + below * radiance[c]);
      }
  }
}

/// Ground of this albedo that the sky lights; then all is scaled until a level white plane looks 1.
EnvironmentMap withGround(Image image, const Rgb& albedo, const std::string& name) {
  const Rgb plane = levelIrradiance(EnvironmentMap(image, EnvironmentMapping::LatLong)) / kPiF;
  addGround(image, albedo * plane, 1 / luminance(plane));
  return EnvironmentMap(image, EnvironmentMapping::LatLong, name);
}

/// The clear sky without its sun, black below the horizon, and the sun's irradiance on what faces it; both in
/// klx.
struct ClearSkyParts {
  DVec3 toSun;
  Image sky;
  Rgb levelIrradiance;  ///< of the sky
  Rgb sun{0};
};

ClearSkyParts clearSkyParts(const ClearSky& sky, int width, int height) {
  const DVec3 sun = normalize(DVec3(sky.sunDirection));
  const double elevation = std::asin(std::clamp(sun.y, -1.0, 1.0));
  if (!(elevation >= radians(1.0) - 1e-6))
    throw ValueError("the sun is not above the horizon", "clear sky", "raise it to at least one degree");

  const EnvironmentMap shape = environmentFromFunction(width, height, [&](const DVec3& d) {
    if (d.y <= 0) return Rgb(0);
    const double angle = std::acos(std::clamp(dot(d, sun), -1.0, 1.0));
    return float(cieClearLuminance(d.y, angle)) * skyTint(d.y, angle);
  });

  // Diffuse and direct light in klx fix the sky's scale against the sun's.
  const double mass = airMass(elevation);
  const float diffuse = float(0.8 + 15.5 * std::sqrt(sun.y)), direct = float(127.5 * std::exp(-0.21 * mass));
  const Rgb level = levelIrradiance(shape);
  const float scale = diffuse / luminance(level);
  ClearSkyParts parts{sun, shape.pixels(), scale * level};
  for (float& value : parts.sky.data) value *= scale;
  if (sky.sun) parts.sun = direct * sunTint(mass);
  return parts;
}

// --- Studio ---------------------------------------------------------------------------------------------

struct Softbox {
  DVec3 center;          ///< direction; the box stands at distance 1, facing the origin
  double width, height;  ///< half sizes at that distance
  Rgb radiance;

  /// Radiance towards the origin from direction `d`; bright in the middle, with a soft edge.
  Rgb operator()(const DVec3& d) const {
    const DVec3 n = normalize(center), side = normalize(cross(DVec3(0, 1, 0), n)), up = cross(n, side);
    const double along = dot(d, n);
    if (along <= 0) return Rgb(0);
    const double u = std::abs(dot(d, side) / along) / width, v = std::abs(dot(d, up) / along) / height;
    const auto edge = [](double t) { return glm::smoothstep(1.0, 0.85, t); };
    return radiance * float(edge(u) * edge(v) * (1 - 0.25 * (u * u + v * v)));
  }
};

// --- Orientation ----------------------------------------------------------------------------------------

/// Letters of 5 x 7 dots, rows from the top.
std::array<std::string_view, 7> glyph(char c) {
  switch (c) {
    case '+':
      return {".....", "..#..", "..#..", "#####", "..#..", "..#..", "....."};
    case '-':
      return {".....", ".....", ".....", "#####", ".....", ".....", "....."};
    case 'X':
      return {"#...#", "#...#", ".#.#.", "..#..", ".#.#.", "#...#", "#...#"};
    case 'Y':
      return {"#...#", "#...#", ".#.#.", "..#..", "..#..", "..#..", "..#.."};
    default:
      return {"#####", "....#", "...#.", "..#..", ".#...", "#....", "#####"};
  }
}

struct Side {
  DVec3 center, right, up;
  char sign, letter;
  Rgb colour;
};

const std::array<Side, 6>& sides() {
  static const DVec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  static const std::array<Side, 6> all{{{x, z, y, '+', 'X', Rgb(0.8f, 0.05f, 0.05f)},
                                        {-x, -z, y, '-', 'X', Rgb(0.05f, 0.6f, 0.6f)},
                                        {y, x, z, '+', 'Y', Rgb(0.1f, 0.65f, 0.1f)},
                                        {-y, x, -z, '-', 'Y', Rgb(0.6f, 0.1f, 0.6f)},
                                        {z, -x, y, '+', 'Z', Rgb(0.1f, 0.15f, 0.9f)},
                                        {-z, x, y, '-', 'Z', Rgb(0.75f, 0.65f, 0.05f)}}};
  return all;
}

Rgb orientationColour(const DVec3& d) {
  const Side& side = *std::max_element(sides().begin(), sides().end(), [&](const Side& a, const Side& b) {
    return dot(a.center, d) < dot(b.center, d);
  });
  const double u = dot(side.right, d) / dot(side.center, d), v = dot(side.up, d) / dot(side.center, d);
  if (std::max(std::abs(u), std::abs(v)) > 0.97) return 0.25f * side.colour;  // the cube's edges
  // two letters in a field of 11 x 7 dots across the middle of the side
  const int column = int(std::floor(u * 8 + 5.5)), row = int(std::floor(3.5 - v * 8));
  if (row >= 0 && row < 7 && column >= 0 && column < 11 && column != 5) {
    const char letter = column < 5 ? side.sign : side.letter;
    if (glyph(letter)[std::size_t(row)][std::size_t(column < 5 ? column : column - 6)] == '#') return Rgb(1);
  }
  return side.colour;
}

}  // namespace

EnvironmentMap environmentFromFunction(int width, int height,
                                       const std::function<Rgb(const DVec3&)>& function, int samples,
                                       const std::string& name) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    const double top = std::cos(kPi * y / height), bottom = std::cos(kPi * (y + 1) / height);
    for (int x = 0; x < width; ++x) {
      Rgb sum(0);
      for (int i = 0; i < samples * samples; ++i) {
        const double u = (i % samples + 0.5) / samples, v = (i / samples + 0.5) / samples;
        const double cosine = glm::mix(top, bottom, v), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        const double azimuth = ((x + u) / width - 0.5) * 2 * kPi;
        sum += function(DVec3(sine * std::sin(azimuth), cosine, -sine * std::cos(azimuth)));
      }
      sum /= float(samples * samples);
      std::copy_n(&sum.x, 3, image.pixel(x, y));
    }
  }
  return EnvironmentMap(image, EnvironmentMapping::LatLong, name);
}

EnvironmentMap clearSky(const ClearSky& sky, int width, int height) {
  ClearSkyParts parts = clearSkyParts(sky, width, height);
  if (sky.sun) addDisc(parts.sky, parts.toSun, kSunHalfAngle, parts.sun);
  return withGround(std::move(parts.sky), sky.ground, "clear sky");
}

QuickSky quickClearSky(const ClearSky& sky, int bands, int width, int height) {
  ClearSkyParts parts = clearSkyParts(sky, width, height);
  // A disc wholly above the horizon sends irradiance times the sine of its height to a level plane.
  const Rgb plane = (parts.levelIrradiance + float(parts.toSun.y) * parts.sun) / kPiF;
  const float scale = 1 / luminance(plane);
  addGround(parts.sky, sky.ground * plane, scale);
  const Rgb sun = scale * parts.sun;

  ShRgb coefficients = projectEnvironment(EnvironmentMap(parts.sky, EnvironmentMapping::LatLong), bands);
  if (sky.sun) {
    const double facing = kPi * std::pow(std::sin(kSunHalfAngle), 2);  // projected solid angle of the disc
    const std::vector<double> disc = rotateZonal(capZonal(bands, kSunHalfAngle), parts.toSun);
    for (std::size_t k = 0; k < disc.size(); ++k) coefficients.c[k] += float(disc[k] / facing) * sun;
    addDisc(parts.sky, parts.toSun, kSunHalfAngle, sun);
  }
  return {EnvironmentMap(parts.sky, EnvironmentMapping::LatLong, "clear sky"), std::move(coefficients)};
}

EnvironmentMap overcastSky(int width, int height) {
  const EnvironmentMap sky = environmentFromFunction(width, height, [](const DVec3& d) {
    return d.y > 0 ? Rgb(float(1 + 2 * d.y)) * tint(Rgb(0.96f, 0.98f, 1.0f)) : Rgb(0);
  });
  return withGround(sky.pixels(), Rgb(0.2f), "overcast sky");
}

EnvironmentMap softboxStudio(int width, int height) {
  const std::array<Softbox, 3> boxes{{{DVec3(-0.8, 0.75, 0.9), 0.45, 0.6, 14.0f * Rgb(1.0f, 0.93f, 0.82f)},
                                      {DVec3(1.0, 0.25, 0.55), 0.4, 0.5, 2.5f * Rgb(0.82f, 0.9f, 1.0f)},
                                      {DVec3(0.35, 0.55, -1.0), 0.14, 0.6, 22.0f * Rgb(1.0f, 0.98f, 0.95f)}}};
  return environmentFromFunction(
      width, height,
      [&](const DVec3& d) {
        Rgb light =
            glm::mix(Rgb(0.03f, 0.028f, 0.026f), Rgb(0.12f), float(0.5 + 0.5 * d.y));  // floor to ceiling
        for (const Softbox& box : boxes) light += box(d);
        return light;
      },
      3, "three-softbox studio");
}

EnvironmentMap orientationMap(int width, int height) {
  return environmentFromFunction(width, height, orientationColour, 3, "orientation map");
}

std::span<const BuiltInSky> builtInSkies() {
  static const std::vector<BuiltInSky> skies{
      {"clear-sky", "clear sky with a sun at 45 degrees", [](int w, int h) { return clearSky({}, w, h); }},
      {"overcast", "CIE overcast sky", overcastSky},
      {"studio", "dim room with three softboxes", softboxStudio},
      {"orientation", "each axis in its own colour, written on it", orientationMap}};
  return skies;
}

EnvironmentMap builtInSky(const std::string& name, int width, int height) {
  std::string names;
  for (const BuiltInSky& sky : builtInSkies()) {
    if (sky.name == name) return sky.make(width, height);
    names += (names.empty() ? "" : ", ") + sky.name;
  }
  throw ValueError("no built-in sky '" + name + "'", "environment", "use one of " + names);
}

}  // namespace prt
