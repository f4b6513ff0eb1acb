#include "libprt/meso/weave.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

void requireRange(const char* path, double value, double low, double high) {
  if (value >= low && value <= high) return;
  char text[96];
  std::snprintf(text, sizeof text, "use %g to %g", low, high);
  throw ValueError("is out of range", path, text);
}

void check(const WeaveOptions& o) {
  requireRange("patch.yarns", o.yarns, 2, 32);
  if (o.yarns % 2 != 0)
    throw ValueError("an odd number of yarns does not close up", "patch.yarns", "use an even number");
  requireRange("patch.radius", double(o.radius), 0.05, double(0.49f));
  requireRange("patch.depth", double(o.depth), 0.001, 2);
  requireRange("patch.amplitude", double(o.amplitude), 1, 4);
  requireRange("patch.sides", o.sides, 6, 128);
  requireRange("patch.along", o.along, 4, 128);
}

/// A against r below which crossing yarns cut each other.
double leastWave(double radius) {
  double least = 1;
  for (int i = 0; i < 1000; ++i) {
    const double t = i / 1000.0;
    least = std::max(least, std::sqrt(1 - t * t) / std::cos(kPi * radius * t));
  }
  return least;
}

/// One yarn along u at v = `place`; `sign` tells where it is up. Along v it is the same with u and v swapped.
void appendYarn(TriMesh& mesh, const WeaveOptions& o, const WeaveShape& shape, double place, double sign,
                bool alongV) {
  const auto first = std::uint32_t(mesh.vertexCount());
  const int rings = o.yarns * o.along;
  const double wave = 2 * kPi * o.yarns / 2, half = double(o.radius) / o.yarns;
  for (int i = 0; i <= rings; ++i) {
    const double s = double(i) / rings, height = sign * shape.wave * std::cos(wave * (s - 0.5 / o.yarns)),
                 slope = -sign * shape.wave * wave * std::sin(wave * (s - 0.5 / o.yarns));
    for (int k = 0; k < o.sides; ++k) {
      const double angle = 2 * kPi * k / o.sides, c = std::cos(angle), d = std::sin(angle);
      // Position (s, place + half c, height + tube d): the normal is the cross product of its derivatives.
      const DVec3 p(s, place + half * c, height + shape.tube * d);
      const DVec3 n = normalize(DVec3(-slope * half * d, shape.tube * c, half * d));
      mesh.positions.emplace_back(alongV ? DVec3(p.y, p.x, p.z) : p);
      mesh.normals.emplace_back(alongV ? DVec3(n.y, n.x, n.z) : n);
    }
  }
  const auto at = [&](int i, int k) { return first + std::uint32_t(i * o.sides + k % o.sides); };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < o.sides; ++k) {
      const std::uint32_t a = at(i, k), b = at(i + 1, k), c = at(i + 1, k + 1), d = at(i, k + 1);
      // Seen from outside, counter-clockwise; swapping u and v mirrors.
      if (alongV) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({a, d, c});
      }
    }
}

}  // namespace

WeaveShape weaveShape(const WeaveOptions& options) {
  const double ratio = leastWave(double(options.radius)) * double(options.amplitude);
  const double tube = double(options.depth) / 2 / (1 + ratio);
  return {tube, tube * ratio};
}

Patch weave(const WeaveOptions& options, Job* job) {
  check(options);
  const WeaveShape shape = weaveShape(options);
  TriMesh mesh;
  std::vector<Rgb> albedo;
  for (int j = 0; j < options.yarns; ++j) {
    const double place = (j + 0.5) / options.yarns, sign = j % 2 == 0 ? 1 : -1;
    appendYarn(mesh, options, shape, place, sign, false);
    albedo.resize(mesh.vertexCount(), options.weft);
    appendYarn(mesh, options, shape, place, -sign, true);
    albedo.resize(mesh.vertexCount(), options.warp);
  }
  Patch patch = makePatch(std::move(mesh), std::move(albedo), job);
  addBacking(patch, float(0.2 * shape.tube), 64, options.backing);
  return patch;
}

}  // namespace prt
