// Charts by mouse and keys: the knife on the model, the view of the atlas, the buttons.

#include "ui/docks/chart_dock.h"

#include "tests/ui/pointer.h"
#include "tests/ui/studio_fixture.h"
#include "ui/model/chart_editor.h"
#include "ui/viewport/cut_tool.h"
#include "ui/widgets/chart_view.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::Pointer;
using test::s;
using test::waitFor;

class ChartDockTest : public test::StudioTest {
 protected:
  void openShape(const char* mesh = "builtin:torus") {
    Recipe recipe = test::smallScene();
    recipe.objects[0].mesh.path = mesh;
    recipe.objects[0].mesh.detail = 0.5f;
    recipe.transfer.rays = 64, recipe.transfer.bounces = 0;
    recipe.atlas.size = 256;
    openAndSettle(recipe);
    ASSERT_TRUE(window.bringToFront(s("charts")));
    pass(50);
    settle();
  }
  void settle() {
    ASSERT_TRUE(waitFor([this] { return charts.ready() && charts.settled(); }));
    pass(80);
  }
  template <class T>
  T* find(const char* name) {
    return window.findChild<T*>(s(name));
  }
  void press(const char* button) {
    auto* found = find<QPushButton>(button);
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->isVisible()) << button;
    ASSERT_TRUE(found->isEnabled()) << button;
    QTest::mouseClick(found, Qt::LeftButton);
  }
  void autoCut() {
    press("chartAuto");
    ASSERT_TRUE(waitFor([this] { return !charts.autoCutting(); }));
    settle();
    ASSERT_GE(charts.items().size(), 1u);
  }
  ChartView& view() { return window.chartDock().view(); }
  ViewGeometry geometry() { return {session.view().camera(), window.viewport().size()}; }
  /// Places of the viewport in the middle of vertices that face the camera, in rising distance from its
  /// middle.
  std::vector<QPointF> placesOnModel() {
    const Surface& surface = charts.on()->surface;
    std::vector<QPointF> places;
    for (std::uint32_t v = 0; v < surface.vertexCount(); ++v) {
      const auto at = geometry().project(surface.positions[v]);
      if (!at || !window.viewport().rect().adjusted(40, 90, -40, -90).contains(at->toPoint())) continue;
      if (window.cutTool().vertexAt(*at, geometry()) == v) places.push_back(*at);
    }
    const QPointF middle = QRectF(window.viewport().rect()).center();
    std::sort(places.begin(), places.end(), [&](const QPointF& a, const QPointF& b) {
      return QLineF(a, middle).length() < QLineF(b, middle).length();
    });
    return places;
  }
  QPointF middleOf(int chart) {
    const ChartItem& item = charts.items()[std::size_t(chart)];
    const auto& triangles = charts.charts().charts[std::size_t(chart)].triangles;
    const UVec3& t = triangles[triangles.size() / 2];
    const DVec2 flat = (item.map->uv[t.x] + item.map->uv[t.y] + item.map->uv[t.z]) / 3.0;
    return view().toView((*item.placement)(flat));
  }

  ChartEditor& charts = session.charts();
};

TEST_F(ChartDockTest, WithoutChartsItSaysWhatToDo) {
  openShape();
  EXPECT_TRUE(charts.items().empty());
  EXPECT_FALSE(find<QLabel>("chartNumbers")->isVisible());
  EXPECT_FALSE(find<QPushButton>("chartPack")->isEnabled());
  EXPECT_TRUE(find<QPushButton>("chartAuto")->isEnabled());
}

TEST_F(ChartDockTest, ClicksOnTheModelCutUndoAndEscape) {
  openShape();
  window.viewport().setFocus();
  QTest::keyClick(&window, Qt::Key_K);
  ASSERT_TRUE(charts.cutting());
  EXPECT_TRUE(find<QPushButton>("chartCut")->isChecked());
  const std::vector<QPointF> places = placesOnModel();
  ASSERT_GT(places.size(), 30u);
  Pointer hand(&window.viewport());
  hand.click(places[0]);
  ASSERT_TRUE(charts.path() && !charts.path()->empty());
  EXPECT_EQ(charts.seams().count(), 0u);
  const QImage before = window.viewport().canvas().widget()->grab().toImage();
  hand.move(places[25]);
  pass(30);
  EXPECT_GT(difference(before, window.viewport().canvas().widget()->grab().toImage()), 0.0002)
      << "the way is shown before it is cut";
  hand.click(places[25]);
  EXPECT_GT(charts.seams().count(), 0u);
  EXPECT_EQ(undoName(), s("Cut"));
  EXPECT_EQ(session.document().recipe().charts.mode, ChartsMode::Manual);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(charts.seams().count(), 0u);
  QTest::keyClick(&window.viewport(), Qt::Key_Escape);
  EXPECT_TRUE(charts.cutting()) << "first the path ends";
  EXPECT_TRUE(charts.path()->empty());
  QTest::keyClick(&window.viewport(), Qt::Key_Escape);
  EXPECT_FALSE(charts.cutting());
}

