#pragma once
// What tests of bakes share: baking in one line, exact transfer of wedges, error norms.

#include "libprt/basis/quadrature.h"
#include "libprt/basis/sh.h"
#include "libprt/basis/sh_product.h"
#include "libprt/transport/transfer_bake.h"
#include "tests/support/scenes.h"

#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace prt::test {

/// A scene ready for baking at its vertices.
struct BakeInput {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const RayScene> rays;
  std::shared_ptr<const SampleSet> samples;

  explicit BakeInput(Scene s) : BakeInput(std::make_shared<Scene>(std::move(s))) {}
  explicit BakeInput(std::shared_ptr<const Scene> s)
      : scene(s),
        rays(std::make_shared<RayScene>(*s)),
        samples(std::make_shared<SampleSet>(samplesAtVertices(*s))) {}
  explicit BakeInput(TriMesh mesh, Rgb albedo = Rgb(0.5f))
      : BakeInput(sceneOf(std::move(mesh), lambert(albedo))) {}

  /// Keeps some of the samples only, no longer as vertices.
  BakeInput only(std::span<const std::uint32_t> kept) const {
    BakeInput input = *this;
    input.samples = std::make_shared<SampleSet>(someSamples(*samples, kept));
    return input;
  }
  BakeInput only(std::uint32_t kept) const { return only({&kept, 1}); }

  Transfer transfer(const TransferSettings& settings) const {
    Job job;
    return bakeTransfer(scene, rays, samples, settings, job);
  }
  DirectTransfer direct(const DirectSettings& settings) const {
    Job job;
    DirectBake bake(scene, rays, samples, settings);
    while (!bake.done()) bake.advance(job);
    return bake.product(job);
  }
};

/// Light of radiance `value` from everywhere.
inline ShRgb constantLight(Rgb value, int bands = 5) {
  ShRgb light(bands);
  light.c[0] = value * float(std::sqrt(4 * kPi));
  return light;
}

/// One directional-looking light, all bands.
inline ShRgb lobeLight(const Vec3& direction, int bands = 5) {
  ShRgb light(bands);
  std::vector<float> y(std::size_t(shCount(bands)));
  shEvaluate(bands, normalize(direction), y);
  for (std::size_t k = 0; k < y.size(); ++k) light.c[k] = Rgb(y[k]) * Rgb(1.0f, 0.8f, 0.5f);
  light.c[0] += Rgb(1);
  return light;
}

/// Row `row` of a [S, width] f32 array.
inline std::span<const float> rowOf(const Array& array, std::size_t row) {
  const std::size_t width = array.size() / std::size_t(array.shape[0]);
  return array.as<float>().subspan(row * width, width);
}

inline double relativeError(std::span<const float> a, std::span<const double> b) {
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < b.size(); ++i) difference += (a[i] - b[i]) * (a[i] - b[i]), norm += b[i] * b[i];
  return std::sqrt(difference / norm);
}

/// Calls use(direction, weight) for a quadrature of the wedge of azimuths 0 to `opening` about `axis`,
/// counted from `start` (a unit vector across the axis): accurate to rounding for polynomials of low degree.
template <class Use>
void overWedge(const DVec3& axis, const DVec3& start, double opening, const Use& use) {
  const IntervalRule angles = gaussLegendre(40), turns = gaussLegendre(40);
  const DVec3 side = cross(axis, start);
  for (std::size_t i = 0; i < angles.nodes.size(); ++i)
    for (std::size_t j = 0; j < turns.nodes.size(); ++j) {
      const double theta = kPi / 2 * (angles.nodes[i] + 1), phi = opening / 2 * (turns.nodes[j] + 1);
      const double weight =
          angles.weights[i] * kPi / 2 * std::sin(theta) * turns.weights[j] * std::abs(opening) / 2;
      use(axis * std::cos(theta) + (start * std::cos(phi) + side * std::sin(phi)) * std::sin(theta), weight);
    }
}

/// Exact T_0 of a point in the edge of a wedge.
inline std::vector<double> wedgeTransfer(int bands, const DVec3& axis, const DVec3& start, double opening) {
  const auto n = std::size_t(shCount(bands));
  std::vector<double> matrix(n * n, 0), y(n);
  overWedge(axis, start, opening, [&](const DVec3& d, double weight) {
    shEvaluate(bands, d, y);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] += weight * y[i] * y[j];
  });
  return matrix;
}

/// Exact T_0 above a plane with this normal: H turned.
inline std::vector<double> planeTransfer(int bands, const Vec3& normal) {
  const Frame frame = frameFromNormal(normal);
  return wedgeTransfer(bands, DVec3(frame.tangent), DVec3(frame.bitangent), kPi);
}

/// T_0 of one sample from baked visibility.
inline std::vector<float> directMatrix(const DirectTransfer& direct, std::size_t sample) {
  const auto n = std::size_t(shCount(direct.settings.bands));
  std::vector<float> matrix(n * n);
  expandVisibility(direct.settings.bands, rowOf(direct.visibility, sample), matrix);
  return matrix;
}

/// Grades a unit grid coordinate so that steps grow from `small` at 0 to the far end at `large`.
inline float graded(float t, float small, float large) {
  return t <= 0 ? 0.0f : small * std::pow(large / small, t);
}

/// Two walls of an "infinite" dihedral with edge along z: the floor y = 0, x > 0, and a wall at `opening`
/// radians from it; vertices get denser towards the edge and towards z = 0.
inline TriMesh dihedral(double opening, int n = 24) {
  const auto bend = [](TriMesh mesh, double angle) {
    for (Vec3& p : mesh.positions) {
      const float r = graded(p.x, 0.05f, 2000), z = std::copysign(graded(std::abs(p.z), 0.05f, 2000), p.z);
      p = {r * float(std::cos(angle)), r * float(std::sin(angle)), z};
    }
    return mesh;
  };
  TriMesh mesh = bend(grid({0, 0, 1}, {1, 0, 0}, {0, 0, -2}, n, 2 * n), 0);
  TriMesh wall = bend(grid({0, 0, -1}, {1, 0, 0}, {0, 0, 2}, n, 2 * n), opening);
  for (Vec3& normal : mesh.normals) normal = {0, 1, 0};
  for (Vec3& normal : wall.normals) normal = {float(std::sin(opening)), -float(std::cos(opening)), 0};
  append(mesh, wall);
  return mesh;
}

/// Half a unit sphere open towards +Y, seen from inside: every point has the cosine fraction 1/2 of open sky.
inline TriMesh bowl(int rings, int segments) {
  return sphere(rings, segments, 1, Vec3(0), 0, true);
}

}  // namespace prt::test
