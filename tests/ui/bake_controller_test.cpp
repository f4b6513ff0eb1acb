#include "ui/model/bake_controller.h"

#include "libprt/project/products.h"
#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"

#include <gtest/gtest.h>

#include <QElapsedTimer>

namespace prt::ui {
namespace {

using test::smallScene;
using test::waitFor;

struct Arrival {
  QString stage;
  int level, levels;
};

// A controller with its runner, and what it said.
struct Bench {
  JobRunner runner;
  BakeController bakes{runner};
  std::vector<Arrival> arrivals;
  QString failure;

  Bench() {
    QObject::connect(&bakes, &BakeController::productArrived,
                     [this](const QString& stage, const ProductState& state) {
                       arrivals.push_back({stage, state.level, state.levels});
                     });
    QObject::connect(&bakes, &BakeController::failed, [this](const QString& text) { failure = text; });
    bakes.setBaker(std::make_shared<Baker>(nullptr, "/"));
  }
  bool finish() {
    return waitFor([this] { return !bakes.baking(); });
  }
  int count(const char* stage) const {
    return int(std::count_if(arrivals.begin(), arrivals.end(),
                             [&](const Arrival& a) { return a.stage == QLatin1String(stage); }));
  }
  ProductStatus status(const char* stage) const {
    for (const StageInfo& info : bakes.stageInfos())
      if (info.name == QLatin1String(stage)) return info.status;
    return ProductStatus::Missing;
  }
};

TEST(BakeController, ARecipeBecomesProductsInTheirOrder) {
  Bench bench;
  bench.bakes.setRecipe(smallScene());
  EXPECT_TRUE(bench.bakes.baking());
  ASSERT_TRUE(bench.finish());
  EXPECT_TRUE(bench.bakes.fresh());
  ASSERT_FALSE(bench.arrivals.empty());
  EXPECT_EQ(bench.arrivals.front().stage, QLatin1String("mesh"));
  EXPECT_EQ(bench.failure, QString());
}

TEST(BakeController, PreviewsComeBeforeTheFinalProductAndGrow) {
  Bench bench;
  Recipe recipe = smallScene();
  recipe.objects[0].mesh.detail = 0.5f;
  recipe.transfer.rays = 2048;
  bench.bakes.setRecipe(recipe);
  ASSERT_TRUE(bench.finish());
  int last = 0, previews = 0;
  for (const Arrival& arrival : bench.arrivals) {
    if (arrival.stage != QLatin1String("transfer")) continue;
    if (arrival.level == arrival.levels) continue;  // the final one
    EXPECT_GT(arrival.level, last);
    last = arrival.level;
    ++previews;
  }
  EXPECT_GE(previews, 1);
  EXPECT_EQ(bench.status("transfer"), ProductStatus::Fresh);
}

TEST(BakeController, WhatOnlyRelightsBakesNothing) {
  Bench bench;
  Recipe recipe = smallScene();
  bench.bakes.setRecipe(recipe);
  ASSERT_TRUE(bench.finish());
  recipe.lights[0].rotation = 90;
  recipe.cameras.push_back({});
  recipe.objects[0].name = "renamed";
  bench.bakes.setRecipe(recipe);
  EXPECT_FALSE(bench.bakes.baking());
  EXPECT_TRUE(bench.bakes.fresh());
}

TEST(BakeController, AnAlbedoLeavesTheDirectProductFresh) {
  Bench bench;
  Recipe recipe = smallScene();
  bench.bakes.setRecipe(recipe);
  ASSERT_TRUE(bench.finish());
  recipe.objects[0].material.albedo = Rgb(0.1f);
  bench.bakes.setRecipe(recipe);
  EXPECT_EQ(bench.status("direct"), ProductStatus::Fresh);
  EXPECT_NE(bench.status("transfer"), ProductStatus::Fresh);
  ASSERT_TRUE(bench.finish());
  EXPECT_TRUE(bench.bakes.fresh());
}

TEST(BakeController, AGlossyMaterialNeedsAnotherForm) {
  Bench bench;
  Recipe recipe = smallScene();
  bench.bakes.setRecipe(recipe);
  ASSERT_TRUE(bench.finish());
  recipe.objects[0].material.model = MaterialModel::Phong;
  recipe.objects[0].material.specular = Rgb(0.4f);
  bench.bakes.setRecipe(recipe);
  EXPECT_TRUE(bench.bakes.baking());
  ASSERT_TRUE(bench.finish());
  EXPECT_TRUE(bench.bakes.fresh());
  recipe.objects[0].material.exponent = 500;
  bench.bakes.setRecipe(recipe);
  EXPECT_FALSE(bench.bakes.baking()) << "the exponent only relights";
}

TEST(BakeController, WithoutAutomaticBakingEditsOnlyMakeStale) {
  Bench bench;
  bench.bakes.setAutomatic(false);
  bench.bakes.setRecipe(smallScene());
  EXPECT_FALSE(bench.bakes.baking());
  bench.bakes.bake();
  ASSERT_TRUE(bench.finish());
  Recipe recipe = smallScene();
  recipe.transfer.bands = 4;
  bench.bakes.setRecipe(recipe);
  EXPECT_FALSE(bench.bakes.baking());
  EXPECT_EQ(bench.status("transfer"), ProductStatus::Stale);
  EXPECT_EQ(bench.status("mesh"), ProductStatus::Fresh);
  bench.bakes.setRecipe(smallScene());
  EXPECT_TRUE(bench.bakes.fresh()) << "back to what was baked";
}

TEST(BakeController, CancelAnswersAtOnceAndNothingArrivesAfterIt) {
  Bench bench;
  Recipe recipe = smallScene();
  recipe.objects[0].mesh.detail = 1;
  recipe.transfer.rays = 1 << 20;
  bench.bakes.setRecipe(recipe);
  ASSERT_TRUE(waitFor([&] { return bench.count("transfer") > 0; })) << "a first preview";
  const quint64 job = bench.bakes.job();
  QElapsedTimer timer;
  timer.start();
  bench.bakes.cancel();
  EXPECT_FALSE(bench.bakes.baking());
  ASSERT_TRUE(waitFor([&] { return bench.runner.find(job)->over(); }));
  RecordProperty("milliseconds", int(timer.elapsed()));
  EXPECT_LT(timer.elapsed(), 1000);  // 100 ms on an idle machine; tests share theirs
  const std::size_t before = bench.arrivals.size();
  test::pass(50);
  EXPECT_EQ(bench.arrivals.size(), before);
  EXPECT_FALSE(bench.bakes.fresh());
}

TEST(BakeController, ANewRecipeReplacesTheBakeThatRuns) {
  Bench bench;
  Recipe recipe = smallScene();
  recipe.transfer.rays = 1 << 20;
  bench.bakes.setRecipe(recipe);
  ASSERT_TRUE(waitFor([&] { return bench.count("transfer") > 0; }));
  recipe.transfer.rays = 64;
  bench.bakes.setRecipe(recipe);
  ASSERT_TRUE(bench.finish());
  EXPECT_TRUE(bench.bakes.fresh());
  EXPECT_EQ(bench.failure, QString());
}

TEST(BakeController, FailureIsToldWithWhatToDo) {
  Bench bench;
  Recipe recipe = smallScene();
  recipe.objects[0].mesh.path = "/nowhere/missing.obj";
  bench.bakes.setRecipe(recipe);
  ASSERT_TRUE(bench.finish());
  EXPECT_TRUE(bench.failure.contains(QLatin1String("missing.obj"))) << bench.failure.toStdString();
  EXPECT_EQ(bench.bakes.error(), bench.failure);
  EXPECT_FALSE(bench.bakes.fresh());
}

TEST(BakeController, DestructionInTheMidstOfABakeIsClean) {
  for (int i = 0; i < 3; ++i) {
    Bench bench;
    Recipe recipe = smallScene();
    recipe.transfer.rays = 1 << 20;
    bench.bakes.setRecipe(recipe);
    test::pass(30 * i);
  }
}

}  // namespace
}  // namespace prt::ui