TEST_F(ChartDockTest, CtrlErasesWhatIsCut) {
  openShape();
  press("chartCut");
  const std::vector<QPointF> places = placesOnModel();
  ASSERT_GT(places.size(), 30u);
  Pointer hand(&window.viewport());
  hand.click(places[0]);
  hand.click(places[20]);
  ASSERT_GT(charts.seams().count(), 0u);
  const Surface& surface = charts.on()->surface;
  const UVec2 ends = surface.ends(charts.seams().edges().front());
  const auto at = geometry().project(0.5f * (surface.positions[ends.x] + surface.positions[ends.y]));
  ASSERT_TRUE(at);
  hand.press(*at, Qt::ControlModifier);
  hand.release(*at, Qt::ControlModifier);
  EXPECT_EQ(charts.seams().count(), 0u);
  EXPECT_EQ(undoName(), s("Erase cut"));
}

TEST_F(ChartDockTest, AChartThatIsNoDiskIsNamedAndMendedByOneClick) {
  openShape();
  Recipe manual = session.document().recipe();
  manual.charts.mode = ChartsMode::Manual;
  session.document().edit(s("manual"), manual);
  settle();
  auto* mend = find<QPushButton>("chartMendOne");
  ASSERT_TRUE(mend);
  ASSERT_TRUE(mend->isVisible());
  QTest::mouseClick(mend, Qt::LeftButton);
  EXPECT_EQ(undoName(), s("Cut as suggested"));
  settle();
  EXPECT_EQ(charts.numbers().notDisks, 0);
  EXPECT_FALSE(find<QPushButton>("chartMend")->isVisible());
  EXPECT_TRUE(find<QPushButton>("chartExport")->isEnabled());
}

TEST_F(ChartDockTest, ChartsHaveColoursOnTheModel) {
  openShape("builtin:bird");
  const QImage before = picture();
  autoCut();
  const QImage coloured = picture();
  EXPECT_GT(difference(before, coloured), 0.05);
  QImage last = coloured;
  for (const ChartShade shade : {ChartShade::Checker, ChartShade::Stretch, ChartShade::Density}) {
    auto* box = find<QComboBox>("chartShade");
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Down);
    EXPECT_EQ(charts.shade(), shade);
    pass(150);
    const QImage now = picture();
    EXPECT_GT(difference(last, now), 0.02) << int(shade);
    last = now;
  }
  charts.setShade(ChartShade::Off);
  pass(150);
  EXPECT_LT(difference(before, picture()), 0.001);
}

