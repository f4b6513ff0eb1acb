#pragma once
// Quadrature on the interval and the sphere: the rules that spherical harmonics make exact, and the
// weights of the pixel grids that light comes on.

#include "libprt/core/math.h"

#include <vector>

namespace prt {

/// Nodes and weights on an interval: integral of f = sum of weights[i] * f(nodes[i]).
struct IntervalRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

/// Directions and weights: integral of f over solid angle = sum of weights[i] * f(directions[i]).
struct SphereRule {
  std::vector<DVec3> directions;
  std::vector<double> weights;
};

/// Gauss-Legendre on [-1, 1], nodes ascending: exact for polynomials up to degree 2*count - 1.
/// Throws ValueError unless 1 <= count <= 10 000.
IntervalRule gaussLegendre(int count);

/// Gauss-Legendre in z times equal steps in azimuth. Exact for polynomials in (x, y, z) up to `degree`;
/// a product of two functions of n bands has degree 2n-2, which takes n * (2n-1) directions.
SphereRule sphereRule(int degree);

/// The same for integrals over the upper hemisphere z > 0 alone: equally exact there. When the degree is
/// even one further factor z (a cosine) is integrated exactly too.
SphereRule hemisphereRule(int degree);

/// Weights of the rows of a lat-long map, top row first, row j at polar angle (j + 1/2) pi / rows. They sum
/// to 2 (the integral of sin theta); multiply by the azimuth step 2 pi / columns.
/// fejerRowWeights: exact for band-limited functions sampled at the row centres (Fejer's first rule).
/// cellRowWeights: the solid angle of each cell: right for pixels that are area averages.
std::vector<double> fejerRowWeights(int rows);
std::vector<double> cellRowWeights(int rows);

/// Solid angle of the rectangle [u0, u1] x [v0, v1] on the plane z = 1, seen from the origin; a cube face
/// spans [-1, 1]^2.
double planeRectangleSolidAngle(double u0, double v0, double u1, double v1);

/// Solid angles of the size * size texels of one cube face, row by row; six faces make 4 pi.
std::vector<double> cubeFaceSolidAngles(int size);

}  // namespace prt
