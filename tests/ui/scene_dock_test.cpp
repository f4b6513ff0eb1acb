// The scene dock, driven by mouse, keys and drops.

#include "ui/docks/scene_dock.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_writer.h"
#include "tests/ui/studio_fixture.h"
#include "ui/model/defect_view.h"
#include "ui/model/scene_editor.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/section.h"
#include "ui/widgets/vector_field.h"

#include <QCheckBox>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QToolButton>
#include <QTreeWidget>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::s;
using test::smallScene;
using test::waitFor;

class SceneDockTest : public test::StudioTest {
 protected:
  SceneDock& dock() { return *window.findChild<SceneDock*>(); }
  QTreeWidget& list() { return *dock().findChild<QTreeWidget*>(s("objectList")); }
  QTreeWidget& defects() { return *dock().findChild<QTreeWidget*>(s("defectLines")); }
  template <class Widget>
  Widget& child(const char* name) {
    return *dock().findChild<Widget*>(s(name));
  }
  const std::vector<ObjectRecipe>& objects() { return session.document().recipe().objects; }
  void click(QWidget& widget) { QTest::mouseClick(&widget, Qt::LeftButton); }
  void clickRow(QTreeWidget& tree, int row) {
    QTest::mouseClick(tree.viewport(), Qt::LeftButton, Qt::NoModifier,
                      tree.visualItemRect(tree.topLevelItem(row)).center());
  }

  void openTransform() {
    for (auto* section : dock().findChildren<Section*>())
      if (section->title() == s("Transform"))
        QTest::mouseClick(section->findChild<QToolButton*>(s("sectionHeader")), Qt::LeftButton);
    pass(20);
  }
  QString write(const char* name, const char* contents) {
    QFile file(folder.filePath(s(name)));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(contents);
    return file.fileName();
  }
  /// Two triangles of a pyramid with a hole, one of them doubled, and a vertex that nobody uses.
  QString brokenMesh() {
    return write("broken.obj",
                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 5 5\n"
                 "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 1 2 4\n");
  }
};

TEST_F(SceneDockTest, ABuiltInMeshIsAddedFromTheMenuAsOneStep) {
  openAndSettle();
  QMenu* menu = child<QToolButton>("addObject").menu();
  for (QAction* action : menu->actions())
    if (action->text() == s("box")) action->trigger();
  ASSERT_EQ(objects().size(), 2u);
  EXPECT_EQ(objects()[1].mesh.path, "builtin:box");
  EXPECT_EQ(undoName(), s("Add box"));
  EXPECT_EQ(session.selectedObject(), 1) << "the new one is selected";
  ASSERT_TRUE(settled());
  EXPECT_EQ(list().topLevelItemCount(), 2);
  EXPECT_EQ(list().topLevelItem(1)->text(1), s("24"));
  session.document().undo();
  EXPECT_EQ(objects().size(), 1u);
  EXPECT_EQ(session.selectedObject(), 0) << "what is gone is not selected";
}

TEST_F(SceneDockTest, DroppedMeshesAreAddedAndOthersAreNot) {
  openAndSettle();
  Job job;
  const QString rock = folder.filePath(s("a rock.ply"));
  writeMesh(rock.toStdString(), makeRock({.subdivisions = 3}), {}, job);
  drop(dock(), {rock, folder.filePath(s("scene.json"))});
  ASSERT_TRUE(waitFor([this] { return objects().size() == 2; }));
  EXPECT_EQ(objects()[1].name, "a rock");
  ASSERT_TRUE(settled());
  EXPECT_EQ(session.relighter().scene()->names.size(), 2u);
  drop(dock(), {folder.filePath(s("scene.json"))});
  pass(30);
  EXPECT_EQ(objects().size(), 2u);
}

