#include "libprt/mesh/tangent_frames.h"

#include "libprt/core/error.h"
#include "libprt/mesh/edges.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/repair.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace prt {
namespace {

TangentFrames framesOf(const TriMesh& mesh, const TangentOptions& options = {}) {
  Job job;
  return makeTangentFrames(mesh, options, job);
}

void expectFrames(const TriMesh& mesh, const TangentFrames& frames) {
  ASSERT_EQ(frames.tangents.size(), 3 * mesh.triangleCount());
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f)
    for (int i = 0; i < 3; ++i) {
      const Frame frame = frames.at(mesh, f, i);
      ASSERT_NEAR(length(frame.tangent), 1, 1e-5);
      ASSERT_NEAR(dot(frame.tangent, frame.normal), 0, 1e-5);
      ASSERT_LT(distance(cross(frame.tangent, frame.bitangent), frame.normal), 1e-5f) << "right-handed";
    }
}

/// Turn of v about axis n that brings it to w, all in one plane.
double turn(const Vec3& v, const Vec3& w, const Vec3& n) {
  return std::atan2(double(dot(cross(v, w), n)), double(dot(v, w)));
}

/// The least rotation from one unit normal to another, applied to v (Rodrigues).
Vec3 carried(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  const float s = length(axis), c = dot(from, to);
  if (s < 1e-7f) return v;
  const Vec3 k = axis / s;
  return v * c + cross(k, v) * s + k * dot(k, v) * (1 - c);
}

struct Continuity {
  int singular = 0;  ///< triangles around which the field turns
  int indexSum = 0;  ///< over all triangles
  double worst = 0;  ///< largest turn along an edge of triangles that are not singular, radians
  double mean = 0;
  double sharp = 0;  ///< fraction of triangles with an edge along which it turns by more than 60 degrees
};

/// Follows a field that has one tangent per vertex around every triangle (discrete Poincare-Hopf).
Continuity continuityOf(const TriMesh& mesh, const TangentFrames& frames) {
  Continuity result;
  std::size_t edges = 0;
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
    Vec3 n[3], t[3];
    for (int i = 0; i < 3; ++i)
      n[i] = mesh.normals[mesh.triangles[f][i]], t[i] = frames.tangents[3 * f + std::size_t(i)];
    double around = 0, largest = 0;
    Vec3 loop = t[0];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double angle = turn(carried(t[i], n[i], n[j]), t[j], n[j]);
      around += angle;
      largest = std::max(largest, std::abs(angle));
      result.mean += std::abs(angle);
      loop = carried(loop, n[i], n[j]);
    }
    around += turn(t[0], loop, n[0]);
    const int index = int(std::lround(around / (2 * kPi)));
    result.indexSum += index;
    result.singular += index != 0;
    result.sharp += largest > radians(60) ? 1.0 / double(mesh.triangleCount()) : 0.0;
    if (index == 0) result.worst = std::max(result.worst, largest);
    edges += 3;
  }
  result.mean /= double(edges);
  return result;
}

TriMesh withoutUvs(TriMesh mesh) {
  mesh.uv.clear();
  mesh.uvTriangles.clear();
  return mesh;
}

TEST(TangentFrames, AreFramesOnEveryShape) {
  for (const std::string& name : builtinMeshNames()) {
    const TriMesh mesh = makeBuiltinMesh(name);
    expectFrames(mesh, framesOf(mesh));
    expectFrames(mesh, framesOf(mesh, {.fromUvs = false, .sweeps = 2}));
  }
}

TEST(TangentFrames, FollowU) {
  for (const Vec3& t : framesOf(makePlane()).tangents) EXPECT_LT(distance(t, Vec3(1, 0, 0)), 1e-5f);
  // On surfaces of revolution u runs eastwards.
  for (const TriMesh& mesh : {makeTorus(), makeSphere(), makeVase()}) {
    const TangentFrames frames = framesOf(mesh);
    for (std::size_t f = 0; f < mesh.triangleCount(); ++f)
      for (int i = 0; i < 3; ++i) {
        const Vec3 p = mesh.positions[mesh.triangles[f][i]], east = normalize(cross(Vec3(0, 1, 0), p));
        if (length(Vec2(p.x, p.z)) < 1e-3f) continue;
        ASSERT_GT(dot(frames.tangents[3 * f + std::size_t(i)], east), 0.998f);
      }
  }
}

TEST(TangentFrames, AreContinuousInsideCharts) {
  for (const TriMesh& mesh : {makeTorus(), makeVase(), makeBox({.cells = 4})}) {
    const TangentFrames frames = framesOf(mesh);
    std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> atCorner;
    for (std::size_t c = 0; c < frames.tangents.size(); ++c) {
      const int i = int(c % 3);
      const auto [known, isNew] =
          atCorner.try_emplace({mesh.triangles[c / 3][i], mesh.uvTriangles[c / 3][i]}, frames.tangents[c]);
      ASSERT_EQ(known->second, frames.tangents[c])
          << "corners that share vertex and texture coordinate share the tangent";
    }
    EXPECT_LT(continuityOf(mesh, frames).worst, 1.6 * 2 * kPi / 64)
        << "not much more than one segment's turn at a pole";
  }
}

