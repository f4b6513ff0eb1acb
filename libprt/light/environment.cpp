#include "libprt/light/environment.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

constexpr float kHalfMax = 65504.0f;

Image firstThreeChannels(const Image& image) {
  if (image.empty()) throw ValueError("the image has no pixels", "environment map", "choose another file");
  Image rgb(image.width, image.height, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Rgb c = image.rgb(x, y);
      std::copy_n(&c.x, 3, rgb.pixel(x, y));
    }
  return rgb;
}

/// A finite, non-negative stand-in for a channel of an image from outside.
float mended(float value) {
  if (std::isnan(value) || value < 0) return 0;
  return value > kMaxRadiance ? kHalfMax : value;
}

}  // namespace

double EnvironmentReport::stops() const {
  return smallest > 0 ? std::log2(double(largest) / double(smallest)) : 0;
}

std::string EnvironmentReport::warning() const {
  std::string text;
  const auto say = [&](std::size_t count, const std::string& what) {
    if (count) text += (text.empty() ? "" : "; ") + std::to_string(count) + what;
  };
  say(negative, " negative pixels set to 0");
  say(nonFinite, " pixels that were not finite mended");
  say(atHalfMax, " pixels at 65504, the largest half-float: bright light may have been clipped");
  return text;
}

EnvironmentMap::EnvironmentMap(const Image& image, EnvironmentMapping mapping, std::string source)
    : geometry_(mapping, image.width, image.height), pixels_(firstThreeChannels(image)) {
  report_.source = std::move(source);
  report_.mapping = mapping;
  report_.width = image.width;
  report_.height = image.height;
  clean();
  if (mapping == EnvironmentMapping::AngularMap) fillRim();
  measure();
  mask();
}

/// Mends covered pixels and counts what was wrong with them.
void EnvironmentMap::clean() {
  for (int y = 0; y < height(); ++y)
    for (int x = 0; x < width(); ++x) {
      float* p = pixels_.pixel(x, y);
      if (geometry_.covers(x, y)) {
        const auto any = [&](auto&& test) { return test(p[0]) || test(p[1]) || test(p[2]); };
        report_.covered += 1;
        report_.negative += any([](float v) { return v < 0; });
        report_.nonFinite += any([](float v) { return std::isnan(v) || v > kMaxRadiance; });
        report_.atHalfMax += any([](float v) { return v == kHalfMax; });
      }
      for (int c = 0; c < 3; ++c) p[c] = mended(p[c]);
    }
}

/// The rim of an angular map cuts through pixels. One whose centre lies outside the disc was never meant to
/// be seen: it takes the colour of the pixel next to it towards the centre.
void EnvironmentMap::fillRim() {
  const double middle = 0.5 * width();
  const auto centerInside = [&](int x, int y) {
    return std::hypot(x + 0.5 - middle, y + 0.5 - middle) < middle;
  };
  const Image original = pixels_;
  for (int y = 0; y < height(); ++y)
    for (int x = 0; x < width(); ++x) {
      if (!geometry_.covers(x, y) || centerInside(x, y)) continue;
      const double dx = middle - x - 0.5, dy = middle - y - 0.5, far = std::hypot(dx, dy);
      for (double step = 0.5; step < far; step += 0.5) {
        const int sx = int(x + 0.5 + dx / far * step), sy = int(y + 0.5 + dy / far * step);
        if (!centerInside(sx, sy)) continue;
        std::copy_n(original.pixel(sx, sy), 3, pixels_.pixel(x, y));
        break;
      }
    }
}

/// Range and mean of the covered pixels.
void EnvironmentMap::measure() {
  glm::dvec3 sum(0);
  forEachTexel([&](int, int, const DVec3&, double solidAngle, const Rgb& c) {
    sum += solidAngle * glm::dvec3(c);
    const float light = luminance(c);
    report_.largest = std::max(report_.largest, light);
    if (light > 0) report_.smallest = report_.smallest > 0 ? std::min(report_.smallest, light) : light;
  });
  report_.mean = Rgb(sum / (4 * kPi));
}

/// Blackens what lies outside the mapping; counts what stood out there, such as copyright labels.
void EnvironmentMap::mask() {
  const float visible = 0.01f * luminance(report_.mean);
  for (int y = 0; y < height(); ++y)
    for (int x = 0; x < width(); ++x) {
      if (geometry_.covers(x, y)) continue;
      report_.labels += luminance(pixels_.rgb(x, y)) > visible;
      std::fill_n(pixels_.pixel(x, y), 3, 0.0f);
    }
}

}  // namespace prt
