#pragma once
// The studio's window: the viewport in the middle, docks around it, what the mouse does at the bottom.

#include "ui/widgets/binding.h"

#include <QMainWindow>

class QDockWidget;

namespace prt::ui {

class ChartDock;
class CommandPalette;
class CutTool;
class StrokeBrush;
class SpotBrush;
class KeysOverlay;
class Layouts;
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
  ChartDock& chartDock() { return *chartDock_; }
  CutTool& cutTool() { return *cutTool_; }
  StrokeBrush& strokeBrush() { return *strokeBrush_; }
  MessageBar& messageBar() { return *message_; }
  CommandPalette& commandPalette() { return *palette_; }
  KeysOverlay& keys() { return *keys_; }
  Layouts& layouts() { return *layouts_; }
  /// The current mood's docks as they are planned.
  void resetLayout();
  /// Shows what a crashed studio left, if anything.
  void offerRecovery();
  /// Shows a dock in front of those it shares a place with. False when there is none of this name.
  bool bringToFront(const QString& dock);
  QStringList dockNames() const;
  /// Leaves out what differs from one time to the next: times, memory.
  void setPictureMode(bool on);
  /// What all keys and mouse movements do, place by place.
  QList<BindingGroup> bindings() const;

 protected:
  bool event(QEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  QDockWidget* addDock(const QString& title, const QString& name, QWidget* content, Qt::DockWidgetArea area);
  void makeDocks();
  void makeSheets();
  void refreshTitle();
  void showLinks();
  bool mayClose();
  void placeMessage();

  Session& session_;
  class DocumentMenu* documents_;
  Viewport* viewport_;
  class ViewActions* viewActions_;
  LightHandles* lightHandles_;
  CutTool* cutTool_;
  StrokeBrush* strokeBrush_;
  SpotBrush *wishBrush_, *layerBrush_;
  ChartDock* chartDock_ = nullptr;
  MessageBar* message_;
  class RecoveryBar* recovery_;
  class WorkflowStrip* strip_;
  Layouts* layouts_;
  CommandPalette* palette_ = nullptr;
  KeysOverlay* keys_ = nullptr;
  class StatusLine* statusLine_;
  QList<QDockWidget*> docks_;
  bool leaving_ = false;  // nothing is asked any more
};

}  // namespace prt::ui
