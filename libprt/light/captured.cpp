#include "libprt/light/captured.h"

#include "libprt/core/error.h"
#include "libprt/core/warp.h"
#include "libprt/light/resample.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace prt {
namespace {

constexpr int kPointRows = 128;  // of a map taken apart: 1.4 degrees each
constexpr double kPointAngle = 4 * kPi / (2 * kPointRows * kPointRows);  // mean solid angle of a point
constexpr int kLeastPoints = 64;                                         // of a circle, however small

/// Sums flux * y(direction), a few thousand directions at a time in float.
class PointSum {
 public:
  explicit PointSum(int bands) : bands_(bands), sum_(std::size_t(shCount(bands)), DVec3(0)) {}

  void add(const Vec3& direction, const Rgb& flux) {
    for (std::size_t i = 0; i < 3; ++i)
      direction_[i].push_back(direction[int(i)]), flux_[i].push_back(flux[int(i)]);
    if (direction_[0].size() == kBatch) flush();
  }
  ShRgb result() {
    flush();
    ShRgb out(bands_);
    for (std::size_t k = 0; k < sum_.size(); ++k) out.c[k] = Rgb(sum_[k]);
    return out;
  }

 private:
  static constexpr std::size_t kBatch = 2048;

  void flush() {
    const std::size_t count = direction_[0].size(), functions = sum_.size();
    std::vector<float> values(count * functions), part(3 * functions, 0.0f);
    shEvaluateBatch(bands_, direction_[0], direction_[1], direction_[2], values);
    for (std::size_t point = 0; point < count; ++point) {
      const float* y = values.data() + point * functions;
      for (std::size_t i = 0; i < 3; ++i) {
        const float flux = flux_[i][point];
        float* to = part.data() + i * functions;
        for (std::size_t k = 0; k < functions; ++k) to[k] += flux * y[k];
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < functions; ++k) sum_[k][int(i)] += double(part[i * functions + k]);
    for (std::size_t i = 0; i < 3; ++i) direction_[i].clear(), flux_[i].clear();
  }

  int bands_;
  std::array<std::vector<float>, 3> direction_, flux_;
  std::vector<DVec3> sum_;
};

/// Of a strip.
std::size_t faceTowards(const Vec3& d) {
  const Vec3 size = abs(d);
  if (size.x >= size.y && size.x >= size.z) return d.x > 0 ? 0 : 1;
  if (size.y >= size.z) return d.y > 0 ? 2 : 3;
  return d.z < 0 ? 4 : 5;
}

/// The objects' own light, and the constant light behind them.
void addTexels(const CapturedCube& cube, const Rgb& constant, PointSum& sum) {
  const int side = cube.grid->side();
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < 6 * side; ++x) {
      const float* texel = cube.image.pixel(x, y);
      if (!(texel[3] > 0)) continue;
      const Rgb more = Rgb(texel[0], texel[1], texel[2]) - texel[3] * constant;
      for (const TexelNode& node : cube.grid->nodes(x, y))
        sum.add(Vec3(node.direction), float(node.weight) * more);
    }
}

/// Takes away what is covered of a point of light.
void block(const CapturedCube& cube, const Vec3& direction, const Rgb& flux, PointSum& sum) {
  const float covered = cube.coverage(direction);
  if (covered > 0) sum.add(direction, -covered * flux);
}

/// Points spread evenly over the disc along a spiral (Vogel 1979).
void blockCircle(const CapturedCube& cube, const CircleLight& light, PointSum& sum) {
  const double angle = solidAngle(light);
  const int count = std::max(kLeastPoints, int(std::lround(angle / kPointAngle)));
  const float height = coneHeight(std::min(light.halfAngle, kPiF));
  const Frame frame = frameFromNormal(normalize(light.direction));
  const Rgb flux = float(angle / count) * light.radiance;
  constexpr double kGoldenTurn = 0.61803398874989485;
  for (int i = 0; i < count; ++i) {
    const double turns = i * kGoldenTurn;
    const Vec2 u(float(turns - std::floor(turns)), (float(i) + 0.5f) / float(count));
    block(cube, frame.toWorld(sampleUniformCone(u, height)), flux, sum);
  }
}

}  // namespace

CubeGrid::CubeGrid(int side)
    : geometry_(EnvironmentMapping::HorizontalStrip, 6 * std::clamp(side, 1, 1024),
                std::clamp(side, 1, 1024)) {
  if (side < 1 || side > 1024)
    throw ValueError("cube of " + std::to_string(side) + " texels a side", "captured light", "use 1 to 1024");
  for (int y = 0; y < geometry_.height(); ++y)
    for (int x = 0; x < geometry_.width(); ++x) {
      const std::vector<TexelNode> nodes = geometry_.nodes(x, y, 2);
      nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    }
}

CubeGrid::Face CubeGrid::face(int number) const {
  const double x = side() * (number + 0.5), y = 0.5 * side();
  const DVec3 axis = geometry_.toDirection(x, y), above = geometry_.toDirection(x, 0.25 * side());
  return {Vec3(glm::round(axis)), Vec3(glm::round(normalize(above - dot(above, axis) * axis)))};
}

float CapturedCube::coverage(const Vec3& d) const {
  if (!seen[faceTowards(d)]) return 0;  // most of them, mostly
  const int side = grid->side();
  const Vec2 place = grid->geometry().toImage(d);
  const int face = std::min(int(place.x) / side, 5);
  const float first = float(face * side), most = float(side - 1);
  const float x = std::clamp(place.x - first - 0.5f, 0.0f, most), y = std::clamp(place.y - 0.5f, 0.0f, most);
  const int left = std::min(int(x), std::max(side - 2, 0)), top = std::min(int(y), std::max(side - 2, 0));
  const int right = std::min(left + 1, side - 1), bottom = std::min(top + 1, side - 1);
  const auto at = [&](int column, int row) { return image.pixel(face * side + column, row)[3]; };
  const float u = x - float(left), v = y - float(top);
  return (1 - v) * ((1 - u) * at(left, top) + u * at(right, top)) +
         v * ((1 - u) * at(left, bottom) + u * at(right, bottom));
}

EnvironmentPoints::EnvironmentPoints(const EnvironmentMap& map) {
  Job job;
  *this = EnvironmentPoints(map, job);
}

EnvironmentPoints::EnvironmentPoints(const EnvironmentMap& map, Job& job) {
  toLatLong(map, 2 * kPointRows, kPointRows, job)
      .forEachTexel([&](int, int, const DVec3& direction, double angle, const Rgb& colour) {
        if (colour != Rgb(0)) points_.push_back({Vec3(direction), float(angle) * colour});
      });
}

ShRgb capturedDifference(const CapturedCube& cube, const LightRig& rig, const EnvironmentPoints* environment,
                         int bands) {
  validate(rig);
  PointSum sum(bands);
  if (cube.empty()) return sum.result();
  addTexels(cube, rig.constant, sum);
  if (rig.environment && environment) {
    const Mat3 toWorld = environmentRotation(rig.rotation);
    for (const EnvironmentPoints::Point& point : environment->points())
      block(cube, toWorld * point.direction, rig.intensity * point.flux, sum);
  }
  for (const CircleLight& light : rig.circles) blockCircle(cube, light, sum);
  for (const DirectionalLight& light : rig.directionals)
    block(cube, normalize(light.direction), light.irradiance, sum);
  return sum.result();
}

}  // namespace prt
