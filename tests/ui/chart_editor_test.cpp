// Charts by hand, without a window.

#include "ui/model/chart_editor.h"

#include "libprt/atlas/geometry_image.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/mesh_writer.h"
#include "libprt/mesh/repair.h"
#include "libprt/project/pipeline.h"
#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"
#include "ui/model/chart_picture.h"
#include "ui/model/session.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

namespace prt::ui {
namespace {

using test::waitFor;

class ChartEditorTest : public testing::Test {
 protected:
  void open(const char* mesh, ChartsMode mode = ChartsMode::Manual, float detail = 0.5f) {
    Recipe recipe = test::smallScene();
    recipe.objects[0].mesh.path = mesh;
    recipe.objects[0].mesh.detail = detail;
    recipe.transfer.rays = 64, recipe.transfer.bounces = 0;
    recipe.atlas.size = 256;
    recipe.charts.mode = mode;
    QFile file(folder.filePath(QStringLiteral("scene.json")));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(recipeToJson(recipe).dump()));
    file.close();
    session.open(file.fileName());
    ASSERT_TRUE(waitFor([this] { return session.settled() && session.bakes().fresh(); }));
    charts.setWatched(&session, true);
    settle();
  }
  void settle() {
    ASSERT_TRUE(waitFor([this] { return charts.ready() && charts.settled(); }));
  }
  void autoCut() {
    charts.autoCut();
    ASSERT_TRUE(waitFor([this] { return !charts.autoCutting(); }));
    settle();
    ASSERT_FALSE(charts.items().empty());
  }
  const Recipe& recipe() { return session.document().recipe(); }
  QString undoName() { return session.document().undoName(); }
  std::size_t seamsAround(std::uint32_t vertex) {
    const Surface& s = charts.on()->surface;
    std::size_t count = 0;
    for (std::uint32_t i = s.spokeStart[vertex]; i < s.spokeStart[vertex + 1]; ++i)
      count += charts.seams()[s.spokes[i]];
    return count;
  }
  /// Vertices with an edge between them, a few edges apart.
  std::uint32_t farFrom(std::uint32_t vertex, int steps) {
    const Surface& s = charts.on()->surface;
    std::uint32_t before = vertex, at = vertex;
    for (int i = 0; i < steps; ++i) {
      double most = -1;
      std::uint32_t next = at;
      for (std::uint32_t k = s.spokeStart[at]; k < s.spokeStart[at + 1]; ++k) {
        const std::uint32_t other = s.across(s.spokes[k], at);
        const double away = glm::distance(s.positions[other], s.positions[vertex]);
        if (other != before && away > most) most = away, next = other;
      }
      before = at, at = next;
    }
    return at;
  }

