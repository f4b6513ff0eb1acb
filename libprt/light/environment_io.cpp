#include "libprt/light/environment_io.h"

#include "libprt/core/error.h"
#include "libprt/core/image_io.h"

#include <algorithm>

namespace prt {
namespace {

/// Whether at least half of what lies outside the mapping looks like the image's first pixel, which is
/// outside in every cross and angular map: empty, but for labels.
bool emptyOutside(const Image& image, EnvironmentMapping mapping) {
  const MapGeometry geometry(mapping, image.width, image.height);
  double inside = 0;
  std::size_t covered = 0, outside = 0, plain = 0;
  const auto light = [&](int x, int y) {
    const float l = luminance(image.rgb(x, y));
    return std::isfinite(l) ? std::max(l, 0.0f) : 0.0f;
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (geometry.covers(x, y)) inside += light(x, y), ++covered;
  const double visible = 0.01 * inside / double(std::max<std::size_t>(1, covered));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (!geometry.covers(x, y)) ++outside, plain += std::abs(light(x, y) - light(0, 0)) <= visible;
  return 2 * plain >= outside;
}

}  // namespace

std::optional<EnvironmentMapping> detectMapping(const Image& image) {
  if (image.width == 2 * image.height) return EnvironmentMapping::LatLong;
  for (const EnvironmentMapping mapping : environmentMappings()) {
    if (mapping == EnvironmentMapping::LatLong || !fitsMapping(mapping, image.width, image.height)) continue;
    const bool strip =
        mapping == EnvironmentMapping::HorizontalStrip || mapping == EnvironmentMapping::VerticalStrip;
    if (strip || emptyOutside(image, mapping)) return mapping;
  }
  return std::nullopt;
}

EnvironmentMap loadEnvironment(const std::filesystem::path& path, std::optional<EnvironmentMapping> mapping) {
  return makeEnvironment(readImage(path), path.string(), mapping);
}

EnvironmentMap makeEnvironment(const Image& image, const std::string& source,
                               std::optional<EnvironmentMapping> mapping) {
  const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
  if (mapping && !fitsMapping(*mapping, image.width, image.height))
    throw FileError("an image of " + size + " cannot be a " + toString(*mapping) + " map", source,
                    "name another mapping or none");
  const auto detected = mapping ? mapping : detectMapping(image);
  if (!detected)
    throw FileError(
        "no mapping of the sphere fits an image of " + size, source,
        "use a lat-long 2:1, cross 3:4 or 4:3, angular map 1:1 or cube strip 6:1 or 1:6, with nothing "
        "outside the mapping; or name the mapping");
  return EnvironmentMap(image, *detected, source);
}

}  // namespace prt
