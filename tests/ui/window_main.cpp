#include "ui/viewport/gl_canvas.h"
#include "ui/widgets/theme.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QStandardPaths>

#include <cstdlib>
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
  prt::ui::applyTheme(application, prt::ui::darkTheme());
  return RUN_ALL_TESTS();
}