TEST(TangentFrames, MirroredChartsStayRightHanded) {
  TriMesh mesh = makePlane();
  for (Vec2& uv : mesh.uv) uv.y = -uv.y;
  const TangentFrames frames = framesOf(mesh);
  expectFrames(mesh, frames);
  for (const Vec3& t : frames.tangents) EXPECT_LT(distance(t, Vec3(1, 0, 0)), 1e-5f);
}

TEST(TangentFrames, UvsWithoutAreaFallBackToTheField) {
  TriMesh mesh = makePlane();
  for (Vec2& uv : mesh.uv) uv = Vec2(0.5f);
  const TangentFrames frames = framesOf(mesh);
  expectFrames(mesh, frames);
  EXPECT_LT(continuityOf(mesh, frames).worst, 1e-3);
}

TEST(TangentFrames, FieldsOnFlatPiecesAreConstant) {
  const TriMesh plane = withoutUvs(makePlane());
  for (const Vec3& t : framesOf(plane).tangents) EXPECT_LT(distance(t, Vec3(1, 0, 0)), 1e-5f);
  const TriMesh box = withoutUvs(makeBox({.cells = 3}));
  const TangentFrames frames = framesOf(box);
  for (std::size_t f = 0; f < box.triangleCount(); ++f) {
    const Vec3 n = box.normals[box.triangles[f].x];
    const Vec3 expected =
        std::abs(n.y) > 0.5f ? Vec3(1, 0, 0) : cross(Vec3(0, 1, 0), n);  // east, or +X when level
    for (int i = 0; i < 3; ++i) EXPECT_LT(distance(frames.tangents[3 * f + std::size_t(i)], expected), 1e-5f);
  }
}

TEST(TangentFrames, FieldsTurnOnlyWhereTheTopologyDemands) {
  const Continuity sphere = continuityOf(makeIcosphere(), framesOf(makeIcosphere()));
  EXPECT_EQ(sphere.indexSum, 2);
  EXPECT_EQ(sphere.singular, 2);
  const TriMesh ring = withoutUvs(makeTorus());
  const Continuity torus = continuityOf(ring, framesOf(ring));
  EXPECT_EQ(torus.indexSum, 0);
  EXPECT_LE(torus.singular, 4) << "two pairs, where the normal comes near the two special ones";
}

TEST(TangentFrames, FieldsAreSmoothOnRealShapes) {
  for (const char* name : {"bird", "vase", "rock"}) {
    const TriMesh mesh = withoutUvs(makeBuiltinMesh(name));
    const Continuity field = continuityOf(mesh, framesOf(mesh));
    EXPECT_EQ(field.indexSum, 2) << name;
    EXPECT_LT(field.singular, int(mesh.triangleCount() / 1000)) << name;
    EXPECT_LT(field.mean, 0.09) << name << ": radians per edge";
    EXPECT_LT(field.sharp, 0.03) << name;
  }
}

TEST(TangentFrames, SmoothingHelps) {
  const TriMesh rock = makeRock();
  const Continuity rough = continuityOf(rock, framesOf(rock, {.sweeps = 0})),
                   smooth = continuityOf(rock, framesOf(rock));
  EXPECT_LT(smooth.mean, 0.6 * rough.mean);
  EXPECT_LT(smooth.singular, rough.singular);
}

TEST(TangentFrames, FieldsOnScans) {
  PRT_NEEDS_SHARED_DATA();
  for (const char* file : {"meshes/bunny_3k.off", "meshes/armadillo.off", "meshes/spot.obj"}) {
    Job job;
    const TriMesh mesh = loadMesh(test::sharedData(file), {}, job);
    const TangentFrames frames = framesOf(mesh, {.fromUvs = false});
    expectFrames(mesh, frames);
    const Continuity field = continuityOf(mesh, frames);
    EXPECT_EQ(field.indexSum, 2) << file;
    EXPECT_LT(field.singular, int(mesh.triangleCount() / 300)) << file;
    EXPECT_LT(field.mean, 0.12) << file;
    EXPECT_LT(field.sharp, 0.02) << file;
  }
}

TEST(TangentFrames, AreTheSameEveryTimeAndCanBeCancelled) {
  const TriMesh rock = makeRock();
  EXPECT_EQ(framesOf(rock).tangents, framesOf(rock).tangents);
  Job job;
  job.cancel();
  EXPECT_THROW(makeTangentFrames(rock, {}, job), Cancelled);
}

}  // namespace
}  // namespace prt
