#include "libprt/atlas/atlas.h"
#include "libprt/atlas/geometry_image.h"
#include "libprt/atlas/orientation.h"
#include "libprt/atlas/pack_mask.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/repair.h"
#include "tests/atlas/shapes.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace prt {
namespace {

struct Packed {
  TriMesh mesh;
  FlatCharts charts;
  Atlas atlas;
};

Packed packed(TriMesh mesh, const PackOptions& options = {.size = 512}) {
  Job job;
  const Surface surface(mesh, job);
  FlatCharts charts = autoCut(surface, seamCosts(surface, {}, job), {}, job);
  AtlasOptions pack;
  pack.pack = options;
  Atlas atlas = packAtlas(charts, pack, job);
  return {std::move(mesh), std::move(charts), std::move(atlas)};
}

/// Zero flips, zero overlaps, every texel's point inside its triangle: what users are promised.
void expectSound(const Packed& p) {
  Job job;
  for (const UVec3& t : p.atlas.uvTriangles)
    ASSERT_GT(orientation(p.atlas.uv[t.x], p.atlas.uv[t.y], p.atlas.uv[t.z]), 0);
  for (const Vec2& uv : p.atlas.uv) ASSERT_TRUE(uv.x >= 0 && uv.y >= 0 && uv.x <= 1 && uv.y <= 1);
  EXPECT_TRUE(overlappingTexels(p.atlas, p.atlas.size, job).empty());
  const GeometryImage image = makeGeometryImage(p.atlas, p.atlas.size, -1, job);
  const BackProjection back = backProject(p.atlas, image, job);
  EXPECT_EQ(back.outsideTriangle, 0u);
  EXPECT_LT(back.inside, 1e-3);
  EXPECT_LT(back.border, 0.75);
  EXPECT_GT(image.filled(), 0.3);
}

TEST(PackMask, HoldsEveryCellNearTheOutline) {
  const std::vector<DVec2> triangle{{0.3, 0.2}, {9.7, 1.1}, {4.2, 7.9}};
  const PackMask mask = makeMask(triangle, 0.5);
  const auto taken = [&](const DVec2& p) {
    const DVec2 q = p + mask.origin;
    for (const PackMask::Run& run : mask.rows[std::size_t(q.y)])
      if (int(q.x) >= run.begin && int(q.x) < run.end) return true;
    return false;
  };
  for (int i = 0; i < 2000; ++i) {
    const double a = hashUniform(1, std::uint64_t(i), 0), b = hashUniform(1, std::uint64_t(i), 1) * (1 - a);
    const DVec2 inside = triangle[0] * (1 - a - b) + triangle[1] * a + triangle[2] * b;
    const double angle = 6.28 * hashUniform(1, std::uint64_t(i), 2);
    EXPECT_TRUE(taken(inside + 0.49 * DVec2(std::cos(angle), std::sin(angle))));
  }
}

RC_GTEST_PROP(PackGridProperty, FindsThePlaceThatTryingAllFinds, ()) {
  const int kSize = *rc::gen::element(70, 130, 256, 300);  // cross words
  PackGrid grid(kSize);
  std::set<std::pair<int, int>> taken;
  PackMask dot;
  dot.width = dot.height = 1;
  dot.rows = {{{0, 1}}};
  for (int i = 0; i < 120; ++i) {
    const int x = *rc::gen::inRange(0, kSize), y = *rc::gen::inRange(0, 14);
    grid.place(dot, x, y);
    taken.insert({x, y});
  }
  PackMask mask;
  mask.width = *rc::gen::inRange(1, 12);
  mask.height = *rc::gen::inRange(1, 5);
  for (int r = 0; r < mask.height; ++r) {
    const int begin = *rc::gen::inRange(0, mask.width), end = *rc::gen::inRange(begin + 1, mask.width + 1);
    mask.rows.push_back({{begin, end}});
  }
  if (*rc::gen::arbitrary<bool>()) prepareSearch(mask);
  int x = -1, y = -1, plainX = -1, plainY = -1;
  const bool found = grid.find(mask, kSize, x, y);
  for (int v = 0; v + mask.height <= kSize && plainY < 0; ++v)
    for (int u = 0; u + mask.width <= kSize && plainY < 0; ++u) {
      bool free = true;
      for (int r = 0; r < mask.height; ++r)
        for (int c = mask.rows[std::size_t(r)][0].begin; c < mask.rows[std::size_t(r)][0].end; ++c)
          free = free && !taken.contains({u + c, v + r});
      if (free) plainX = u, plainY = v;
    }
  RC_ASSERT(found == (plainY >= 0));
  RC_ASSERT(x == plainX && y == plainY);
  if (!found) return;
  // How snug it lies there: sides of cells that meet taken ones or the rim of the square.
  const auto isTaken = [&](int u, int v) {
    return u < 0 || v < 0 || u >= kSize || v >= kSize || taken.contains({u, v});
  };
  int sides = 0;
  for (int r = 0; r < mask.height; ++r)
    for (const PackMask::Run& run : mask.rows[std::size_t(r)]) {
      for (int c = run.begin; c < run.end; ++c)
        sides += isTaken(x + c, y + r - 1) + isTaken(x + c, y + r + 1);
      sides += isTaken(x + run.begin - 1, y + r) + isTaken(x + run.end, y + r);
    }
  RC_ASSERT(std::abs(grid.contact(mask, x, y) * 2 * (mask.width + mask.height) - sides) < 1e-9);
}

RC_GTEST_PROP(PackBitsProperty, KnowsWhatIsFree, ()) {
  constexpr int kSize = 150;
  PackBits bits(kSize);
  std::set<std::pair<int, int>> taken;
  const auto maskOf = [](int width, int height) {
    PackMask mask;
    mask.width = width, mask.height = height;
    mask.rows.assign(std::size_t(height), {{0, width}});
    return mask;
  };
  for (int i = 0; i < 12; ++i) {
    const int w = *rc::gen::inRange(1, 80), h = *rc::gen::inRange(1, 4);
    const int x = *rc::gen::inRange(0, kSize - w), y = *rc::gen::inRange(0, 20 - h);
    const bool set = i % 3 != 2;
    bits.set(maskOf(w, h), x, y, set);
    for (int v = y; v < y + h; ++v)
      for (int u = x; u < x + w; ++u) {
        if (set)
          taken.insert({u, v});
        else
          taken.erase({u, v});
      }
  }
  const int w = *rc::gen::inRange(1, 140), x = *rc::gen::inRange(0, kSize - w), y = *rc::gen::inRange(0, 20);
  bool free = true;
  for (int u = x; u < x + w; ++u) free = free && !taken.contains({u, y});
  RC_ASSERT(bits.isFree(maskOf(w, 1), x, y) == free);
}

double filledBy(const std::vector<PackChart>& charts, const std::vector<ChartPlacement>& places) {
  double filled = 0;
  for (std::size_t c = 0; c < charts.size(); ++c)
    filled += charts[c].flatArea * places[c].scale * places[c].scale;
  return filled;
}

TEST(PackCharts, SquaresFillTheSquareAndSmallOnesTheHolesOfRings) {
  Job job;
  const std::vector<PackChart> squares(16, PackChart{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, 1, 1});
  EXPECT_GT(filledBy(squares, packCharts(squares, {}, {.size = 1024}, job)), 0.93);
  // A C that nearly fills the square alone, and four bars for its hole.
  std::vector<PackChart> letter{
      {{{0, 0}, {9, 0}, {9, 2}, {2, 2}, {2, 7}, {9, 7}, {9, 9}, {0, 9}}, 46, 46, 1}};
  for (int i = 0; i < 4; ++i) letter.push_back({{{0, 0}, {6.5, 0}, {6.5, 1.1}, {0, 1.1}}, 7.15, 7.15, 1});
  EXPECT_GT(filledBy(letter, packCharts(letter, {}, {.size = 1024}, job)), 0.8);
}

TEST(PackCharts, FewTurnsAreTheOnlyOnes) {
  Job job;
  std::vector<PackChart> charts;
  for (int i = 0; i < 9; ++i) charts.push_back({{{0, 0}, {2.0 + i, 0}, {1, 1.0 + i}}, 1, 1, 1});
  const auto places = packCharts(charts, {}, {.size = 256, .turns = 4}, job);
  const auto again = packCharts(charts, {}, {.size = 256, .turns = 1}, job);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const double quarters = (places[c].angle - again[c].angle) / (kPi / 2);
    EXPECT_NEAR(quarters, std::round(quarters), 1e-9);
  }
}

