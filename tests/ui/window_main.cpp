#include "tests/ui/save_until_killed.h"
#include "ui/viewport/gl_canvas.h"
#include "ui/widgets/theme.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QStandardPaths>

#include <cstdlib>
#include <cstring>
#include <iostream>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (GTEST_FLAG_GET(list_tests)) return RUN_ALL_TESTS();
  if (!std::getenv("DISPLAY")) {
    std::cerr << "these tests drive a real window: run them through ./dev test, or under xvfb-run\n";
    return 1;
  }
  setenv("QT_QPA_PLATFORM", "xcb", 1);
  QStandardPaths::setTestModeEnabled(true);  // settings of their own
  prt::ui::GlCanvas::requestFormat();
  QApplication application(argc, argv);
  QApplication::setApplicationName(QStringLiteral("prt-studio-test"));
  QApplication::setOrganizationName(QStringLiteral("PRT Studio"));
  if (argc == 4 && std::strcmp(argv[1], "--save-until-killed") == 0)
    return prt::test::saveUntilKilled(QString::fromLocal8Bit(argv[2]), QString::fromLocal8Bit(argv[3]));
  prt::ui::applyTheme(application, prt::ui::darkTheme());
  return RUN_ALL_TESTS();
}
