#include "libprt/synthesis/texture_synthesis.h"

#include "libprt/core/error.h"
#include "libprt/synthesis/orientation_field.h"
#include "tests/synthesis/shapes.h"
#include "tests/synthesis/tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace prt {
namespace {

using namespace test;

/// A surface with everything that synthesis asks for.
struct Stage {
  Stage(TriMesh m, const Rtt& rtt, std::size_t vertices, double width, int symmetry = 1, double angle = 0)
      : ready(std::move(m)), patchWidth(width), sym(symmetry) {
    Job& job = ready.job;
    meso = makeMesoMesh(ready.mesh, ready.sheets, {.vertices = vertices, .coarsest = 30}, job);
    const OrientationField field =
        makeOrientationField(ready.mesh, ready.surface, {.symmetry = symmetry, .angle = angle}, job);
    tangents = mesoTangents(meso, field.frames, job);
    exemplar =
        makeExemplar(rtt, {.turns = symmetry, .spacings = exemplarSpacings(meso, width, rtt.texels)}, job);
    finest = makeNeighbourhoods(meso, ready.sheets, tangents, symmetry, rtt.texels / width, meso.levels() - 1,
                                job);
  }
  std::vector<Vec2> make(SynthesisOptions options = {}) {
    options.patchWidth = patchWidth, options.symmetry = sym;
    return synthesise(meso, ready.sheets, tangents, exemplar, options, ready.job);
  }
  SynthesisQuality quality(std::span<const Vec2> coordinates,
                           std::span<const std::uint32_t> charts = {}) const {
    return measureSynthesis(meso, finest, exemplar, coordinates, charts);
  }
  Ready ready;
  double patchWidth;
  int sym;
  MesoMesh meso;
  std::vector<Vec3> tangents;
  Exemplar exemplar;
  Neighbourhoods finest;
};

/// A torus with the metric of the plane: a thin ring, many times longer around than its tube is wide.
TriMesh thinRing() {
  return makeTorus({.majorRadius = 1, .minorRadius = 0.05f, .segments = 200, .sides = 16});
}

float shortest(float d) {
  return d - std::round(d);
}

TEST(TextureSynthesis, OnAPlaneThePatchIsTiled) {
  // Coordinates go on from vertex to vertex, so that all are one shift of the position.
  Stage s(makePlane({.columns = 6, .rows = 6}), wavesTable(32), 8000, 0.25);
  const std::vector<Vec2> u = s.make();
  const Vec3& p0 = s.meso.positions[0];
  for (std::size_t i = 0; i < u.size(); ++i) {
    // The tangent is +X, the bitangent -Z.
    const Vec3 d = (s.meso.positions[i] - p0) / 0.25f;
    EXPECT_NEAR(shortest(u[i].x - u[0].x - d.x), 0, 0.02) << i;
    EXPECT_NEAR(shortest(u[i].y - u[0].y + d.z), 0, 0.02) << i;
  }
  const SynthesisQuality q = s.quality(u);
  EXPECT_GT(q.coherence, 0.999);
  EXPECT_NEAR(q.longestRepeat, 4, 0.3);  // the whole square
  EXPECT_LT(q.distance, 0.25);
}

TEST(TextureSynthesis, ATorusIsTiledPlainly) {
  // With widths of the patch that go into both ways around a whole number of times.
  const double width = 2 * kPi * 0.05;
  Stage s(thinRing(), wavesTable(32), 12000, width);
  const std::vector<Vec2> u = s.make();
  const SynthesisQuality q = s.quality(u);
  EXPECT_GT(q.coherence, 0.97);
  EXPECT_LT(q.distance, 0.3);
  // Nearly all of it is one region: 20 patches around the ring and one around the tube.
  EXPECT_GT(q.longestRepeat, 0.8 * std::sqrt(2 * kPi / width));
}

TEST(TextureSynthesis, CurvedSurfacesLookLikeThePatch) {
  for (const char* name : {"bird", "vase"}) {
    Stage s(makeBuiltinMesh(name, 0.5f), wavesTable(32), 20000, 0.12);
    const SynthesisQuality q = s.quality(s.make());
    EXPECT_LT(q.distance, 0.35) << name;
    EXPECT_GT(q.coherence, 0.85) << name;
  }
}

TEST(TextureSynthesis, CorrectionsMakeItBetter) {
  Stage s(makeBuiltinMesh("bird", 0.5f), wavesTable(32), 12000, 0.12);
  const double rough = s.quality(s.make({.jitter = 0.8, .passes = 0})).distance,
               fine = s.quality(s.make({.jitter = 0.8, .passes = 3})).distance;
  EXPECT_LT(fine, 0.6 * rough);
}

TEST(TextureSynthesis, JitterBreaksTheRepetition) {
  // Stripes look the same wherever they are entered along their length.
  Stage s(makePlane({.columns = 6, .rows = 6}), stripesTable(32), 8000, 0.2);
  const SynthesisQuality plain = s.quality(s.make()), thrown = s.quality(s.make({.jitter = 1}));
  EXPECT_LT(thrown.longestRepeat, plain.longestRepeat);
  EXPECT_LT(thrown.distance, 0.35);
}

TEST(TextureSynthesis, TurnedFramesFitASymmetricPatch) {
  // A cross field turns by quarters at its singularities; the board does not mind.
  Stage s(makeIcosphere({.subdivisions = 4}), boardTable(32), 16000, 0.5, 4);
  const SynthesisQuality q = s.quality(s.make());
  EXPECT_LT(q.distance, 0.4);
}

TEST(TextureSynthesis, SeamsBetweenChartsDoNotShow) {
  // Charts: any partition of the triangles, since synthesis knows of none.
  Stage s(makeBuiltinMesh("bird", 0.5f), wavesTable(32), 20000, 0.12);
  std::vector<std::uint32_t> charts;
  for (std::size_t t = 0; t < s.ready.mesh.triangleCount(); ++t) {
    const Vec3 p = s.ready.mesh.positions[s.ready.mesh.triangles[t].x];
    charts.push_back(std::uint32_t(p.x > 0) + 2 * std::uint32_t(p.y > 0.2f));
  }
  const SynthesisQuality q = s.quality(s.make(), charts);
  EXPECT_NEAR(q.across, q.inside, 0.35 * q.inside);
}

TEST(TextureSynthesis, IsTheSameForAnyNumberOfThreads) {
  std::vector<std::vector<Vec2>> made;
  for (const int threads : {1, 2, 3}) {
    const Threads set(threads);
    Stage s(makeBuiltinMesh("bird", 0.5f), wavesTable(24), 9000, 0.12);
    made.push_back(s.make({.jitter = 0.3, .seed = 7}));
  }
  EXPECT_EQ(made[0], made[1]);
  EXPECT_EQ(made[0], made[2]);
}

TEST(TextureSynthesis, SeedsDiffer) {
  Stage s(makePlane({.columns = 2, .rows = 2}), wavesTable(24), 3000, 0.3);
  EXPECT_NE(s.make({.seed = 1}), s.make({.seed = 2}));
}

TEST(TextureSynthesis, PreviewsComeCoarseFirst) {
  Stage s(makePlane({.columns = 2, .rows = 2}), wavesTable(24), 6000, 0.3);
  std::vector<std::size_t> counts;
  std::vector<Vec2> last;
  SynthesisOptions options;
  options.preview = [&](std::span<const Vec2> u, int level, int levels) {
    EXPECT_EQ(level, int(counts.size()) + 1);
    EXPECT_EQ(levels, s.meso.levels());
    counts.push_back(u.size());
    last.assign(u.begin(), u.end());
    for (const Vec2& x : u) ASSERT_TRUE(x.x >= 0 && x.x < 1 && x.y >= 0 && x.y < 1);
  };
  EXPECT_EQ(s.make(options), last);
  EXPECT_EQ(counts, s.meso.levelEnd);
}

TEST(TextureSynthesis, PaintedSpotsTakeTheirPartOfThePatch) {
  Stage s(makePlane({.columns = 4, .rows = 4}), wavesTable(32), 8000, 0.5);
  const PatchWish wish{{0.2f, 0, -0.1f}, 0.15f, {0.25f, 0.75f}, 0.08f};
  const std::vector<VertexWish> wishes = vertexWishes(s.meso, std::span(&wish, 1), s.ready.job);
  SynthesisOptions options;
  options.wishes = wishes;
  const std::vector<Vec2> u = s.make(options);
  int inside = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (distance(s.meso.positions[i], wish.centre) > 0.04f) continue;
    ++inside;
    EXPECT_LT(length(Vec2(shortest(u[i].x - 0.25f), shortest(u[i].y - 0.75f))), 0.2f);
  }
  EXPECT_GT(inside, 20);
}