TEST(PackCharts, ScalesByAreaAndWeight) {
  Job job;
  std::vector<PackChart> charts;
  for (int i = 0; i < 6; ++i) {
    const double s = 1 + i;
    charts.push_back({{{0, 0}, {s, 0}, {s, s}, {0, s}}, s * s, s * s, i == 2 ? 4.0 : 1.0});
  }
  const auto places = packCharts(charts, {}, {.size = 256}, job);
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(places[std::size_t(i)].scale / places[0].scale, i == 2 ? 2 : 1, 1e-9);
}

TEST(PackCharts, LockedChartsStayAndAreNotCovered) {
  Job job;
  const Packed free = packed(makeBox({.cells = 4}));
  ASSERT_GE(free.charts.charts.charts.size(), 1u);
  AtlasOptions options;
  options.pack.size = 512;
  options.locked.resize(free.charts.charts.charts.size());
  options.locked[0] = {.scale = 0.1, .angle = 0.3, .offset = DVec2(0.5, 0.5), .locked = true};
  const Atlas atlas = packAtlas(free.charts, options, job);
  EXPECT_EQ(atlas.placements[0].offset, DVec2(0.5, 0.5));
  EXPECT_EQ(atlas.placements[0].scale, 0.1);
  EXPECT_TRUE(overlappingTexels(atlas, 512, job).empty());
}

