#include "libprt/synthesis/id_map.h"

#include "libprt/synthesis/direct_mapping.h"
#include "tests/synthesis/shapes.h"

#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prt {
namespace {

using namespace test;

struct Mapped {
  Mapped(TriMesh m, std::size_t vertices, int size) : ready(std::move(m)) {
    Job& job = ready.job;
    meso = makeMesoMesh(ready.mesh, ready.sheets, {.vertices = vertices}, job);
    const FlatCharts charts = autoCut(ready.surface, seamCosts(ready.surface, {}, job), {}, job);
    atlas = packAtlas(charts, {{size, 1, 4}, {}, {}}, job);
    image = makeGeometryImage(atlas, size, -1, job);
    texels = texelSurface(ready.mesh, atlas, image, job);
  }
  Ready ready;
  MesoMesh meso;
  Atlas atlas;
  GeometryImage image;
  TexelSurface texels;

  std::vector<std::uint32_t> shoot(int k = 20) {
    return shootNormals(meso, ready.sheets, image, texels, {k}, ready.job);
  }
};

/// The rules of the header once more, by looking at every vertex.
std::uint32_t byBruteForce(const Mapped& m, SheetTest& test, std::size_t texel, std::size_t k) {
  const Vec3 &p = m.texels.position[texel], &n = m.texels.normal[texel];
  std::vector<std::pair<float, std::uint32_t>> order;
  for (std::uint32_t v = 0; v < m.meso.vertexCount(); ++v) {
    const Vec3 d = m.meso.positions[v] - p;
    order.emplace_back(dot(d, d), v);
  }
  std::sort(order.begin(), order.end());
  const auto leads = [&](std::uint32_t v) {
    return test.sameSheet(p, m.image.triangle[texel], m.meso.positions[v], m.meso.triangle[v]);
  };
  for (const std::size_t count : {k, std::size_t(64)}) {
    std::pair<float, std::uint32_t> best{1e30f, kNoVertex};
    for (std::size_t i = 0; i < std::min(count, order.size()); ++i) {
      const std::uint32_t v = order[i].second;
      const Vec3 d = m.meso.positions[v] - p;
      const float along = dot(d, n);
      if (std::abs(along) > 2 * float(m.meso.edge) || dot(n, m.meso.normals[v]) < 0.3f || !leads(v)) continue;
      const Vec3 off = d - along * n;
      best = std::min(best, {dot(off, off), v});
    }
    if (best.second != kNoVertex) return best.second;
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(64, order.size()); ++i)
    if (leads(order[i].second)) return order[i].second;
  return order[0].second;
}

void expectBruteForce(Mapped& m, const char* name) {
  const std::vector<std::uint32_t> shot = m.shoot();
  const std::vector<std::uint32_t> byTree =
      shootNormalsByTree(m.meso, m.ready.sheets, m.image, m.texels, {}, m.ready.job);
  SheetTest test(m.ready.sheets);
  std::size_t checked = 0, other = 0, otherByTree = 0;
  for (std::size_t i = 0; i < shot.size(); ++i) {
    ASSERT_EQ(shot[i] == kNoVertex, m.image.kind[i] == TexelKind::Empty);
    if (shot[i] == kNoVertex) continue;
    otherByTree += byTree[i] != shot[i];
    if (i % 7 != 0) continue;
    ++checked;
    other += shot[i] != byBruteForce(m, test, i, 20);
  }
  EXPECT_GT(checked, 500u) << name;
  EXPECT_EQ(other, 0u) << name;
  EXPECT_EQ(otherByTree, 0u) << name;
}

TEST(IdMap, EqualsBruteForce) {
  for (const char* name : {"bird", "torus", "vase", "box"}) {
    Mapped m(makeBuiltinMesh(name, name == std::string("box") ? 1 : 0.4f), 3000, 128);
    expectBruteForce(m, name);
  }
}

TEST(IdMap, NoTexelShowsTheFarSideOfThinSheets) {
  for (const bool joined : {false, true}) {
    const double area = joined ? 7 : 2;
    const float edge = float(std::sqrt(1.155 * area / 6000));
    Mapped m(twoSheets(0.5f * edge, joined), 6000, 256);
    const std::vector<std::uint32_t> shot = m.shoot();
    std::size_t wrong = 0, texels = 0;
    for (std::size_t i = 0; i < shot.size(); ++i) {
      if (shot[i] == kNoVertex) continue;
      const std::uint32_t from = m.image.triangle[i] / 2, to = m.meso.triangle[shot[i]] / 2;
      ++texels;
      wrong += (from == 0 && to == 1) || (from == 1 && to == 0);
    }
    EXPECT_GT(texels, 1000u);
    EXPECT_EQ(wrong, 0u) << joined;
  }
}

TEST(IdMap, NoTexelShowsTheFarSideOfAThinPlate) {
  // A closed plate half an edge thick: its sides face away from each other.
  const double area = 2 + 4 * 0.01;
  const float edge = float(std::sqrt(1.155 * area / 6000));
  Mapped m(makeBox({.size = {1, 0.5f * edge, 1}, .cells = 8}), 6000, 256);
  const std::vector<std::uint32_t> shot = m.shoot();
  std::size_t wrong = 0, texels = 0;
  for (std::size_t i = 0; i < shot.size(); ++i) {
    if (shot[i] == kNoVertex || std::abs(m.texels.normal[i].y) < 0.9f) continue;
    ++texels;
    wrong += m.texels.normal[i].y * m.meso.normals[shot[i]].y < 0.5f;
  }
  EXPECT_GT(texels, 1000u);
  EXPECT_EQ(wrong, 0u);
}

TEST(IdMap, TheVertexIsNear) {
  Mapped m(makeBuiltinMesh("bird", 0.4f), 5000, 256);
  const std::vector<std::uint32_t> shot = m.shoot();
  for (std::size_t i = 0; i < shot.size(); ++i)
    if (shot[i] != kNoVertex) {
      ASSERT_LT(double(distance(m.meso.positions[shot[i]], m.texels.position[i])), 1.6 * m.meso.edge);
    }
}

TEST(IdMap, IsTheSameForAnyNumberOfThreads) {
  Mapped m(makeBuiltinMesh("bird", 0.4f), 5000, 128);
  std::vector<std::vector<std::uint32_t>> made;
  for (const int threads : {1, 2, 3}) {
    const Threads set(threads);
    made.push_back(m.shoot());
  }
  EXPECT_EQ(made[0], made[1]);
  EXPECT_EQ(made[0], made[2]);
}

TEST(IdMap, HoldsCoordinatesToASixtyFiveThousandth) {
  const std::vector<Vec2> u{{0, 0.25f}, {0.5f, 0.999999f}, {1.0f / 3, 0.75f}};
  const std::vector<std::uint32_t> vertexOf{0, kNoVertex, 2, 1};
  const IdMap map = makeIdMap(2, vertexOf, u);
  EXPECT_EQ(map.size, 2);
  EXPECT_TRUE(map.empty(1));
  EXPECT_EQ(map.at(1), Vec2(-1));
  for (const std::size_t i : {0u, 2u, 3u}) {
    EXPECT_FALSE(map.empty(i));
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(map.at(i)[k], u[vertexOf[i]][k], 1.01 / 65535);
  }
}

TEST(IdMap, AFewVerticesServeToo) {
  Mapped m(makeBuiltinMesh("icosphere", 0.2f), 16, 32);
  const std::vector<std::uint32_t> shot = m.shoot();
  for (std::size_t i = 0; i < shot.size(); ++i)
    EXPECT_EQ(shot[i] == kNoVertex, m.image.kind[i] == TexelKind::Empty);
}

TEST(DirectMapping, LaysWholePatchesOverATorus) {
  const TriMesh mesh = makeTorus({.majorRadius = 1, .minorRadius = 0.25f});
  const PatchRepeat repeat = squareRepeat(mesh, 8);
  EXPECT_EQ(repeat.u, 8);
  EXPECT_EQ(repeat.v, 2);  // the tube is a quarter as long around
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const UVec3& w = mesh.uvTriangles[t];
    const Vec2 uv = (mesh.uv[w.x] + mesh.uv[w.y] + mesh.uv[w.z]) / 3.0f;
    const Vec2 at = directPatchCoordinates(mesh, repeat, t, {1.0f / 3, 1.0f / 3});
    for (int k = 0; k < 2; ++k) {
      EXPECT_TRUE(at[k] >= 0 && at[k] < 1);
      const double off = double(uv[k] * (k == 0 ? 8.0f : 2.0f) - at[k]);
      EXPECT_NEAR(off, std::round(off), 1e-4);
    }
  }
}

TEST(DirectMapping, NeedsTextureCoordinates) {
  EXPECT_THROW(squareRepeat(makeIcosphere(), 4), ValueError);
  EXPECT_THROW(squareRepeat(makeTorus(), 0), ValueError);
}

}  // namespace
}  // namespace prt
