#include "tests/ui/edit_until_killed.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QTemporaryDir>

#include <cstring>

int main(int argc, char** argv) {
  // Settings and recovery places of their own.
  const QTemporaryDir folder;
  for (const char* place : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"})
    qputenv(place, folder.path().toUtf8());
  QCoreApplication application(argc, argv);
  QCoreApplication::setApplicationName(QStringLiteral("prt-studio-test"));
  QCoreApplication::setOrganizationName(QStringLiteral("PRT Studio"));
  if (argc == 4 && std::strcmp(argv[1], "--edit-until-killed") == 0)
    return prt::test::editUntilKilled(QString::fromLocal8Bit(argv[2]), QString::fromLocal8Bit(argv[3]));
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
