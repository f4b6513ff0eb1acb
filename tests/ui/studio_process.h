#pragma once
// prt-studio as a process of its own, with a home of its own.

#include "tests/ui/small_scene.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>

namespace prt::test {

class StudioProcess : public testing::Test {
 protected:
  StudioProcess() {
    setEnvironment("HOME", folder.path());  // settings of its own
    setEnvironment("XDG_CONFIG_HOME", folder.path());
    setEnvironment("XDG_DATA_HOME", folder.path());
    setEnvironment("XDG_CACHE_HOME", folder.path());
    setEnvironment("QT_QPA_PLATFORM", QStringLiteral("xcb"));
    studio.setProcessChannelMode(QProcess::MergedChannels);
  }
  ~StudioProcess() override {
    if (studio.state() == QProcess::NotRunning) return;
    studio.kill();
    studio.waitForFinished();
  }
  void setEnvironment(const char* name, const QString& value) {
    QProcessEnvironment environment = studio.processEnvironment().isEmpty()
                                          ? QProcessEnvironment::systemEnvironment()
                                          : studio.processEnvironment();
    environment.insert(QLatin1String(name), value);
    studio.setProcessEnvironment(environment);
  }
  static QString program() { return QCoreApplication::applicationDirPath() + QStringLiteral("/prt-studio"); }
  void start(const QStringList& arguments) {
    studio.start(program(), arguments);
    ASSERT_TRUE(studio.waitForStarted()) << program().toStdString();
  }
  /// Exit status; -1 when it does not end, -2 when it crashed.
  int end(int milliseconds = 90000) {
    if (!studio.waitForFinished(milliseconds)) return -1;
    output += QString::fromUtf8(studio.readAll());
    return studio.exitStatus() == QProcess::NormalExit ? studio.exitCode() : -2;
  }
  QString writeScene(const Recipe& recipe) {
    QFile file(folder.filePath(QStringLiteral("scene.json")));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(recipeToJson(recipe).dump()));
    return file.fileName();
  }
  static QString xdotool(const QStringList& arguments) {
    QProcess tool;
    tool.start(QStringLiteral("xdotool"), arguments);
    tool.waitForFinished(20000);
    return QString::fromUtf8(tool.readAllStandardOutput()).trimmed();
  }

  QTemporaryDir folder;
  QProcess studio;
  QString output;
};

}  // namespace prt::test
