#include "libprt/mesh/generate.h"

#include "libprt/mesh/generate_check.h"
#include "libprt/mesh/generate_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace prt {
namespace {

/// A count at `detail` times the usual resolution, within a shape's limits.
int scaled(int usual, float detail, int low, int high) {
  return std::clamp(int(std::lround(double(usual) * detail)), low, high);
}

/// The twelve corners of an icosahedron inside the unit sphere, two of them on the Y axis.
TriMesh icosahedron() {
  TriMesh mesh;
  mesh.positions.push_back({0, 1, 0});
  const double y = 1 / std::sqrt(5.0), r = 2 / std::sqrt(5.0);
  for (int ring = 0; ring < 2; ++ring)
    for (int i = 0; i < 5; ++i) {
      const double angle = 2 * kPi * (i + 0.5 * ring) / 5;
      mesh.positions.push_back(Vec3(r * std::sin(angle), ring == 0 ? y : -y, r * std::cos(angle)));
    }
  mesh.positions.push_back({0, -1, 0});
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::uint32_t j = (i + 1) % 5;
    mesh.triangles.push_back({0, 1 + i, 1 + j});
    mesh.triangles.push_back({1 + i, 6 + i, 1 + j});
    mesh.triangles.push_back({1 + j, 6 + i, 6 + j});
    mesh.triangles.push_back({6 + i, 11, 6 + j});
  }
  return mesh;
}

/// Cuts each triangle of a mesh of the unit sphere in four.
void bisect(TriMesh& mesh) {
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (std::uint64_t(std::min(a, b)) << 32) | std::max(a, b);
    const auto [it, isNew] = middles.try_emplace(key, std::uint32_t(mesh.positions.size()));
    if (isNew) mesh.positions.push_back(normalize(mesh.positions[a] + mesh.positions[b]));
    return it->second;
  };
  std::vector<UVec3> finer;
  finer.reserve(4 * mesh.triangleCount());
  for (const UVec3& t : mesh.triangles) {
    const std::uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
    finer.insert(finer.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

/// Where grading puts the fraction t of a side, both in -1..1: the slope is 1 - grading in the middle.
float graded(float t, float grading) {
  return t * (1 - grading + grading * t * t);
}

}  // namespace

TriMesh makeIcosphere(const IcosphereOptions& options) {
  requireLength("radius", options.radius);
  requireRange("subdivisions", options.subdivisions, 0, 9);
  TriMesh mesh = icosahedron();
  for (int i = 0; i < options.subdivisions; ++i) bisect(mesh);
  mesh.normals = mesh.positions;
  for (Vec3& p : mesh.positions) p *= options.radius;
  return mesh;
}

TriMesh makeSphere(const SphereOptions& options) {
  requireLength("radius", options.radius);
  requireRange("segments", options.segments, 3, 4096);
  requireRange("rings", options.rings, 2, 4096);
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= options.rings; ++i) {
    const double angle = kPi * i / options.rings;
    const bool pole = i == 0 || i == options.rings;
    const DVec2 out(pole ? 0.0 : std::sin(angle), -std::cos(angle));
    profile.push_back({double(options.radius) * out, out, double(i) / options.rings});
  }
  return revolve(profile, options.segments);
}

TriMesh makePlane(const PlaneOptions& options) {
  requireLength("width", options.width);
  requireLength("depth", options.depth);
  requireRange("columns", options.columns, 1, 4096);
  requireRange("rows", options.rows, 1, 4096);
  requireRange("grading", options.grading, 0.0f, 0.95f);
  TriMesh mesh;
  appendGrid(mesh, options.columns, options.rows, [&](float s, float t) {
    const float x = graded(s, options.grading), z = graded(-t, options.grading);
    const Vec2 uv(0.5f * (x + 1), 0.5f * (1 - z));
    return GridPoint{{0.5f * options.width * x, 0, 0.5f * options.depth * z}, {0, 1, 0}, uv};
  });
  return mesh;
}

TriMesh makeGround(float detail) {
  const int cells = scaled(64, detail, 2, 4096);
  return makePlane({.width = 12, .depth = 12, .columns = cells, .rows = cells, .grading = 0.8f});
}

