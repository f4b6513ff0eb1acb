#pragma once
// A real main window with a small scene in it, driven by events of the window system's kind.

#include "tests/ui/small_scene.h"
#include "tests/ui/wait.h"
#include "ui/main_window.h"
#include "ui/model/session.h"
#include "ui/viewport/viewport.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QMimeData>
#include <QTemporaryDir>
#include <QTest>
#include <QUrl>
#include <QWindow>

#include <memory>

namespace prt::test {

inline QString s(const char* text) {
  return QString::fromUtf8(text);
}

class StudioTest : public testing::Test {
 protected:
  StudioTest() : window(session, true) {
    window.resize(1200, 800);
    window.show();
    window.activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&window));
  }

  void open(const Recipe& recipe) {
    QFile file(folder.filePath(QStringLiteral("scene.json")));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(recipeToJson(recipe).dump()));
    file.close();
    session.open(file.fileName());
  }
  void openAndSettle(const Recipe& recipe = smallScene()) {
    open(recipe);
    ASSERT_TRUE(settled());
    pass(50);
  }

  /// Everything is read and baked.
  bool settled() {
    return waitFor([this] { return session.settled() && session.bakes().fresh(); });
  }
  QString undoName() { return session.document().undoName(); }
  const LightRecipe& light(int i) { return session.document().recipe().lights.at(std::size_t(i)); }
  /// Drags files over a widget and lets them go there, if it takes them.
  static bool drop(QWidget& widget, const QStringList& files) {
    QMimeData data;
    QList<QUrl> urls;
    for (const QString& file : files) urls << QUrl::fromLocalFile(file);
    data.setUrls(urls);
    const QPoint at = widget.rect().center();
    QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&widget, &enter);
    if (!enter.isAccepted()) return false;
    QDropEvent event(QPointF(at), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&widget, &event);
    return true;
  }

  QWindow* handle() { return window.windowHandle(); }
  /// A place in the viewport, from its middle, in the window.
  QPoint inView(int dx = 0, int dy = 0) {
    ui::Viewport& view = window.viewport();
    return view.mapTo(&window, QPoint(view.width() / 2 + dx, view.height() / 2 + dy));
  }
  /// Press, move in steps, release; through the window, as the window system does it.
  void drag(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, const QPoint& by) {
    const QPoint from = inView();
    QTest::mousePress(handle(), button, modifiers, from);
    for (int step = 1; step <= 4; ++step) {
      moveTo(from + by * step / 4, button, modifiers);
      pass(15);
    }
    QTest::mouseRelease(handle(), button, modifiers, from + by);
    pass(15);
  }
  QImage picture() {
    pass(50);
    return window.viewport().canvas().grabPicture();
  }

  QTemporaryDir folder;
  ui::Session session;
  ui::MainWindow window;

 private:
  // QTest::mouseMove knows no modifiers.
  void moveTo(const QPoint& at, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
    QMouseEvent move(QEvent::MouseMove, at, handle()->mapToGlobal(QPointF(at)), Qt::NoButton, button,
                     modifiers);
    QCoreApplication::sendEvent(handle(), &move);
  }
};

/// Share of pixels that differ visibly.
inline double difference(const QImage& a, const QImage& b) {
  if (a.size() != b.size()) return 1;
  qint64 count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      count +=
          std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) + std::abs(qBlue(p) - qBlue(q)) > 12;
    }
  return double(count) / (double(a.width()) * a.height());
}

}  // namespace prt::test