/// The second exemplar of a stage, and what shows where.
struct Layered {
  std::vector<Exemplar> exemplars;
  std::vector<float> weights;

  Layered(const Stage& s, const Rtt& second, const std::function<float(const Vec3&)>& part) {
    Job job;
    exemplars = {s.exemplar, makeExemplar(second,
                                          {.turns = s.sym,
                                           .spacings = exemplarSpacings(s.meso, s.patchWidth, second.texels)},
                                          job)};
    for (const Vec3& p : s.meso.positions) weights.push_back(1 - part(p)), weights.push_back(part(p));
  }
  PatchExemplars all() const { return {exemplars, weights}; }
  std::vector<Vec2> make(const Stage& s) const {
    Job job;
    SynthesisOptions options;
    options.patchWidth = s.patchWidth, options.symmetry = s.sym, options.jitter = 0.4;
    return synthesise(s.meso, s.ready.sheets, s.tangents, all(), options, job);
  }
};

TEST(TextureSynthesis, LayersOfOnePatchAreThePatch) {
  Stage s(makeBuiltinMesh("bird", 0.5f), wavesTable(24), 6000, 0.15);
  const auto alone = s.make({.jitter = 0.4});
  EXPECT_EQ(Layered(s, wavesTable(24), [](const Vec3&) { return 0.0f; }).make(s), alone);
  EXPECT_EQ(Layered(s, wavesTable(24), [](const Vec3&) { return 1.0f; }).make(s), alone);
  EXPECT_EQ(Layered(s, stripesTable(24), [](const Vec3&) { return 0.0f; }).make(s), alone)
      << "what shows nothing changes nothing";
}

