#pragma once
// Surface materials. A BRDF f never includes the cosine; eval() here returns f alone. Directions are in
// the local frame (z = shading normal) and point away from the surface. Reflection only: f = 0 below.

#include "libprt/core/math.h"

#include <string>

namespace prt {

enum class MaterialModel { Lambert, Phong };

/// What the recipe says about a surface. The diffuse part is albedo/pi; Phong adds
/// specular * (s+2)/(2 pi) * max(0, dot(mirror(out), in))^s with s = exponent, the cosine outside
/// (modified, normalised Phong: albedo <= specular, equal at normal incidence).
struct Material {
  std::string name = "default";
  MaterialModel model = MaterialModel::Lambert;
  Rgb albedo{0.5f};
  Rgb specular{0.0f};
  float exponent = 32;    ///< 1 .. 10 000
  bool twoSided = false;  ///< back faces reflect too; otherwise they only block light

  bool glossy() const { return model != MaterialModel::Lambert && luminance(specular) > 0; }
  bool operator==(const Material&) const = default;
};

}  // namespace prt