TEST(PackCharts, SaysWhenThereIsNoRoom) {
  Job job;
  std::vector<PackChart> charts(400, PackChart{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, 1, 1});
  EXPECT_THROW(packCharts(charts, {}, {.size = 16, .gutter = 2}, job), ResourceError);
  EXPECT_THROW(packCharts(charts, {}, {.size = 4}, job), ValueError);
}

TEST(Atlas, ChartsThatAreNotFlatAreNamed) {
  Job job;
  Packed p = packed(makeBuiltinMesh("vase", 1, 1));
  p.charts.uv[1].clear();
  try {
    packAtlas(p.charts, {}, job);
    FAIL() << "packed";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("chart 2"), std::string::npos) << error.what();
  }
}

TEST(Atlas, OfBuiltInShapesIsSound) {
  for (const char* name : {"bird", "vase", "torus", "box"}) {
    SCOPED_TRACE(name);
    expectSound(packed(makeBuiltinMesh(name, 1, 1)));
  }
}

TEST(Atlas, OfAnySizeAndGutterIsSound) {
  for (const PackOptions& options :
       {PackOptions{.size = 200, .gutter = 3}, PackOptions{.size = 1000, .gutter = 0}})
    expectSound(packed(makeVase({}), options));
}

TEST(Atlas, ChartsKeepTheGutterBetweenThem) {
  Job job;
  const Packed p = packed(makeVase({}), {.size = 512, .gutter = 2});
  const GeometryImage image = makeGeometryImage(p.atlas, 512, 0, job);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x + 4 < 512; ++x) {
      const std::uint32_t a = image.triangle[image.index(x, y)];
      if (a == kNowhere) continue;
      for (int d = 1; d <= 4; ++d) {
        const std::uint32_t b = image.triangle[image.index(x + d, y)];
        if (b != kNowhere) {
          ASSERT_EQ(p.atlas.chartOf[a], p.atlas.chartOf[b]) << x << " " << y;
        }
      }
    }
}

TEST(Atlas, IsTheSameWithAnyNumberOfThreads) {
  setThreadCount(1);
  const Packed one = packed(makeVase({}));
  setThreadCount(4);
  const Packed four = packed(makeVase({}));
  setThreadCount(0);
  EXPECT_EQ(one.atlas.uv, four.atlas.uv);
  EXPECT_EQ(one.atlas.uvTriangles, four.atlas.uvTriangles);
}

TEST(Atlas, ChartsLaidByHandOverEachOtherAreSeen) {
  Job job;
  Packed p = packed(makeBox({.cells = 4}));
  if (p.charts.charts.charts.size() < 2) GTEST_SKIP() << "one chart only";
  std::vector<ChartPlacement> places = p.atlas.placements;
  places[1].offset = places[0].offset;
  const Atlas over = placeAtlas(p.charts, places, {.size = 512}, job);
  EXPECT_FALSE(overlappingTexels(over, 512, job).empty());
}

TEST(GeometryImage, EveryTexelThatAChartTouchesHasAPoint) {
  Job job;
  const Packed p = packed(makeTorus({}), {.size = 256});
  const GeometryImage image = makeGeometryImage(p.atlas, 256, 0, job);
  // Many points of every triangle: their texels must be there, of the same chart.
  for (std::uint32_t t = 0; t < p.atlas.triangleCount(); ++t)
    for (int i = 0; i < 20; ++i) {
      const float a = hashUniform(5, t, std::uint32_t(2 * i)),
                  b = hashUniform(5, t, std::uint32_t(2 * i + 1)) * (1 - a);
      const UVec3& c = p.atlas.uvTriangles[t];
      const Vec2 uv = p.atlas.uv[c.x] * (1 - a - b) + p.atlas.uv[c.y] * a + p.atlas.uv[c.z] * b;
      const std::size_t texel = image.index(int(uv.x * 256), int((1 - uv.y) * 256));
      ASSERT_NE(image.kind[texel], TexelKind::Empty);
      ASSERT_EQ(p.atlas.chartOf[image.triangle[texel]], p.atlas.chartOf[t]);
    }
}