TEST_F(SceneDockTest, ABadMeshIsToldHereAndNothingIsAdded) {
  openAndSettle();
  drop(dock(), {write("bad.obj", "v 0 0 0\nf 1 2 3\n")});
  auto& message = *dock().findChild<MessageBar*>();
  ASSERT_TRUE(waitFor([&] { return message.isVisible(); }));
  EXPECT_TRUE(message.text().contains(s("bad.obj")));
  EXPECT_EQ(objects().size(), 1u);
  EXPECT_FALSE(session.document().canUndo());
  EXPECT_TRUE(session.bakes().fresh()) << "the scene goes on as it was";
}

TEST_F(SceneDockTest, DuplicateAndRemove) {
  openAndSettle();
  EXPECT_FALSE(child<QToolButton>("removeObject").isEnabled()) << "one object is needed";
  click(child<QToolButton>("duplicateObject"));
  ASSERT_EQ(objects().size(), 2u);
  EXPECT_GT(objects()[1].transform.translate.x, 0.1f) << "beside the first";
  EXPECT_EQ(undoName(), s("Duplicate vase"));
  ASSERT_TRUE(settled());
  list().setFocus();
  QTest::keyClick(&list(), Qt::Key_Delete);
  ASSERT_EQ(objects().size(), 1u);
  EXPECT_EQ(undoName(), s("Remove vase 2"));
  EXPECT_EQ(session.selectedObject(), 0);
  QTest::keyClick(&list(), Qt::Key_Delete);
  EXPECT_EQ(objects().size(), 1u);
}

TEST_F(SceneDockTest, TheEyeHidesAnObjectFromBakeAndPicture) {
  openAndSettle();
  session.sceneEditor().add({s("builtin:box")});
  ASSERT_TRUE(waitFor([this] { return objects().size() == 2; }));
  ASSERT_TRUE(settled());
  pass(600);
  const QImage both = picture();
  const std::size_t triangles = session.relighter().scene()->mesh.triangleCount();
  const auto eyeOf = [this](int row) {
    const QRect cell = list().visualRect(list().model()->index(row, 3));
    EXPECT_LT(cell.right(), list().visualRect(list().model()->index(row, 0)).left()) << "left of the name";
    return cell.center();
  };
  QTest::mouseClick(list().viewport(), Qt::LeftButton, Qt::NoModifier, eyeOf(1));
  EXPECT_FALSE(objects()[1].visible);
  EXPECT_EQ(undoName(), s("Hide box"));
  ASSERT_TRUE(settled());
  EXPECT_LT(session.relighter().scene()->mesh.triangleCount(), triangles);
  pass(600);
  EXPECT_GT(difference(both, picture()), 0.005);

  // What is alone stays: by its eye, by the key, by removing.
  QTest::mouseClick(list().viewport(), Qt::LeftButton, Qt::NoModifier, eyeOf(0));
  EXPECT_TRUE(objects()[0].visible);
  EXPECT_TRUE(dock().findChild<MessageBar*>()->isVisible()) << "and says why";
  EXPECT_FALSE(child<QToolButton>("removeObject").isEnabled());
  list().setFocus();
  QTest::keyClick(&list(), Qt::Key_H);
  EXPECT_TRUE(objects()[0].visible);
  list().setCurrentItem(list().topLevelItem(1));
  EXPECT_TRUE(child<QToolButton>("removeObject").isEnabled());
  QTest::keyClick(&list(), Qt::Key_H);
  EXPECT_TRUE(objects()[1].visible);
  EXPECT_EQ(undoName(), s("Show box"));
  ASSERT_TRUE(settled());
  pass(600);
  EXPECT_LT(difference(both, picture()), 0.002) << "as it was";
  session.document().step(-2);
  EXPECT_TRUE(objects()[1].visible);
}

