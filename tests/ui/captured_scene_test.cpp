// Objects around the model, in the studio: edited live, without a bake.

#include "tests/ui/studio_fixture.h"
#include "ui/docks/scene_dock.h"
#include "ui/model/scene_editor.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/section.h"

#include <QCheckBox>
#include <QToolButton>
#include <QTreeWidget>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::s;
using test::smallScene;
using test::waitFor;

Recipe withBall() {
  Recipe recipe = smallScene();
  ObjectRecipe& ball = recipe.objects.emplace_back();
  ball.name = "ball";
  ball.mesh.path = "builtin:sphere";
  ball.mesh.detail = 0.5f;
  ball.captured = true;
  ball.emission = Rgb(4, 1, 0.2f);
  ball.transform.translate = Vec3(0.6f, 0.4f, 0.2f);
  ball.transform.scale = Vec3(0.2f);
  return recipe;
}

class CapturedSceneTest : public test::StudioTest {
 protected:
  const ObjectRecipe& ball() { return session.document().recipe().objects.at(1); }
  void move(const Vec3& to) {
    Recipe next = session.document().recipe();
    next.objects[1].transform.translate = to;
    session.document().edit(s("Move ball"), next);
  }
  PropertyRow& row(const QString& path) {
    for (auto* each : window.findChild<SceneDock*>()->findChildren<PropertyRow*>())
      if (each->path() == path) return *each;
    throw std::runtime_error(path.toStdString());
  }
};

TEST_F(CapturedSceneTest, WhatMovesIsInTheNextFrameWithoutABake) {
  openAndSettle(withBall());
  const QImage before = picture();
  const ShRgb light = session.relighter().light();
  EXPECT_GT(light.evaluate(normalize(ball().transform.translate)).x,
            light.evaluate(normalize(-ball().transform.translate)).x + 0.1f)
      << "the ball lights the vase";
  const auto transfer = session.relighter().transfer();
  session.document().beginGesture(s("Move ball"));
  for (const float x : {0.5f, 0.2f, -0.6f}) {
    move(Vec3(x, 0.4f, 0.3f));
    EXPECT_TRUE(session.bakes().fresh()) << x;
    EXPECT_FALSE(session.bakes().baking()) << x;
  }
  session.document().endGesture();
  EXPECT_NE(session.relighter().light().c, light.c);
  EXPECT_NEAR(session.objectBounds(1).center().x, -0.6, 1e-3) << "its frame follows";
  const QImage after = picture();
  EXPECT_GT(difference(before, after), 0.01);
  EXPECT_EQ(session.relighter().transfer(), transfer);
  EXPECT_EQ(undoName(), s("Move ball"));
  session.document().undo();
  EXPECT_LT(difference(before, picture()), 0.001);
  EXPECT_EQ(session.relighter().light().c, light.c) << "one step, back where it was";
}

TEST_F(CapturedSceneTest, TheRowsOfTheSceneDock) {
  openAndSettle(withBall());
  session.selectObject(1);
  pass(50);
  for (auto* section : window.findChild<SceneDock*>()->findChildren<Section*>())
    if (section->title() == s("Surroundings"))
      QTest::mouseClick(section->findChild<QToolButton*>(s("sectionHeader")), Qt::LeftButton);
  pass(50);
  EXPECT_TRUE(row(s("objects[1].captured")).isVisible());
  EXPECT_TRUE(row(s("objects[1].emission")).isVisible());
  const QImage glowing = picture();
  row(s("objects[1].emission")).apply(s("0"));
  EXPECT_TRUE(session.bakes().fresh());
  EXPECT_GT(difference(glowing, picture()), 0.01);
  auto* list = window.findChild<QTreeWidget*>(s("objectList"));
  EXPECT_NE(list->topLevelItem(1)->text(2), s("0")) << "its triangles are counted";

  // Taken into the bake, and out again.
  row(s("objects[1].captured")).apply(s("false"));
  EXPECT_FALSE(session.bakes().fresh());
  EXPECT_FALSE(row(s("objects[1].emission")).isVisible());
  ASSERT_TRUE(settled());
  EXPECT_TRUE(session.relighter().surroundings().empty());
  session.document().undo();
  ASSERT_TRUE(settled());
  EXPECT_FALSE(session.relighter().surroundings().empty());

  // Something stays to be baked.
  session.selectObject(0);
  pass(50);
  row(s("objects[0].captured")).apply(s("true"));
  EXPECT_FALSE(session.document().recipe().objects[0].captured);
  EXPECT_FALSE(session.sceneEditor().canHide(0));
  EXPECT_FALSE(session.sceneEditor().canRemove(0));
  EXPECT_TRUE(session.sceneEditor().canHide(1));
}

TEST_F(CapturedSceneTest, AClickSelectsIt) {
  Recipe recipe = withBall();
  recipe.objects[1].transform.translate = Vec3(0, 0.35f, 0.6f);  // before the vase
  recipe.cameras = {{.eye = Vec3(0, 0.35f, 3), .target = Vec3(0, 0.35f, 0)}};
  openAndSettle(recipe);
  EXPECT_EQ(session.selectedObject(), 0);
  QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier, inView());
  EXPECT_EQ(session.selectedObject(), 1);
  move(Vec3(0, 0.35f, -3));
  QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier, inView());
  EXPECT_EQ(session.selectedObject(), 0) << "the vase is nearer";
}

}  // namespace
}  // namespace prt::ui
