#include "ui/model/lobe.h"

#include "libprt/material/bsdf.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr double kStep = 1;  // degrees

Vec3 inPlane(double angle) {
  return {float(std::sin(radians(angle))), 0, float(std::cos(radians(angle)))};
}

}  // namespace

Lobe lobeOf(const Material& material, double incidence) {
  Lobe lobe;
  lobe.incidence = std::clamp(incidence, 0.0, 89.0);
  const Vec3 in = inPlane(-lobe.incidence);
  Material matte = material;
  matte.model = MaterialModel::Lambert;
  if (material.glossy()) lobe.halfWidth = degrees(std::acos(std::pow(0.5, 1 / double(material.exponent))));

  for (double angle = -90; angle <= 90; angle += kStep) lobe.angles.push_back(angle);
  // Narrow lobes fall between whole degrees: follow them about the mirror direction.
  if (material.glossy())
    for (int i = -40; i <= 40; ++i) {
      const double angle = lobe.incidence + 0.1 * i * lobe.halfWidth;
      if (std::abs(angle) < 90) lobe.angles.push_back(angle);
    }
  std::sort(lobe.angles.begin(), lobe.angles.end());
  for (const double angle : lobe.angles) {
    const Vec3 out = inPlane(angle);
    const double cosine = std::max(0.0, std::cos(radians(angle)));
    const double diffuse = double(luminance(evalBrdf(matte, in, out))) * cosine;
    const double all = double(luminance(evalBrdf(material, in, out))) * cosine;
    lobe.diffuse.push_back(diffuse);
    lobe.specular.push_back(std::max(0.0, all - diffuse));
    lobe.highest = std::max(lobe.highest, all);
  }
  lobe.albedo = directionalAlbedo(material, in);
  return lobe;
}

}  // namespace prt::ui
