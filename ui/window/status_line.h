#pragma once
// The bottom of the window: the file, the size of the scene, what the mouse does where it is, memory.

#include <QObject>
#include <QString>

class QLabel;
class QStatusBar;

namespace prt::ui {

class Document;
class Session;
class Viewport;

class StatusLine : public QObject {
  Q_OBJECT
 public:
  /// Fills the bar, which owns the labels.
  StatusLine(Session& session, Viewport& viewport, QStatusBar& bar);

  /// Of the widget under the pointer; empty: the viewport says what the mouse does.
  void setTip(const QString& tip);
  void setMemoryVisible(bool visible);

 private:
  void refreshHint();
  void refreshFile();
  void refreshSize();
  void refreshMemory();

  Session& session_;
  Viewport& viewport_;
  QLabel* file_;
  QLabel* size_;
  QLabel* hint_;
  QLabel* memory_;
  QString tip_;
};

/// The document's name, "Untitled" while it has none.
QString documentName(const Document& document);

}  // namespace prt::ui
