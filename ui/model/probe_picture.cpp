#include "ui/model/probe_picture.h"

#include "libprt/shade/tonemap.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {
constexpr float kMiddleGrey = 0.25f;
}

Image probePicture(const EnvironmentMap& map, int width, int height) {
  const float mean = std::max(luminance(map.report().mean), 1e-6f);
  const ToneSettings tone{.exposure = std::log2(kMiddleGrey / mean), .curve = ToneCurve::Filmic};
  Image picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    const double theta = (y + 0.5) * kPi / height;
    for (int x = 0; x < width; ++x) {
      const double phi = (x + 0.5) * 2 * kPi / width - kPi;
      const Vec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
      const Rgb c = toDisplay(map.radiance(d), tone);
      std::copy_n(&c.x, 3, picture.pixel(x, y));
    }
  }
  return picture;
}

}  // namespace prt::ui