TEST_F(SceneDockTest, RenamingInTheList) {
  openAndSettle();
  list().setFocus();
  QTest::keyClick(&list(), Qt::Key_F2);
  auto* editor = list().findChild<QLineEdit*>();
  ASSERT_TRUE(editor);
  editor->selectAll();
  QTest::keyClicks(editor, s("amphora"));
  QTest::keyClick(editor, Qt::Key_Return);
  ASSERT_TRUE(waitFor([this] { return objects()[0].name == "amphora"; }, 2000));
  EXPECT_EQ(undoName(), s("Rename vase"));
  session.document().undo();
  EXPECT_EQ(list().topLevelItem(0)->text(0), s("vase"));
}

TEST_F(SceneDockTest, TheGroundSwitchAddsAndTakesAwayOneObject) {
  openAndSettle();
  auto& ground = child<QCheckBox>("groundPlane");
  QTest::mouseClick(&ground, Qt::LeftButton, Qt::NoModifier, QPoint(8, ground.height() / 2));
  ASSERT_EQ(objects().size(), 2u);
  EXPECT_TRUE(session.sceneEditor().hasGround());
  EXPECT_EQ(undoName(), s("Add ground plane"));
  ASSERT_TRUE(settled());
  const Box3 vase = session.sceneEditor().boundsOf(0), plane = session.sceneEditor().boundsOf(1);
  EXPECT_NEAR(plane.low.y, vase.low.y, 1e-5);
  EXPECT_GT(plane.diagonal(), 4 * vase.diagonal());
  QTest::mouseClick(&ground, Qt::LeftButton, Qt::NoModifier, QPoint(8, ground.height() / 2));
  EXPECT_EQ(objects().size(), 1u);
  session.document().undo();
  EXPECT_TRUE(ground.isChecked()) << "undo brings it back";
}

TEST_F(SceneDockTest, SectionsStayAsTheyWereLeft) {
  openAndSettle();
  session.sceneEditor().add({s("builtin:box")});
  ASSERT_TRUE(settled());
  const auto visible = [this] { return child<QPushButton>("restOnGround").isVisibleTo(&dock()); };
  EXPECT_FALSE(visible()) << "folded, so that the list has room";
  openTransform();
  EXPECT_TRUE(visible());
  session.selectObject(0);
  pass(20);
  EXPECT_TRUE(visible()) << "of another object, too";
}

TEST_F(SceneDockTest, ThePositionIsScrubbedAsOneStep) {
  openAndSettle();
  openTransform();
  auto* row = dock().findChild<PropertyRow*>(s("objects[0].transform.translate"));
  ASSERT_TRUE(row);
  NumberField& y = qobject_cast<VectorField*>(row->editor())->axis(1);
  const QPoint from = y.rect().center();
  QTest::mousePress(&y, Qt::LeftButton, Qt::NoModifier, from);
  for (const int by : {10, 20, 30}) {
    QMouseEvent move(QEvent::MouseMove, from + QPoint(by, 0), y.mapToGlobal(QPointF(from + QPoint(by, 0))),
                     Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&y, &move);
  }
  QTest::mouseRelease(&y, Qt::LeftButton, Qt::NoModifier, from + QPoint(30, 0));
  EXPECT_NEAR(objects()[0].transform.translate.y, 0.3f, 1e-5);
  EXPECT_EQ(objects()[0].transform.translate.x, 0);
  EXPECT_EQ(undoName(), s("Position of vase"));
  session.document().undo();
  EXPECT_FALSE(session.document().canUndo()) << "one drag, one step";
}

TEST_F(SceneDockTest, RestOnGroundAndCentre) {
  Recipe recipe = smallScene();
  recipe.objects[0].transform.translate = {2, 3, 1};
  recipe.objects[0].transform.rotate = {0, 0, 80};
  openAndSettle(recipe);
  openTransform();
  click(child<QPushButton>("restOnGround"));
  EXPECT_NEAR(session.sceneEditor().boundsOf(0).low.y, 0, 1e-5);
  click(child<QPushButton>("centreObject"));
  const Vec3 middle = session.sceneEditor().boundsOf(0).center();
  EXPECT_NEAR(middle.x, 0, 1e-5);
  EXPECT_NEAR(middle.z, 0, 1e-5);
  EXPECT_NEAR(session.sceneEditor().boundsOf(0).low.y, 0, 1e-5);
}

