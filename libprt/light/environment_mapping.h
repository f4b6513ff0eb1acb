#pragma once
// Where each pixel of an environment image lies on the sphere, for the mappings in common use.
//
// All pictures are seen from the inside, never mirrored: whoever looks along -Z (front) with +Y up has
// +X on the right. Pixel (x, y) covers [x, x+1] x [y, y+1], y down, and is one texel: a region of the
// sphere, with an exact solid angle, over which the map is constant.
//   LatLong          any size; the top row looks to +Y, the centre column to -Z, u grows towards +X
//   VerticalCross    3 x 4 cells: top +Y / left -X, front -Z, right +X / bottom -Y / back +Z turned by 180
//   degrees HorizontalCross  4 x 3 cells: top +Y over the second of left -X, front -Z, right +X, back +Z;
//   bottom -Y under it AngularMap       square; a disc with the front -Z at its centre, radius = angle / pi,
//   the back +Z its rim
//                    (Debevec's light probe images); outside the disc nothing
//   HorizontalStrip  6 x 1 cells: right +X, left -X, top +Y, bottom -Y, front -Z, back +Z, oriented as in the
//                    horizontal cross (these are the pictures of the OpenGL and Direct3D face order)
//   VerticalStrip    the same, 1 x 6

#include "libprt/core/math.h"

#include <span>
#include <string>
#include <vector>

namespace prt {

enum class EnvironmentMapping {
  LatLong,
  VerticalCross,
  HorizontalCross,
  AngularMap,
  HorizontalStrip,
  VerticalStrip
};

/// "latlong", "vcross", "hcross", "angular", "hstrip", "vstrip".
std::string toString(EnvironmentMapping mapping);
/// Throws ValueError when the name is not one of toString's.
EnvironmentMapping environmentMappingFromString(const std::string& name);
/// All of them, in the order above.
std::span<const EnvironmentMapping> environmentMappings();

/// Whether an image of this size can hold the mapping: cells square and of whole pixels, disc in a square.
bool fitsMapping(EnvironmentMapping mapping, int width, int height);

/// One point of a quadrature over a texel.
struct TexelNode {
  DVec3 direction;  ///< unit
  double weight;    ///< solid angle; the weights of a texel's nodes sum to its solid angle
};

/// The geometry of a mapping at one image size. Thread-safe, cheap to copy.
class MapGeometry {
 public:
  /// Throws ValueError when the size does not fit the mapping.
  MapGeometry(EnvironmentMapping mapping, int width, int height);

  EnvironmentMapping mapping() const { return mapping_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// True where pixel (x, y) holds light: false in the empty cells of a cross and outside the disc.
  bool covers(int x, int y) const;
  /// Image position, in pixels, of a unit direction; always inside the image.
  Vec2 toImage(const Vec3& direction) const;
  /// Unit direction of an image position inside a covered pixel. In an angular map positions outside
  /// the disc give the zero vector.
  DVec3 toDirection(double x, double y) const;
  /// Solid angle per pixel area at an image position: the Jacobian of toDirection. Zero outside the mapping.
  double density(double x, double y) const;
  /// Exact solid angle of a pixel's texel; those of all pixels sum to 4 pi. Zero where nothing is covered.
  double solidAngle(int x, int y) const;
  /// The point of a texel, in pixels, for (u, v) in [0, 1]^2: all over it, evenly but on the rim of an
  /// angular map, where columns are shortened to what lies inside the disc.
  glm::dvec2 pointInTexel(int x, int y, double u, double v) const;
  /// Density, per pixel area, of pointInTexel at an image position, for even (u, v). 1 away from rims.
  double pointDensity(double x, double y) const;
  /// Gauss-Legendre nodes over a texel, `order` per side (angular maps: over what lies inside the disc).
  std::vector<TexelNode> nodes(int x, int y, int order) const;
  /// A direction inside the texel: that of the pixel's centre, or, on the rim of an angular map, of the
  /// centre of what lies inside the disc.
  DVec3 center(int x, int y) const;
  /// Angle, in radians, that a texel spans at most along a pixel's side.
  double texelAngle() const;

 private:
  struct Face;
  struct Range {
    double low, high;
  };
  Range columns(int x, int y) const;
  Range rows(int y, double x) const;
  const Face* faceAt(double x, double y) const;
  std::span<const Face> faces() const;

  EnvironmentMapping mapping_;
  int width_, height_;
  int cell_ = 0;  // pixels per side of a cube face
};

}  // namespace prt
