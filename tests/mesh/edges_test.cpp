#include "libprt/mesh/edges.h"

#include "libprt/mesh/dense_index.h"
#include "libprt/mesh/duplicates.h"
#include "libprt/mesh/fans.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/weld.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <set>

namespace prt {
namespace {

using testing::ElementsAre;

TEST(MeshEdges, MatchAMapOfEdges) {
  std::mt19937 random(1);
  std::vector<UVec3> triangles;
  for (int i = 0; i < 400; ++i) triangles.push_back({random() % 40, random() % 40, random() % 40});
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> expected;
  for (std::uint32_t f = 0; f < triangles.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[f][i], b = triangles[f][(i + 1) % 3];
      if (a != b) expected[{std::min(a, b), std::max(a, b)}].push_back(3 * f + std::uint32_t(i));
    }
  Job job;
  const MeshEdges edges(triangles, job);
  ASSERT_EQ(edges.size(), expected.size());
  std::size_t e = 0;
  for (const auto& [key, sides] : expected) {
    EXPECT_EQ(edges.find(key.second, key.first), e);
    const MeshEdge edge = edges[e++];
    EXPECT_EQ(edge.a, key.first);
    EXPECT_EQ(edge.b, key.second);
    EXPECT_EQ(std::vector<std::uint32_t>(edge.sides.begin(), edge.sides.end()), sides);
  }
  EXPECT_EQ(edges.find(1000, 1001), edges.size());
}

TEST(UnionFind, NamesSetsByTheirSmallest) {
  UnionFind sets(6);
  sets.join(5, 3);
  sets.join(3, 4);
  sets.join(0, 1);
  EXPECT_EQ(sets.find(5), 3u);
  EXPECT_EQ(sets.find(4), 3u);
  EXPECT_EQ(sets.find(1), 0u);
  EXPECT_EQ(sets.find(2), 2u);
}

TEST(DenseIndex, NumbersKeysAsASetDoes) {
  std::mt19937 random(5);
  DenseIndex<2> index(3);
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> expected;
  for (int i = 0; i < 20000; ++i) {
    const std::array<std::uint32_t, 2> key{std::uint32_t(random() % 100), std::uint32_t(random() % 100)
                                                                              << 24};
    const auto [it, isNew] = expected.try_emplace(key, std::uint32_t(expected.size()));
    ASSERT_EQ(index.insert(key), it->second);
    ASSERT_EQ(index.key(it->second), key);
  }
  EXPECT_EQ(index.size(), expected.size());
}

TEST(Weld, FindsTheFirstAtEachPosition) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<DVec3> points{{0, 0, 0},   {1, 0, 0}, {-0.0, 0, -0.0},  {nan, 0, 0},
                                  {nan, 0, 0}, {1, 0, 0}, {1 + 1e-15, 0, 0}};
  Job job;
  EXPECT_THAT(weldByPosition(points, job), ElementsAre(0, 1, 0, 3, 4, 1, 6));
}

/// After splitting every edge has one triangle or two that run against each other, every vertex one fan.
void expectManifold(const std::vector<UVec3>& triangles, std::size_t vertices) {
  Job job;
  const FanSplit split = splitIntoFans(triangles, vertices, job);
  ASSERT_EQ(split.triangles.size(), triangles.size());
  std::vector<std::uint32_t> corner;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      corner.push_back(split.triangles[f][i]);
      EXPECT_EQ(split.source[split.triangles[f][i]], triangles[f][i]);
    }
  const MeshEdges edges(split.triangles, job);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    ASSERT_LE(edges[e].faceCount(), 2u);
    if (edges[e].faceCount() == 2) {
      ASSERT_NE(corner[edges[e].sides[0]], corner[edges[e].sides[1]]);
    }
  }
  UnionFind fans = cornerFans(
      edges, corner, nextInTriangle, [](const MeshEdge&) { return true; }, job);
  std::map<std::uint32_t, std::uint32_t> fanOf;
  for (std::uint32_t c = 0; c < corner.size(); ++c)
    ASSERT_EQ(fanOf.try_emplace(corner[c], fans.find(c)).first->second, fans.find(c));
}

TEST(SplitIntoFans, LeavesManifoldsAlone) {
  for (const char* name : {"torus", "plane", "bird"}) {
    const TriMesh mesh = makeBuiltinMesh(name);
    Job job;
    const FanSplit split = splitIntoFans(mesh.triangles, mesh.vertexCount(), job);
    EXPECT_EQ(split.triangles, mesh.triangles) << name;
    EXPECT_EQ(split.source.size(), mesh.vertexCount()) << name;
  }
}

TEST(SplitIntoFans, PartsAnythingIntoManifolds) {
  std::mt19937 random(11);
  for (int vertices : {4, 6, 12, 100}) {
    for (int round = 0; round < 40; ++round) {
      std::vector<UVec3> triangles;
      while (triangles.size() < 60) {
        const UVec3 t(random() % vertices, random() % vertices, random() % vertices);
        if (t.x != t.y && t.y != t.z && t.z != t.x) triangles.push_back(t);
      }
      expectManifold(triangles, std::size_t(vertices));
    }
  }
}

std::vector<bool> duplicates(const std::vector<UVec3>& triangles) {
  Job job;
  return duplicateTriangles(triangles, job);
}

TEST(DuplicateTriangles, KeepTheFirst) {
  const std::vector<UVec3> triangles{{0, 1, 2}, {2, 3, 4}, {1, 2, 0}, {2, 1, 0}, {5, 6, 7}};
  EXPECT_THAT(duplicates(triangles), ElementsAre(false, false, true, true, false));
}

TEST(DuplicateTriangles, FinsGoAltogether) {
  // A tetrahedron with a fin of two triangles back to back on edge 0-1.
  const std::vector<UVec3> solid{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  std::vector<UVec3> finned = solid;
  finned.push_back({0, 1, 4});
  finned.push_back({1, 0, 4});
  EXPECT_THAT(duplicates(finned), ElementsAre(false, false, false, false, true, true));
  finned.pop_back();
  EXPECT_THAT(duplicates(finned), testing::Each(false)) << "a single triangle is no fin";
}

TEST(DuplicateTriangles, WallsInsideASolidGoAltogether) {
  // Two tetrahedra on a shared face, each with its own copy of it.
  const std::vector<UVec3> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                     {0, 1, 2}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  EXPECT_THAT(duplicates(triangles), ElementsAre(true, false, false, false, true, false, false, false));
}

TEST(DuplicateTriangles, DoubledSheetsKeepOneSide) {
  const std::vector<UVec3> triangles{{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}};
  EXPECT_THAT(duplicates(triangles), ElementsAre(false, false, true, true));
}

}  // namespace
}  // namespace prt
