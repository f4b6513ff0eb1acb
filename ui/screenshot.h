#pragma once
// Pictures of the window for the docs: the same bytes each time.

#include <QString>

class QApplication;

namespace prt::ui {

class MainWindow;
class Session;

struct ScreenshotOptions {
  QString file;
  QString dock;          ///< brought to the front of its place first; empty leaves the docks as they are
  QString sheet;         ///< "palette" or "keys": opened over the window
  bool autoCut = false;  ///< charts are cut first
  QString shown;         ///< "field", "wishes", "layers" or "ids": lies on the model; empty: none
};

/// Waits until everything is loaded, baked and drawn to its last pass, writes the window with all that lies
/// over the picture to the file and returns the exit status: 0, or 1 with a line on stderr when something
/// failed. Times and memory are left out.
int takeScreenshot(QApplication& application, MainWindow& window, Session& session,
                   const ScreenshotOptions& options);

}  // namespace prt::ui