  QTemporaryDir folder;
  Session session;
  ChartEditor& charts = session.charts();
};

TEST_F(ChartEditorTest, ATorusIsNamedWithItsHandleAndMendedAsSuggested) {
  open("builtin:torus");
  ASSERT_EQ(charts.items().size(), 1u);
  EXPECT_TRUE(charts.items()[0].fault.contains(QStringLiteral("handle")))
      << charts.items()[0].fault.toStdString();
  EXPECT_EQ(charts.numbers().notDisks, 1);
  ASSERT_FALSE(charts.items()[0].suggestion.empty());
  EXPECT_FALSE(charts.atlas());
  charts.applySuggestion(0);
  EXPECT_EQ(undoName(), QStringLiteral("Cut as suggested"));
  settle();
  ASSERT_EQ(charts.items().size(), 1u);
  EXPECT_TRUE(charts.items()[0].fault.isEmpty());
  ASSERT_TRUE(charts.items()[0].map && charts.items()[0].map->final);
  ASSERT_TRUE(charts.items()[0].placement);
  ASSERT_TRUE(charts.atlas());
  Job job;
  EXPECT_TRUE(overlappingTexels(*charts.atlas(), 256, job).empty());
  EXPECT_GE(charts.numbers().l2, 1);
  EXPECT_GT(charts.numbers().filled, 0.2);
  session.document().undo();
  EXPECT_EQ(charts.seams().count(), 0u);
  EXPECT_EQ(charts.numbers().notDisks, 1);
}

TEST_F(ChartEditorTest, EachClickIsOneStepAndUndoTakesTheLastLegBack) {
  open("builtin:torus");
  const std::uint32_t a = 0, b = farFrom(a, 4), c = farFrom(b, 4);
  charts.click(a);
  EXPECT_FALSE(session.document().canUndo()) << "nothing is cut yet";
  const auto way = charts.preview(b);
  ASSERT_GE(way.size(), 2u);
  charts.click(b);
  EXPECT_EQ(undoName(), QStringLiteral("Cut"));
  EXPECT_EQ(charts.seams().count(), way.size() - 1);
  const std::size_t one = charts.seams().count();
  charts.click(c);
  EXPECT_GT(charts.seams().count(), one);
  session.document().undo();
  EXPECT_EQ(charts.seams().count(), one);
  ASSERT_TRUE(charts.path());
  EXPECT_EQ(charts.path()->last(), b) << "the path goes on from there";
  charts.takeBack();
  EXPECT_EQ(charts.seams().count(), 0u);
  EXPECT_EQ(charts.path()->last(), a);
}

TEST_F(ChartEditorTest, AClickOnTheFirstPointClosesTheLoopRoundTheOtherWay) {
  open("builtin:torus");
  const std::uint32_t a = 0, b = farFrom(a, 3);
  charts.click(a);
  charts.click(b);
  const std::size_t there = charts.seams().count();
  charts.click(a);
  EXPECT_GT(charts.seams().count(), there + 1) << "not back along the same edges";
  EXPECT_TRUE(charts.path()->empty());
  EXPECT_EQ(seamsAround(a), 2u);
  EXPECT_EQ(seamsAround(b), 2u);
}

TEST_F(ChartEditorTest, ErasingTakesTheCutUpToItsForks) {
  open("builtin:torus");
  charts.applySuggestion(0);
  const std::size_t all = charts.seams().count();
  const std::uint32_t edge = charts.seams().edges().front();
  charts.erase(edge, true);
  EXPECT_EQ(charts.seams().count(), all - 1);
  session.document().undo();
  charts.erase(edge, false);
  EXPECT_LT(charts.seams().count(), all - 1);
  EXPECT_EQ(undoName(), QStringLiteral("Erase cut"));
  charts.removeAllCuts();
  EXPECT_EQ(charts.seams().count(), 0u);
}

TEST_F(ChartEditorTest, AutoCutIsOneStepOfCutsByHand) {
  open("builtin:bird", ChartsMode::Auto);
  EXPECT_TRUE(charts.items().empty());
  autoCut();
  EXPECT_EQ(recipe().charts.mode, ChartsMode::Manual);
  EXPECT_FALSE(recipe().objects[0].seams.empty());
  EXPECT_EQ(undoName(), QStringLiteral("Cut automatically"));
  EXPECT_EQ(charts.numbers().notDisks, 0);
  ASSERT_TRUE(charts.atlas());
  session.document().undo();
  EXPECT_EQ(recipe().charts.mode, ChartsMode::Auto);
  EXPECT_TRUE(charts.items().empty());
}

TEST_F(ChartEditorTest, WhatIsSetForAChartOutlivesACutInAnother) {
  open("builtin:bird", ChartsMode::Auto);
  autoCut();
  ASSERT_GE(charts.items().size(), 2u);
  const std::uint32_t kept = charts.items().back().settings.face;
  charts.setWeight(int(charts.items().size()) - 1, 2.5);
  settle();
  const FlatMapPtr before = charts.items().back().map;
  // A cut inside of the first chart: from one end of its first triangle to a vertex a few edges away.
  const std::uint32_t a = charts.on()->surface.triangles[charts.items()[0].settings.face].x;
  charts.click(a);
  charts.click(farFrom(a, 3));
  settle();
  const int chart = charts.chartAt(kept);
  EXPECT_EQ(charts.items()[std::size_t(chart)].settings.weight, 2.5);
  EXPECT_EQ(charts.items()[std::size_t(chart)].map, before) << "nor is it laid flat anew";
}

TEST_F(ChartEditorTest, AMovedChartMovesAlone) {
  open("builtin:bird", ChartsMode::Auto);
  autoCut();
  ASSERT_GE(charts.items().size(), 2u);
  const auto before = charts.items();
  ChartPlacement to = *before[0].placement;
  to.offset += DVec2(0.01, 0.02);
  charts.beginMove(QStringLiteral("Move chart"));
  for (int step = 0; step < 3; ++step) {
    to.offset += DVec2(0.002);
    charts.setPlacement(0, to);
  }
  charts.endMove();
  EXPECT_EQ(undoName(), QStringLiteral("Move chart"));
  settle();
  EXPECT_NEAR(charts.items()[0].placement->offset.x, to.offset.x, 1e-6);
  for (std::size_t c = 1; c < before.size(); ++c)
    EXPECT_NEAR(glm::distance(charts.items()[c].placement->offset, before[c].placement->offset), 0, 1e-6);
  session.document().undo();
  settle();
  EXPECT_NEAR(glm::distance(charts.items()[0].placement->offset, before[0].placement->offset), 0, 1e-6);
}

TEST_F(ChartEditorTest, WhatIsBakedIsWhatIsShown) {
  open("builtin:bird", ChartsMode::Auto);
  autoCut();
  charts.setWeight(0, 1.5);
  charts.setCornerCount(1, 6);
  settle();
  ASSERT_TRUE(charts.atlas());
  Job job;
  const auto baked = Pipeline(nullptr, {}).run(recipe(), {"atlas"}, job).get<AtlasProduct>("atlas");
  EXPECT_EQ(baked->atlas->uv, charts.atlas()->uv);
  EXPECT_EQ(baked->atlas->uvTriangles, charts.atlas()->uvTriangles);
  EXPECT_NEAR(baked->facts.l2 / charts.numbers().l2, 1, 0.002) << "but for the grid of the coordinates";
}

TEST_F(ChartEditorTest, OverlapsAreShownAtOnceAndPackedAway) {
  open("builtin:bird", ChartsMode::Auto);
  autoCut();
  ASSERT_GE(charts.items().size(), 2u);
  // Small in the middle of the first one.
  ChartPlacement onto = *charts.items()[1].placement;
  onto.offset = charts.items()[0].placement->offset;
  onto.scale *= 0.3;
  charts.setPlacement(1, onto);
  EXPECT_TRUE(charts.items()[0].overlaps);
  EXPECT_TRUE(charts.items()[1].overlaps);
  // It is locked there, and packing goes round it.
  charts.setLocked(1, true);
  charts.packAll();
  EXPECT_EQ(undoName(), QStringLiteral("Pack charts"));
  settle();
  EXPECT_EQ(charts.numbers().overlaps, 0);
  EXPECT_NEAR(glm::distance(charts.items()[1].placement->offset, onto.offset), 0, 1e-6);
  EXPECT_FALSE(charts.items()[0].settings.place);
}

TEST_F(ChartEditorTest, CornersLayTheBoundaryOnAPolygon) {
  open("builtin:bird", ChartsMode::Auto);
  autoCut();
  charts.setCornerCount(0, 5);
  settle();
  EXPECT_EQ(charts.items()[0].map->corners.size(), 5u);
  std::vector<std::uint32_t> corners = charts.cornersOf(0);
  corners[1] += 1;
  charts.setCorners(0, corners, QStringLiteral("Move corner"));
  EXPECT_EQ(undoName(), QStringLiteral("Move corner"));
  EXPECT_TRUE(charts.items()[0].map) << "what stood there stays until the new one comes";
  settle();
  EXPECT_EQ(charts.items()[0].map->corners, corners);
  EXPECT_EQ(charts.cornersOf(0), corners);
}

TEST_F(ChartEditorTest, CuttingDoesNotDisturbTheBake) {
  open("builtin:torus");
  charts.applySuggestion(0);
  EXPECT_TRUE(session.bakes().fresh());
  EXPECT_FALSE(session.bakes().baking());
  settle();
  charts.setWeight(0, 2);
  EXPECT_TRUE(session.bakes().fresh());
}

TEST_F(ChartEditorTest, CoordinatesOfTheMeshAreChartsAndBecomeCutsByHand) {
  open("builtin:torus", ChartsMode::Imported);
  ASSERT_FALSE(charts.items().empty());
  EXPECT_TRUE(charts.problems().isEmpty());
  ASSERT_TRUE(charts.atlas());
  EXPECT_EQ(charts.atlas()->uv, charts.on()->scene->mesh.uv);
  EXPECT_FALSE(charts.movable());
  const std::size_t seams = charts.seams().count();
  EXPECT_GT(seams, 0u);
  charts.click(0);
  charts.click(farFrom(0, 3));
  EXPECT_EQ(recipe().charts.mode, ChartsMode::Manual);
  EXPECT_GE(charts.seams().count(), seams);
}

TEST_F(ChartEditorTest, OverlapsOfImportedCoordinatesAreTold) {
  TriMesh mesh = makePlane({.columns = 4, .rows = 4});
  for (Vec2& uv : mesh.uv) uv.x = std::abs(uv.x - 0.5f);
  Job job;
  const QString file = folder.filePath(QStringLiteral("folded.obj"));
  writeMesh(file.toStdString(), mesh, {}, job);
  open(file.toUtf8().constData(), ChartsMode::Imported, 1);
  EXPECT_FALSE(charts.problems().isEmpty());
  EXPECT_FALSE(charts.problemTriangles().empty());
  EXPECT_FALSE(charts.atlas()) << "it is not silently accepted";
}

TEST_F(ChartEditorTest, TheAtlasIsWrittenAsCoordinatesOfTheMesh) {
  open("builtin:bird", ChartsMode::Auto);
  autoCut();
  QString said;
  QObject::connect(&charts, &ChartEditor::told, [&](const QString& text, bool) { said = text; });
  for (const char* name : {"bird.obj", "bird.glb"}) {
    said.clear();
    const QString file = folder.filePath(QLatin1String(name));
    charts.exportCoordinates(file);
    ASSERT_TRUE(waitFor([&] { return !said.isEmpty(); }));
    Job job;
    const TriMesh back = loadMesh(file.toStdString(), {}, job);
    EXPECT_EQ(back.triangleCount(), charts.on()->scene->mesh.triangleCount());
    EXPECT_TRUE(importAtlas(back, {.size = 256}, job).problems.empty()) << name;
  }
}

TEST_F(ChartEditorTest, ACutOfAnotherMeshIsToldNotForgotten) {
  open("builtin:torus");
  Recipe other = recipe();
  other.objects[0].seams = "0 99999";
  session.document().edit(QStringLiteral("other"), other);
  EXPECT_TRUE(charts.error().contains(QStringLiteral("99999"))) << charts.error().toStdString();
  session.document().undo();
  EXPECT_TRUE(charts.error().isEmpty());
}

TEST_F(ChartEditorTest, PicturesShowEveryChartAndWhereTwoLie) {
  open("builtin:bird", ChartsMode::Auto);
  autoCut();
  const ChartWindow window{DVec2(0), 1.0 / 128, 128, 128};
  const auto count = [&](const ChartPixels& p) {
    return std::count(p.twice.begin(), p.twice.end(), std::uint8_t(1));
  };
  const ChartPixels packed = rasterCharts(charts.charts(), charts.items(), -1, window);
  EXPECT_EQ(count(packed), 0);
  std::set<int> seen;
  for (const std::uint32_t t : packed.triangle)
    if (t != kNowhere) seen.insert(charts.chartAt(t));
  EXPECT_EQ(seen.size(), charts.items().size());
  ChartPlacement onto = *charts.items()[0].placement;
  onto.offset = charts.items()[1].placement->offset;
  charts.setPlacement(0, onto);
  EXPECT_GT(count(rasterCharts(charts.charts(), charts.items(), -1, window)), 5);
}

}  // namespace
}  // namespace prt::ui
