// The window as a whole: proportions, and layouts that are kept and reset.

#include "tests/ui/studio_fixture.h"
#include "ui/widgets/dock_title.h"
#include "ui/window/layouts.h"

#include <QDockWidget>
#include <QFrame>
#include <QSettings>
#include <QTabBar>
#include <QToolButton>

namespace prt::ui {
namespace {

using test::pass;
using test::s;

TEST(Layout, TheViewportHasSixtyPercentOfADefaultWindow) {
  Session session;
  MainWindow window(session, true);
  window.resize(1440, 900);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  pass(50);
  const QSize view = window.viewport().size();
  EXPECT_GE(double(view.width()) * view.height(), 0.6 * 1440 * 900) << view.width() << " x " << view.height();
}

TEST(Layout, IsKeptFromOneTimeToTheNextAndForgottenOnRequest) {
  const auto dock = [](MainWindow& window, const char* name) {
    return window.findChild<QDockWidget*>(s(name));
  };
  {
    Session session;
    MainWindow window(session, true);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    EXPECT_FALSE(dock(window, "log")->isHidden());
    dock(window, "log")->hide();
    window.addDockWidget(Qt::RightDockWidgetArea, dock(window, "scene"));
    window.close();
  }
  {
    Session session;
    MainWindow window(session, false);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    EXPECT_TRUE(dock(window, "log")->isHidden());
    EXPECT_EQ(window.dockWidgetArea(dock(window, "scene")), Qt::RightDockWidgetArea);
    window.resetLayout();
    EXPECT_FALSE(dock(window, "log")->isHidden());
    EXPECT_EQ(window.dockWidgetArea(dock(window, "scene")), Qt::LeftDockWidgetArea);
  }
  {
    Session session;
    MainWindow window(session, true);
    EXPECT_FALSE(dock(window, "log")->isHidden()) << "--reset-ui";
    EXPECT_EQ(window.dockWidgetArea(dock(window, "scene")), Qt::LeftDockWidgetArea);
  }
}

TEST(Layout, ARuinedLayoutIsSurvived) {
  QSettings settings;
  settings.setValue(s("window/mood"), s("nonsense"));
  for (const LayoutPlan& plan : layoutPlans())
    settings.setValue(s("window/layout/") + plan.name, QByteArray(300, '\x5a'));
  settings.setValue(s("window/geometry"), QByteArray("nonsense"));
  Session session;
  MainWindow window(session, false);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  EXPECT_TRUE(window.viewport().isVisible());
  EXPECT_GT(window.viewport().width(), 300);
}

using LayoutWindow = test::StudioTest;

TEST_F(LayoutWindow, TheStripChangesMoodsAndEachKeepsWhatWasMadeOfIt) {
  const auto area = [&](const char* name) {
    return window.dockWidgetArea(window.findChild<QDockWidget*>(s(name)));
  };
  const auto choose = [&](const char* title) {
    for (QToolButton* button : window.findChild<QFrame*>(s("layoutChoices"))->findChildren<QToolButton*>())
      if (button->text() == s(title)) QTest::mouseClick(button, Qt::LeftButton);
    pass(30);
  };
  EXPECT_EQ(window.layouts().current(), s("relight"));
  EXPECT_EQ(area("light"), Qt::LeftDockWidgetArea);
  choose("Bake");
  EXPECT_EQ(window.layouts().current(), s("bake"));
  EXPECT_EQ(area("light"), Qt::RightDockWidgetArea);
  window.addDockWidget(Qt::LeftDockWidgetArea, window.findChild<QDockWidget*>(s("transfer")));
  choose("Relight");
  EXPECT_EQ(area("light"), Qt::LeftDockWidgetArea);
  EXPECT_EQ(area("transfer"), Qt::RightDockWidgetArea);
  QTest::keyClick(handle(), Qt::Key_F6);
  EXPECT_EQ(window.layouts().current(), s("bake"));
  EXPECT_EQ(area("transfer"), Qt::LeftDockWidgetArea) << "as it was left";
  window.resetLayout();
  EXPECT_EQ(area("transfer"), Qt::RightDockWidgetArea);
}

TEST_F(LayoutWindow, EveryMoodShowsEveryDockAndLeavesThePictureItsSixtyPercent) {
  window.resize(1440, 900);
  for (const LayoutPlan& plan : window.layouts().plans()) {
    window.layouts().choose(plan.name);
    pass(50);
    for (const QDockWidget* dock : window.findChildren<QDockWidget*>())
      EXPECT_EQ(dock->isHidden(), plan.hidden.contains(dock->objectName()))
          << dock->objectName().toStdString();
    const QSize view = window.viewport().size();
    EXPECT_GE(double(view.width()) * view.height(), 0.6 * 1440 * 900) << plan.name.toStdString();
  }
}

TEST_F(LayoutWindow, ADoubleClickOnTheTitleFloatsADockAndItsButtonsWork) {
  auto* dock = window.findChild<QDockWidget*>(s("scene"));
  QTest::mouseDClick(dock->titleBarWidget(), Qt::LeftButton);
  EXPECT_TRUE(dock->isFloating());
  pass(50);
  auto* bar = qobject_cast<DockTitle*>(dock->titleBarWidget());
  QEnterEvent enter(QPointF(5, 5), QPointF(5, 5), QPointF(5, 5));
  QCoreApplication::sendEvent(bar, &enter);
  const QList<QToolButton*> buttons = bar->findChildren<QToolButton*>();
  ASSERT_EQ(buttons.size(), 2);
  QTest::mouseClick(buttons[0], Qt::LeftButton);
  EXPECT_FALSE(dock->isFloating());
  QCoreApplication::sendEvent(bar, &enter);
  QTest::mouseClick(buttons[1], Qt::LeftButton);
  EXPECT_TRUE(dock->isHidden());
  dock->toggleViewAction()->trigger();
  EXPECT_FALSE(dock->isHidden());
}

TEST_F(LayoutWindow, ADockThatAMoodDoesWithoutBringsItsOwnMood) {
  EXPECT_EQ(window.layouts().current(), s("relight"));
  EXPECT_FALSE(window.findChild<QDockWidget*>(s("patch"))->isVisible());
  ASSERT_TRUE(window.bringToFront(s("patch")));
  pass(30);
  EXPECT_EQ(window.layouts().current(), s("author"));
  EXPECT_TRUE(window.findChild<QDockWidget*>(s("patch"))->isVisible());
  window.findChild<QDockWidget*>(s("patch"))->hide();
  ASSERT_TRUE(window.bringToFront(s("patch")));
  EXPECT_EQ(window.layouts().current(), s("author")) << "closed by hand: it comes back where it was";
}

TEST_F(LayoutWindow, TabsBringDocksForward) {
  QTabBar* tabs = nullptr;
  for (QTabBar* bar : window.findChildren<QTabBar*>())
    for (int i = 0; i < bar->count(); ++i)
      if (bar->tabText(i) == s("Log")) tabs = bar;
  ASSERT_TRUE(tabs);
  auto* log = window.findChild<QDockWidget*>(s("log"));
  EXPECT_TRUE(log->widget()->visibleRegion().isEmpty());
  for (int i = 0; i < tabs->count(); ++i)
    if (tabs->tabText(i) == s("Log"))
      QTest::mouseClick(tabs, Qt::LeftButton, Qt::NoModifier, tabs->tabRect(i).center());
  pass(30);
  EXPECT_FALSE(log->widget()->visibleRegion().isEmpty());
}

TEST(Layout, AnEmptyStudioTeaches) {
  Session session;
  MainWindow window(session, true);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  EXPECT_FALSE(session.relighter().scene());
  EXPECT_FALSE(window.windowTitle().isEmpty());
  EXPECT_TRUE(window.viewport().hint().contains(s("Shift+drag")));
}

}  // namespace
}  // namespace prt::ui
