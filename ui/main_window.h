#pragma once
// The studio's window: the viewport in the middle, docks around it, what the mouse does at the bottom.

#include <QMainWindow>

class QLabel;

namespace prt::ui {

class LightHandles;
class MessageBar;
class Session;
class Viewport;

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  /// Restores the layout of the last time unless `freshLayout`.
  MainWindow(Session& session, bool freshLayout);
  ~MainWindow() override;

  Viewport& viewport() { return *viewport_; }
  LightHandles& lightHandles() { return *lightHandles_; }
  MessageBar& messageBar() { return *message_; }
  void resetLayout();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  QDockWidget* addDock(const QString& title, const QString& name, QWidget* content, Qt::DockWidgetArea area);
  void makeDocks();
  void makeMenus();
  void makeFileMenu();
  void makeEditMenu();
  void makeViewMenu();
  void makeHelpMenu();
  void makeStatusBar();
  void openFile();
  void saveProject(bool askForName);
  void refreshTitle();
  void placeMessage();
  void showKeys();

  Session& session_;
  Viewport* viewport_;
  LightHandles* lightHandles_;
  MessageBar* message_;
  class WorkflowStrip* strip_;
  QLabel* fileLabel_;
  QLabel* memoryLabel_;
  QLabel* hintLabel_;
  QList<QDockWidget*> docks_;
  QByteArray firstLayout_;
};

}  // namespace prt::ui
