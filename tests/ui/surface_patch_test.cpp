#include "ui/model/surface_patch.h"

#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"
#include "ui/model/session.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

namespace prt::ui {
namespace {

using test::waitFor;

/// A scene on a ground that carries no patch.
Recipe patchedScene() {
  Recipe recipe = test::smallScene();
  ObjectRecipe& ground = recipe.objects.emplace_back();
  ground.name = "ground", ground.mesh.path = "builtin:ground", ground.mesh.detail = 0.2f;
  ground.patch = false;
  recipe.patch.model = PatchModel::HeightField;
  recipe.patch.heightmap = "builtin:bins";
  recipe.patch.grid = 16;
  recipe.rtt.texels = 8, recipe.rtt.views = 2, recipe.rtt.rays = 64, recipe.rtt.supersamples = 1;
  recipe.synthesis.vertices = 2000, recipe.synthesis.scale = 0.2f;
  recipe.idmap.size = 128, recipe.atlas.size = 256;
  recipe.method.name = "biscale";
  return recipe;
}

class SurfacePatchTest : public testing::Test {
 protected:
  void openAndSettle(const Recipe& recipe) {
    QFile file(folder.filePath(QStringLiteral("scene.json")));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(recipeToJson(recipe).dump()));
    file.close();
    session.open(file.fileName());
    ASSERT_TRUE(waitFor([this] { return session.settled() && session.bakes().fresh(); }));
  }
  std::shared_ptr<const BiscaleSurface> shown() { return session.relighter().shownPatch(); }
  void set(const char* path, const char* value) {
    session.document().set(QLatin1String(path), QLatin1String(value));
  }

  QTemporaryDir folder;
  Session session;
};

TEST_F(SurfacePatchTest, FollowsWhatCarriesItAndTheMaterialsOfTheRest) {
  openAndSettle(patchedScene());
  ASSERT_TRUE(waitFor([&] { return bool(shown()); }));
  const auto before = shown();
  ASSERT_TRUE(before->plain);
  EXPECT_EQ(before->plain->responses().views().side(), 1);
  // A gloss: the bake knows nothing of it.
  set("objects[1].material.model", "phong");
  set("objects[1].material.specular", "0.5,0.1,0.1");
  ASSERT_TRUE(waitFor([&] { return shown() && shown()->plain->responses().views().side() > 1; }));
  EXPECT_EQ(shown()->responses, before->responses) << "nothing else is made anew";
  EXPECT_EQ(shown()->cover, before->cover);

  set("objects[1].patch", "true");
  ASSERT_TRUE(waitFor([&] { return shown() && !shown()->plain; }));
  set("objects[0].patch", "false");
  ASSERT_TRUE(waitFor([&] { return shown() && shown()->plain; }));
  EXPECT_EQ(shown()->plain->texels().front(), 0u);
  EXPECT_EQ(shown()->plain->texels().back(), PlainObjects::kPatched);
}

TEST_F(SurfacePatchTest, KeepsThePatchWhileMaterialsUnderItChange) {
  openAndSettle(patchedScene());
  ASSERT_TRUE(waitFor([&] { return bool(shown()) && session.jobs().idle(); }));
  const auto before = shown();
  set("objects[0].material.specular", "0.2,0.2,0.2");
  ASSERT_TRUE(waitFor([&] { return session.jobs().idle(); }));
  EXPECT_EQ(shown(), before);
}

}  // namespace
}  // namespace prt::ui