TriMesh makeBox(const BoxOptions& options) {
  for (int axis = 0; axis < 3; ++axis) requireLength("size", options.size[axis]);
  requireRange("cells", options.cells, 1, 1024);
  // Right and up of each face as seen from outside, and its place in the unfolded cross (4 x 3 cells).
  struct Face {
    Vec3 right, up;
    int column, row;
  };
  static const Face faces[6] = {{{0, 0, 1}, {0, 1, 0}, 0, 1},  {{1, 0, 0}, {0, 1, 0}, 1, 1},
                                {{0, 0, -1}, {0, 1, 0}, 2, 1}, {{-1, 0, 0}, {0, 1, 0}, 3, 1},
                                {{1, 0, 0}, {0, 0, -1}, 1, 2}, {{1, 0, 0}, {0, 0, 1}, 1, 0}};
  TriMesh mesh;
  for (const Face& face : faces) {
    const Vec3 normal = cross(face.right, face.up);
    appendGrid(mesh, options.cells, options.cells, [&](float s, float t) {
      const Vec3 unit = normal + s * face.right + t * face.up;
      const Vec2 uv((face.column + 0.5f * (s + 1)) / 4, (face.row + 0.5f * (t + 1)) / 3);
      return GridPoint{0.5f * options.size * unit, normal, uv};
    });
  }
  return mesh;
}

TriMesh makeTorus(const TorusOptions& options) {
  requireLength("majorRadius", options.majorRadius);
  requireLength("minorRadius", options.minorRadius);
  requireRange("minorRadius", options.minorRadius, 0.0f, options.majorRadius);
  requireRange("segments", options.segments, 3, 4096);
  requireRange("sides", options.sides, 3, 4096);
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= options.sides; ++i) {
    const double angle = 2 * kPi * (i % options.sides) / options.sides;
    const DVec2 out(-std::cos(angle), -std::sin(angle));
    const DVec2 point = DVec2(options.majorRadius, 0) + double(options.minorRadius) * out;
    profile.push_back({point, out, double(i) / options.sides});
  }
  return revolve(profile, options.segments);
}

namespace {

/// Subdivisions whose edges are about 1 / detail as long.
int subdivided(int usual, float detail) {
  return std::clamp(usual + int(std::lround(std::log2(detail))), 0, 9);
}

using Maker = TriMesh (*)(float detail, std::uint32_t seed);

const std::pair<const char*, Maker> kBuiltins[] = {
    {"bird",
     [](float d, std::uint32_t) {
       const BirdOptions usual;
       return makeBird({.cellsAlong = scaled(usual.cellsAlong, d, 64, 400)});
     }},
    {"box",
     [](float d, std::uint32_t) { return makeBox({.cells = scaled(BoxOptions{}.cells, d, 1, 1024)}); }},
    {"ground", [](float d, std::uint32_t) { return makeGround(d); }},
    {"icosphere",
     [](float d, std::uint32_t) {
       return makeIcosphere({.subdivisions = subdivided(IcosphereOptions{}.subdivisions, d)});
     }},
    {"plane",
     [](float d, std::uint32_t) {
       const int cells = scaled(PlaneOptions{}.columns, d, 1, 4096);
       return makePlane({.columns = cells, .rows = cells});
     }},
    {"rock",
     [](float d, std::uint32_t seed) {
       return makeRock({.subdivisions = subdivided(RockOptions{}.subdivisions, d), .seed = seed});
     }},
    {"sphere",
     [](float d, std::uint32_t) {
       const SphereOptions usual;
       return makeSphere(
           {.segments = scaled(usual.segments, d, 3, 4096), .rings = scaled(usual.rings, d, 2, 4096)});
     }},
    {"torus",
     [](float d, std::uint32_t) {
       const TorusOptions usual;
       return makeTorus(
           {.segments = scaled(usual.segments, d, 3, 4096), .sides = scaled(usual.sides, d, 3, 4096)});
     }},
    {"vase",
     [](float d, std::uint32_t) {
       const VaseOptions usual;
       return makeVase(
           {.segments = scaled(usual.segments, d, 3, 4096), .rings = scaled(usual.rings, d, 24, 4096)});
     }},
};

}  // namespace

std::vector<std::string> builtinMeshNames() {
  std::vector<std::string> names;
  for (const auto& [name, make] : kBuiltins) names.push_back(name);
  return names;
}

TriMesh makeBuiltinMesh(const std::string& name, float detail, std::uint32_t seed) {
  if (!(detail >= 0.05f && detail <= 16)) throw ValueError("detail is out of range", name, "use 0.05 to 16");
  std::string choices;
  for (const auto& [known, make] : kBuiltins) {
    if (name == known) return make(detail, seed);
    choices += (choices.empty() ? "" : ", ") + std::string(known);
  }
  throw ValueError("no built-in shape is called '" + name + "'", "mesh", "choose from " + choices);
}

}  // namespace prt
