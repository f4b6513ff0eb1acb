#pragma once
// prt-studio as a process of its own, with a home of its own.

#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>

#include <filesystem>

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
  void writeSettings(const QString& text) {
    QDir(folder.path()).mkpath(QStringLiteral("PRT Studio"));
    QFile file(folder.filePath(QStringLiteral("PRT Studio/prt-studio.conf")));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(text.toUtf8());
  }
  /// Where the process keeps what a crash must not take.
  std::filesystem::path recoveryRoot() const {
    return folder.filePath(QStringLiteral("PRT Studio/prt-studio/recovery")).toStdString();
  }
  static QString xdotool(const QStringList& arguments) {
    QProcess tool;
    tool.start(QStringLiteral("xdotool"), arguments);
    tool.waitForFinished(20000);
    return QString::fromUtf8(tool.readAllStandardOutput()).trimmed();
  }
  /// The number of its window, for xdotool; empty when there is none.
  static QString findWindow() {
    QString window;
    waitFor([&] {
      window = xdotool({QStringLiteral("search"), QStringLiteral("--onlyvisible"), QStringLiteral("--name"),
                        QStringLiteral("PRT Studio")})
                   .section(u'\n', 0, 0);
      return !window.isEmpty();
    });
    return window;
  }
  /// Shift + drag in the picture.
  static void turnEnvironment(const QString& window) {
    const auto moveTo = [&](int x) {
      xdotool({QStringLiteral("mousemove"), QStringLiteral("--window"), window, QString::number(x),
               QStringLiteral("450")});
    };
    moveTo(640);
    xdotool({QStringLiteral("keydown"), QStringLiteral("shift"), QStringLiteral("mousedown"),
             QStringLiteral("1")});
    for (int x = 660; x <= 760; x += 20) moveTo(x);
    xdotool(
        {QStringLiteral("mouseup"), QStringLiteral("1"), QStringLiteral("keyup"), QStringLiteral("shift")});
  }

  QTemporaryDir folder;
  QProcess studio;
  QString output;
};

}  // namespace prt::test
