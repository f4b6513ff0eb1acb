#pragma once
// The reflection of a material in the plane of incidence, as curves to draw.

#include "libprt/material/material.h"

#include <vector>

namespace prt::ui {

/// Light from `incidence` degrees beside the normal, on the side of negative angles; what leaves towards each
/// angle of the other half circle: luminance of the BRDF times the cosine of the angle of exitance.
struct Lobe {
  double incidence = 0;
  std::vector<double> angles;   ///< degrees from the normal, -90 .. 90; the mirror direction is +incidence
  std::vector<double> diffuse;  ///< of each
  std::vector<double> specular;
  double highest = 0;  ///< of the sum
  Rgb albedo{0};       ///< of light from there, all that is reflected
  double halfWidth =
      0;  ///< degrees from the mirror direction to where the Phong lobe is half as high; 0 without one
};

/// `incidence` in degrees, 0 .. 89.
Lobe lobeOf(const Material& material, double incidence);

}  // namespace prt::ui