TEST_F(ChartDockTest, AChartIsSelectedInBothViewsAndDragged) {
  openShape("builtin:bird");
  autoCut();
  ASSERT_GE(charts.items().size(), 2u);
  Pointer hand(&view());
  hand.click(middleOf(1));
  EXPECT_EQ(charts.selected(), 1);
  const auto before = charts.items();
  const QPointF from = middleOf(1);
  // Inwards, wherever it was packed: its handles stay in the view.
  const QPointF by(from.x() > view().width() / 2.0 ? -31 : 31, from.y() > view().height() / 2.0 ? -17 : 17);
  hand.drag(from, from + by, Qt::ControlModifier);  // Ctrl: it does not snap
  EXPECT_EQ(undoName(), s("Move chart"));
  const DVec2 moved = charts.items()[1].placement->offset - before[1].placement->offset;
  const DVec2 wanted = view().toPlane(by) - view().toPlane(QPointF(0, 0));
  EXPECT_NEAR(moved.x, wanted.x, 1e-4);
  EXPECT_NEAR(moved.y, wanted.y, 1e-4);
  EXPECT_NEAR(glm::distance(charts.items()[0].placement->offset, before[0].placement->offset), 0, 1e-6);
  // Esc takes a drag back.
  const ChartPlacement there = *charts.items()[1].placement;
  hand.press(middleOf(1));
  hand.move(middleOf(1) + QPointF(20, 20));
  QTest::keyClick(&view(), Qt::Key_Escape);
  hand.release(middleOf(1));
  EXPECT_NEAR(glm::distance(charts.items()[1].placement->offset, there.offset), 0, 1e-9);
  // Scale and turn by the handles.
  hand.drag(view().scaleBox()->bottomRight(), view().scaleBox()->center());
  EXPECT_EQ(undoName(), s("Scale chart"));
  EXPECT_LT(charts.items()[1].placement->scale, there.scale);
  const QPointF turn = *view().turnHandle(), middle = view().scaleBox()->center();
  hand.drag(turn, middle + QPointF(std::abs(turn.y() - middle.y()), 0));
  EXPECT_EQ(undoName(), s("Turn chart"));
  EXPECT_NEAR(std::abs(std::remainder(charts.items()[1].placement->angle - there.angle, 2 * kPi)), kPi / 2,
              0.3);
  press("chartPack");
  settle();
  EXPECT_EQ(undoName(), s("Pack charts"));
  EXPECT_FALSE(charts.items()[1].settings.place);
}

TEST_F(ChartDockTest, ACornerIsDraggedAlongTheBoundary) {
  openShape("builtin:bird");
  autoCut();
  Pointer hand(&view());
  hand.doubleClick(middleOf(0));
  ASSERT_TRUE(view().showsOne());
  charts.setCornerCount(0, 4);
  settle();
  view().fit();
  pass(30);
  const std::vector<std::uint32_t> before = charts.cornersOf(0);
  ASSERT_EQ(before.size(), 4u);
  // Towards the next corner, a third of the way.
  const QPointF from = view().cornerAt(1), to = from + (view().cornerAt(2) - from) / 3.0;
  hand.press(from);
  for (int step = 1; step <= 4; ++step) hand.move(from + (to - from) * step / 4.0);
  EXPECT_TRUE(session.document().inGesture());
  hand.release(to);
  EXPECT_EQ(undoName(), s("Move corner"));
  const std::vector<std::uint32_t> after = charts.cornersOf(0);
  ASSERT_EQ(after.size(), 4u);
  EXPECT_NE(after[1], before[1]);
  EXPECT_EQ(after[2], before[2]);
  settle();
  EXPECT_EQ(charts.items()[0].map->corners, after) << "the polygon followed";
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  settle();
  EXPECT_EQ(charts.cornersOf(0), before);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_FALSE(view().showsOne());
}

TEST_F(ChartDockTest, SavedAndOpenedAgainItIsAsItWas) {
  openShape("builtin:bird");
  autoCut();
  charts.select(0);
  QTest::keyClick(&view(), Qt::Key_Right, Qt::ShiftModifier);
  EXPECT_EQ(undoName(), s("Move chart"));
  settle();
  const auto before = charts.items();
  const QString file = folder.filePath(s("bird.prt"));
  session.save(file);
  ASSERT_TRUE(waitFor([&] { return !session.document().modified() && session.jobs().idle(); }));
  session.open(file);
  ASSERT_TRUE(settled());
  settle();
  ASSERT_EQ(charts.items().size(), before.size());
  for (std::size_t c = 0; c < before.size(); ++c) {
    EXPECT_EQ(charts.items()[c].settings, before[c].settings);
    EXPECT_EQ(charts.items()[c].map->uv, before[c].map->uv) << "the same to the last bit";
  }
}

TEST_F(ChartDockTest, TheMenuDoesTheSame) {
  openShape("builtin:bird");
  auto* action = find<QAction>("autoCut");
  ASSERT_TRUE(action && action->isEnabled());
  action->trigger();
  ASSERT_TRUE(waitFor([this] { return !charts.autoCutting() && !charts.items().empty(); }));
  settle();
  EXPECT_TRUE(find<QAction>("packCharts")->isEnabled());
  EXPECT_TRUE(find<QAction>("exportCoordinates")->isEnabled());
  find<QAction>("removeCuts")->trigger();
  EXPECT_EQ(undoName(), s("Remove all cuts"));
}

}  // namespace
}  // namespace prt::ui
