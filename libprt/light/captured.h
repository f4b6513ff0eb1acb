#pragma once
// Captured local radiance (Bi-Scale Radiance Transfer, section 5): what stands around a place, rendered into
// a small cube there, as light from all around:
//   L = rig + integral of coverage(d) * (radiance of the objects - radiance of the rig)(d) y(d) over the
//   sphere.
// Objects shine and reflect, and block the distant light behind them; where nothing stands the rig's light is
// what it was, bit by bit. Rendering is shade/surroundings.h's part.

#include "libprt/basis/sh.h"
#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/light/environment_mapping.h"
#include "libprt/light/light_rig.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace prt {

/// The texels of a cube of side x side x 6, laid out as a horizontal strip (environment_mapping.h), with
/// points over each of them. Shared by all pictures of that size.
class CubeGrid {
 public:
  static constexpr int kNodes = 4;  ///< points of a texel
  /// Throws ValueError unless `side` is 1 to 1024.
  explicit CubeGrid(int side);

  int side() const { return geometry_.height(); }
  const MapGeometry& geometry() const { return geometry_; }
  /// Direction of a face's middle, and up in its picture.
  struct Face {
    Vec3 axis, up;
  };
  Face face(int number) const;
  /// Quadrature over the texel at (x, y) of the strip; weights add up to its solid angle.
  std::span<const TexelNode> nodes(int x, int y) const {
    return std::span(nodes_).subspan(
        std::size_t(kNodes) * (std::size_t(y) * std::size_t(geometry_.width()) + std::size_t(x)), kNodes);
  }

 private:
  MapGeometry geometry_;
  std::vector<TexelNode> nodes_;
};

/// What was rendered.
struct CapturedCube {
  std::shared_ptr<const CubeGrid> grid;  ///< null: nothing
  Image image;                           ///< RGBA, premultiplied by alpha = coverage: 6 side x side
  std::array<bool, 6> seen{};            ///< faces that hold anything

  /// Nothing stands anywhere around.
  bool empty() const { return seen == std::array<bool, 6>{}; }
  /// How much of the light from unit direction `d` is blocked: 0 to 1, between the texels of a face.
  float coverage(const Vec3& d) const;
};

/// An environment as points of light, each with all the light of a small region of the map: so that what
/// covers a sun takes all of it away, and no more than that. Immutable.
class EnvironmentPoints {
 public:
  explicit EnvironmentPoints(const EnvironmentMap& map);
  EnvironmentPoints(const EnvironmentMap& map, Job& job);

  struct Point {
    Vec3 direction;  ///< unit, in the map's frame
    Rgb flux;        ///< radiance * solid angle
  };
  std::span<const Point> points() const { return points_; }

 private:
  std::vector<Point> points_;
};

/// What the objects in the cube add to projectLights(rig), and take from it, in `bands` bands. `environment`:
/// of the rig's map, null where it has none. Directional lights are dimmed by how much of their texel is
/// covered. Throws ValueError as projectLights() does.
ShRgb capturedDifference(const CapturedCube& cube, const LightRig& rig, const EnvironmentPoints* environment,
                         int bands);

}  // namespace prt
