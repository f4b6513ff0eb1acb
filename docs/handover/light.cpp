#include "light.h"

#include <cmath>
#include <numbers>

// Going up from Y(m,m): each function is a polynomial in z times the real or imaginary part of (x + iy)^m.
std::vector<float> shBasis(int bands, const Vec3& d) {
  std::vector<float> y(std::size_t(bands) * std::size_t(bands));
  double diagonal = 0.5 / std::sqrt(std::numbers::pi), c = 1, s = 0;
  for (int m = 0; m < bands; ++m) {
    double before = 0, now = diagonal * (m > 0 ? std::numbers::sqrt2 : 1);
    for (int l = m; l < bands; ++l) {
      y[std::size_t(l * (l + 1) + m)] = float(now * c);
      if (m > 0) y[std::size_t(l * (l + 1) - m)] = float(now * s);
      const double up = std::sqrt((4.0 * (l + 1) * (l + 1) - 1) / (double(l + 1) * (l + 1) - double(m) * m));
      const double down = l > m ? std::sqrt((double(l) * l - double(m) * m) / (4.0 * l * l - 1)) : 0;
      const double next = up * (d[2] * now - down * before);
      before = now;
      now = next;
    }
    diagonal *= std::sqrt((2.0 * m + 3) / (2.0 * m + 2));
    const double turned = c * d[0] - s * d[1];
    s = c * d[1] + s * d[0];
    c = turned;
  }
  return y;
}

std::vector<Vec3> projectLight(int bands, const std::function<Vec3(const Vec3&)>& radiance) {
  constexpr int kRows = 512, kColumns = 2 * kRows;
  constexpr double kPi = std::numbers::pi;
  std::vector<std::array<double, 3>> sums(std::size_t(bands) * std::size_t(bands));
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double theta = (row + 0.5) * kPi / kRows, phi = (column + 0.5) * 2 * kPi / kColumns - kPi;
      const Vec3 from{float(std::sin(theta) * std::sin(phi)), float(std::cos(theta)),
                      float(-std::sin(theta) * std::cos(phi))};
      const Vec3 arriving = radiance(from);
      if (arriving == Vec3{}) continue;
      const double solidAngle =
          2 * kPi / kColumns * (std::cos(row * kPi / kRows) - std::cos((row + 1) * kPi / kRows));
      const std::vector<float> y = shBasis(bands, from);
      for (std::size_t i = 0; i < sums.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
          sums[i][channel] += solidAngle * y[i] * arriving[channel];
    }
  std::vector<Vec3> light;
  for (const auto& sum : sums) light.push_back({float(sum[0]), float(sum[1]), float(sum[2])});
  return light;
}