TEST(GeometryImage, TheGutterRepeatsTheRim) {
  Job job;
  const Packed p = packed(makeTorus({}), {.size = 256, .gutter = 2});
  const GeometryImage image = makeGeometryImage(p.atlas, 256, -1, job);
  std::size_t gutter = 0;
  for (int y = 1; y < 255; ++y)
    for (int x = 1; x < 255; ++x)
      if (image.kind[image.index(x, y)] == TexelKind::Gutter) ++gutter;
  EXPECT_GT(gutter, 100u);
  const GeometryImage bare = makeGeometryImage(p.atlas, 256, 0, job);
  for (std::size_t i = 0; i < bare.kind.size(); ++i)
    if (bare.kind[i] != TexelKind::Empty) {
      EXPECT_EQ(bare.triangle[i], image.triangle[i]);
    }
}

TEST(GeometryImage, PositionsLieOnTheSurfaceAndFramesAreOrthonormal) {
  Job job;
  const Packed p = packed(makeIcosphere({.subdivisions = 4}), {.size = 256});
  const GeometryImage image = makeGeometryImage(p.atlas, 256, -1, job);
  const TexelSurface surface = texelSurface(p.mesh, p.atlas, image, job);
  for (std::size_t i = 0; i < image.kind.size(); ++i) {
    if (image.kind[i] == TexelKind::Empty) continue;
    EXPECT_NEAR(glm::length(surface.position[i]), 1, 0.01);
    EXPECT_NEAR(glm::length(surface.normal[i]), 1, 1e-5);
    EXPECT_NEAR(glm::length(surface.tangent[i]), 1, 1e-5);
    EXPECT_NEAR(glm::dot(surface.normal[i], surface.tangent[i]), 0, 1e-5);
    EXPECT_GT(glm::dot(surface.normal[i], surface.position[i]), 0.99f);
  }
}

TEST(ImportAtlas, KeepsInjectiveCoordinates) {
  Job job;
  for (const TriMesh& mesh : {makeBox({.cells = 2}), makePlane({}), makeTorus({})}) {
    const ImportedAtlas imported = importAtlas(mesh, {.size = 512}, job);
    EXPECT_TRUE(imported.problems.empty())
        << toString(imported.problems[0].kind) << imported.problems[0].triangle;
    EXPECT_EQ(imported.atlas.uv.size(), mesh.uv.size());
  }
  EXPECT_EQ(importAtlas(makePlane({}), {.size = 512}, job).atlas.chartCount, 1u);
  EXPECT_THROW(importAtlas(makeIcosphere({}), {.size = 512}, job), ValueError);
}

TEST(ImportAtlas, TellsWhereCoordinatesOverlapFlipOrLeaveTheSquare) {
  Job job;
  const auto kinds = [&](const TriMesh& mesh) {
    std::set<UvProblem::Kind> found;
    for (const UvProblem& p : importAtlas(mesh, {.size = 128}, job).problems) found.insert(p.kind);
    return found;
  };
  TriMesh overlap = makePlane({.columns = 2, .rows = 2});
  for (Vec2& uv : overlap.uv) uv.x = std::abs(uv.x - 0.5f);  // folded down the middle
  EXPECT_EQ(kinds(overlap), (std::set{UvProblem::Kind::Flipped, UvProblem::Kind::Overlap}));
  TriMesh out = makePlane({.columns = 2, .rows = 2});
  for (Vec2& uv : out.uv) uv.x += 0.25f;
  EXPECT_EQ(kinds(out), std::set{UvProblem::Kind::Outside});
  TriMesh flat = makePlane({.columns = 2, .rows = 2});
  for (Vec2& uv : flat.uv) uv.y = 0.5f;
  EXPECT_EQ(kinds(flat), std::set{UvProblem::Kind::Missing});
}

TEST(ImportAtlas, AMirroredTextureIsTurnedAround) {
  Job job;
  TriMesh mesh = makePlane({.columns = 4, .rows = 4});
  for (Vec2& uv : mesh.uv) uv.x = 1 - uv.x;
  EXPECT_TRUE(importAtlas(mesh, {.size = 128}, job).problems.empty());
}

TEST(Atlas, OfRealMeshesIsSound) {
  PRT_NEEDS_SHARED_DATA();
  Job job;
  for (const char* file : {"meshes/spot.obj", "meshes/bunny_3k.off", "meshes/teapot.obj"}) {
    SCOPED_TRACE(file);
    expectSound(packed(loadMesh(test::sharedData(file), {}, job), {.size = 1024}));
  }
}

}  // namespace
}  // namespace prt