TEST_F(SceneDockTest, TheReportListsDefectsAndAClickShowsThem) {
  session.open(brokenMesh());
  ASSERT_TRUE(settled());
  QStringList lines;
  for (int i = 0; i < defects().topLevelItemCount(); ++i)
    lines << defects().topLevelItem(i)->text(0) + s(": ") + defects().topLevelItem(i)->text(1);
  EXPECT_TRUE(lines.contains(s("1 hole: left open"))) << lines.join(u'\n').toStdString();
  EXPECT_TRUE(lines.contains(s("1 duplicate face: dropped"))) << lines.join(u'\n').toStdString();
  EXPECT_TRUE(lines.contains(s("1 unreferenced vertex: removed"))) << lines.join(u'\n').toStdString();

  pass(600);  // until the edges are smooth
  const QImage before = picture();
  const Camera camera = session.view().camera();
  clickRow(defects(), int(lines.indexOf(s("1 hole: left open"))));
  ASSERT_TRUE(session.defects().shown());
  EXPECT_EQ(session.defects().shown()->kind, DefectKind::Holes);
  EXPECT_EQ(session.layers().marks().at(0).edges.size(), 6u) << "a loop of three edges";
  EXPECT_NE(session.view().camera(), camera) << "the view goes there";
  EXPECT_TRUE(child<QLabel>("defectMeaning").isVisible());
  session.view().setCamera(camera);
  pass(600);
  EXPECT_GT(difference(before, picture()), 0.002) << "and marks it";

  clickRow(defects(), int(lines.indexOf(s("1 hole: left open"))));
  EXPECT_FALSE(session.defects().shown()) << "a second click hides it";
  EXPECT_TRUE(session.layers().marks().empty());
  session.view().setCamera(camera);
  pass(600);
  EXPECT_LT(difference(before, picture()), 0.0005);
}

TEST_F(SceneDockTest, MarksFollowTheObjectAndGoWithIt) {
  session.open(brokenMesh());
  ASSERT_TRUE(settled());
  session.defects().show(0, DefectKind::UnreferencedVertices);
  ASSERT_EQ(session.layers().marks().at(0).points.size(), 1u);
  EXPECT_EQ(session.layers().marks().at(0).points[0], Vec3(5));
  session.document().set(s("objects[0].transform.translate"), s("[1,0,0]"));
  EXPECT_EQ(session.layers().marks().at(0).points[0], Vec3(6, 5, 5));
  session.project().setQuestion({});  // the edit may go
  session.open(s("builtin:box"));
  ASSERT_TRUE(waitFor([this] { return !session.opening(); }));
  EXPECT_TRUE(session.layers().marks().empty());
}

TEST_F(SceneDockTest, SteppingThroughElements) {
  session.open(write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 0 0\nv 4 0 0\nv 3 1 0\nf 1 2 3\nf 4 5 6\n"));
  ASSERT_TRUE(settled());
  clickRow(defects(), 0);
  EXPECT_EQ(session.layers().marks().at(0).edges.size(), 12u);
  EXPECT_EQ(child<QLabel>("defectPlace").text(), s("all 2"));
  click(child<QToolButton>("nextDefect"));
  EXPECT_EQ(session.layers().marks().at(0).edges.size(), 6u);
  EXPECT_EQ(child<QLabel>("defectPlace").text(), s("1 of 2"));
  click(child<QToolButton>("nextDefect"));
  click(child<QToolButton>("nextDefect"));
  EXPECT_EQ(child<QLabel>("defectPlace").text(), s("all 2"));
  click(child<QToolButton>("previousDefect"));
  EXPECT_EQ(child<QLabel>("defectPlace").text(), s("2 of 2"));
}

}  // namespace
}  // namespace prt::ui
