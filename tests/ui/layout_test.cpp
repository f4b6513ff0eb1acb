// The window as a whole: proportions, and layouts that are kept and reset.

#include "tests/ui/studio_fixture.h"

#include <QDockWidget>
#include <QSettings>

namespace prt::ui {
namespace {

using test::pass;

QString s(const char* text) { return QString::fromUtf8(text); }

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
  const auto dock = [](MainWindow& window, const char* name) { return window.findChild<QDockWidget*>(s(name)); };
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
  settings.setValue(s("window/layout"), QByteArray(300, '\x5a'));
  settings.setValue(s("window/geometry"), QByteArray("nonsense"));
  Session session;
  MainWindow window(session, false);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  EXPECT_TRUE(window.viewport().isVisible());
  EXPECT_GT(window.viewport().width(), 300);
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
