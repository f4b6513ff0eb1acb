#include "libprt/mesh/half_edge.h"

#include "libprt/core/error.h"
#include "libprt/mesh/diagnose.h"
#include "libprt/mesh/generate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace prt {
namespace {

HalfEdgeMesh halfEdges(const TriMesh& mesh) {
  Job job;
  return HalfEdgeMesh(mesh, job);
}

TEST(HalfEdge, CountsMatchTheDiagnosis) {
  Job job;
  for (const char* name : {"vase", "torus", "box", "plane", "icosphere"}) {
    const TriMesh mesh = makeBuiltinMesh(name);
    const HalfEdgeMesh surface(mesh, job);
    const MeshReport report = diagnose(mesh, job);
    EXPECT_EQ(surface.vertexCount(), report.positions) << name;
    EXPECT_EQ(surface.edgeCount(), report.edges) << name;
    EXPECT_EQ(surface.triangleCount(), report.faces) << name;
    EXPECT_EQ(surface.boundaryLoops().size(), report.holes.count) << name;
  }
}

/// Brute force: each neighbour shares a triangle with the vertex; consecutive ones share one with it.
TEST(HalfEdge, OneRingsRunCounterClockwise) {
  const TriMesh mesh = makePlane({.columns = 4, .rows = 4});
  const HalfEdgeMesh surface = halfEdges(mesh);
  for (std::uint32_t v = 0; v < surface.vertexCount(); ++v) {
    const auto ring = surface.oneRing(v);
    const auto fan = surface.fan(v);
    ASSERT_EQ(ring.size(), fan.size() + (surface.isBoundary(v) ? 1 : 0));
    const Vec3 here = mesh.positions[surface.meshVertex(v)];
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const Vec3 a = mesh.positions[surface.meshVertex(ring[i])] - here;
      const Vec3 b = mesh.positions[surface.meshVertex(ring[(i + 1) % ring.size()])] - here;
      EXPECT_GT(cross(a, b).y, 0) << "vertex " << v;
      std::multiset<std::uint32_t> corners;
      for (int k = 0; k < 3; ++k) corners.insert(surface.vertexOf(fan[i], k));
      EXPECT_EQ(corners, (std::multiset<std::uint32_t>{v, ring[i], ring[(i + 1) % ring.size()]}));
    }
  }
}

TEST(HalfEdge, NeighboursAreMutual) {
  const TriMesh mesh = makeBox({.cells = 2});
  const HalfEdgeMesh surface = halfEdges(mesh);
  for (std::uint32_t f = 0; f < surface.triangleCount(); ++f)
    for (int side = 0; side < 3; ++side) {
      const std::uint32_t other = surface.neighbour(f, side);
      ASSERT_NE(other, HalfEdgeMesh::kNoNeighbour);
      bool back = false;
      for (int k = 0; k < 3; ++k)
        back = back || (surface.neighbour(other, k) == f &&
                        surface.vertexOf(other, k) == surface.vertexOf(f, (side + 1) % 3));
      EXPECT_TRUE(back);
    }
}

TEST(HalfEdge, BoundaryLoopsAreRims) {
  const TriMesh mesh = makePlane({.columns = 5, .rows = 3});
  const HalfEdgeMesh surface = halfEdges(mesh);
  const auto loops = surface.boundaryLoops();
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 16u);
  double area = 0;  // of the loop seen from above; the surface is on its right
  for (std::size_t i = 0; i < loops[0].size(); ++i) {
    const Vec3 a = mesh.positions[surface.meshVertex(loops[0][i])];
    const Vec3 b = mesh.positions[surface.meshVertex(loops[0][(i + 1) % 16])];
    area += 0.5 * (a.z * b.x - a.x * b.z);
    EXPECT_LT(length(b - a), 0.4f) << "neighbours";
  }
  EXPECT_NEAR(area, -1, 1e-5);
}

TEST(HalfEdge, ComponentsAreNumberedInOrder) {
  TriMesh mesh = makePlane({.columns = 1, .rows = 1});
  const TriMesh one = mesh;
  for (std::uint32_t copy = 1; copy < 3; ++copy) {
    for (const Vec3& p : one.positions) mesh.positions.push_back(p + Vec3(0, float(copy), 0));
    for (const UVec3& t : one.triangles) mesh.triangles.push_back(t + 4 * copy);
  }
  EXPECT_THAT(halfEdges(mesh).components(), testing::ElementsAre(0, 0, 1, 1, 2, 2));
}

TEST(HalfEdge, TakesSurfacesThatAreNoManifolds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> anywhere(-1, 1);
  for (int round = 0; round < 50; ++round) {
    TriMesh mesh;
    for (int i = 0; i < 10; ++i)
      mesh.positions.push_back({anywhere(random), anywhere(random), anywhere(random)});
    while (mesh.triangles.size() < 60) {
      const UVec3 t(random() % 10, random() % 10, random() % 10);
      if (t.x != t.y && t.y != t.z && t.z != t.x) mesh.triangles.push_back(t);
    }
    const HalfEdgeMesh surface = halfEdges(mesh);
    EXPECT_EQ(surface.triangleCount(), mesh.triangleCount());
    for (std::uint32_t f = 0; f < 60; ++f)
      for (int i = 0; i < 3; ++i) EXPECT_EQ(surface.meshVertex(surface.vertexOf(f, i)), mesh.triangles[f][i]);
  }
}

TEST(HalfEdge, RefusesTrianglesWithoutThreePositions) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_THROW(halfEdges(mesh), GeometryError);
}

}  // namespace
}  // namespace prt