TEST(TextureSynthesis, EachPartLooksLikeItsOwnLayer) {
  Stage s(makeBuiltinMesh("bird", 0.5f), wavesTable(32), 20000, 0.12);
  const auto smooth = [](const Vec3& p) { return std::clamp(0.5f + 8 * p.x, 0.0f, 1.0f); };
  const Layered both(s, boardTable(32), smooth);
  const auto u = both.make(s);
  const SynthesisQuality q = measureSynthesis(s.meso, s.finest, both.all(), u, {});
  EXPECT_LT(q.distance, 0.4);
  // Where one patch shows alone, it looks as good as if it were everywhere.
  const auto whole = s.make({.jitter = 0.4});
  const auto distanceWhere = [&](const std::vector<Vec2>& coordinates) {
    std::vector<std::uint32_t> chart(s.ready.mesh.triangleCount(), 0);
    std::vector<float> only;
    for (const Vec3& p : s.meso.positions) only.push_back(smooth(p) == 0 ? 1.0f : 0.0f), only.push_back(0);
    std::vector<Exemplar> two{s.exemplar, s.exemplar};
    return measureSynthesis(s.meso, s.finest, {two, only}, coordinates, {}).distance;
  };
  EXPECT_LT(distanceWhere(u), 1.15 * distanceWhere(whole));
}

TEST(TextureSynthesis, RefusesLayersThatDoNotFit) {
  Stage s(makePlane({.columns = 2, .rows = 2}), wavesTable(24), 3000, 0.3);
  Layered wrong(s, wavesTable(16), [](const Vec3&) { return 0.5f; });
  EXPECT_THROW(wrong.make(s), ValueError);
  Layered few(s, wavesTable(24), [](const Vec3&) { return 0.5f; });
  few.weights.pop_back();
  EXPECT_THROW(few.make(s), ValueError);
}

TEST(TextureSynthesis, StopsWhenCancelledAndRefusesWhatDoesNotFit) {
  Stage s(makePlane({.columns = 2, .rows = 2}), wavesTable(24), 3000, 0.3);
  SynthesisOptions options;
  options.patchWidth = 0;
  EXPECT_THROW(synthesise(s.meso, s.ready.sheets, s.tangents, s.exemplar, options, s.ready.job), ValueError);
  options.patchWidth = 0.3, options.symmetry = 2;
  EXPECT_THROW(synthesise(s.meso, s.ready.sheets, s.tangents, s.exemplar, options, s.ready.job), ValueError);
  Job job;
  job.cancel();
  options.symmetry = 1;
  EXPECT_THROW(synthesise(s.meso, s.ready.sheets, s.tangents, s.exemplar, options, job), Cancelled);
}

TEST(TextureSynthesis, NeighboursSeeEachOtherTurnedRound) {
  Stage s(makeBuiltinMesh("bird", 0.5f), boardTable(16), 4000, 0.2, 4);
  const PointRings& rings = s.finest.rings;
  for (std::uint32_t p = 0; p < rings.count(); ++p)
    for (std::uint32_t slot = rings.start[p]; slot < rings.start[p + 1]; ++slot) {
      const std::uint32_t q = rings.list[slot];
      for (std::uint32_t back = rings.start[q]; back < rings.start[q + 1]; ++back) {
        if (rings.list[back] != p) continue;
        ASSERT_EQ((s.finest.turnOf(slot) + s.finest.turnOf(back)) % 4, 0);
        ASSERT_NEAR(length(s.finest.offset[slot]), length(s.finest.offset[back]), 1e-4f);
        if (s.finest.turnOf(slot) == 0) {
          ASSERT_LT(length(s.finest.offset[slot] + s.finest.offset[back]), 1e-3f);
        }
      }
    }
}

TEST(TextureSynthesis, IndependentSetsHoldNoNeighbours) {
  Stage s(makeBuiltinMesh("bird", 0.5f), wavesTable(16), 4000, 0.2);
  const auto sets = independentSets(s.finest.rings);
  std::vector<int> setOf(s.meso.vertexCount(), -1);
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (const std::uint32_t p : sets[i]) setOf[p] = int(i);
  EXPECT_LE(sets.size(), 12u);
  for (std::uint32_t p = 0; p < s.meso.vertexCount(); ++p) {
    ASSERT_GE(setOf[p], 0);
    for (const std::uint32_t q : s.finest.rings.of(p)) ASSERT_NE(setOf[p], setOf[q]);
  }
}

}  // namespace
}  // namespace prt
