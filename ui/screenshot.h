#pragma once
// Pictures of the window for the docs.

#include <QString>

class QApplication;

namespace prt::ui {

class MainWindow;
class Session;

/// Waits until everything is loaded and baked, writes the window to `file` and returns the exit status:
/// 0, or 1 with a line on stderr when something failed.
int takeScreenshot(QApplication& application, MainWindow& window, Session& session, const QString& file);

}  // namespace prt::ui
