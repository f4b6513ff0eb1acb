#pragma once
// Angles at the vertices of a surface, scaled so that a full turn is a full turn, and how directions are
// carried along edges (Knoeppel et al. 2013, section 5; Polthier and Schmies 1998). Internal to synthesis/.

#include "libprt/atlas/surface.h"

#include <complex>
#include <vector>

namespace prt {

using Complex = std::complex<double>;

struct VertexConnection {
  VertexConnection(const Surface& surface, Job& job);

  const Surface& surface;
  std::vector<float> cornerAngle;        ///< [3F] plain
  std::vector<float> scale;              ///< [W] scaled / plain angle
  std::vector<double> start;             ///< [3F] scaled angle at which a half-edge leaves its first vertex
  std::vector<double> back;              ///< [3F] scaled angle at its second vertex towards the first
  std::vector<double> weight;            ///< [E] cotangent weights, kept above a small positive number
  std::vector<double> mass;              ///< [W] a third of the area around
  std::vector<std::uint32_t> component;  ///< [W]
  std::uint32_t components = 0;

  /// What a half-edge adds to an angle that is carried from its first vertex to its second.
  double transport(std::uint32_t half) const { return back[half] + kPi - start[half]; }
  /// The direction of a scaled angle at a corner, unit, in the plane of the corner's triangle.
  DVec3 direction(std::uint32_t corner, double angle) const;
  /// Scaled angle of a vector near a corner's plane.
  double angleOf(std::uint32_t corner, const DVec3& vector) const;
  /// Curvature that scaling moved into a triangle: adds up to 2 pi times the Euler characteristic.
  double curvature(std::uint32_t triangle) const;
};

}  // namespace prt
