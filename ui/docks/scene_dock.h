#pragma once
// What is in the scene: the list of objects, and of the selected one its place, how its mesh is read, and
// what was wrong with its file. Meshes dropped here are added.

#include "ui/widgets/section.h"

class QCheckBox;
class QToolButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace prt::ui {

class MessageBar;
class Session;

class SceneDock : public DockColumn {
  Q_OBJECT
 public:
  explicit SceneDock(Session& session, QWidget* parent = nullptr);

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  QWidget* makeBar();
  void makeList();
  void makeActions();
  void addFromFile();
  void refresh();
  void toggle(int object);
  static void showEye(QTreeWidgetItem& item, bool visible);
  int current() const;

  Session& session_;
  MessageBar* message_;
  QTreeWidget* objects_;
  QCheckBox* ground_;
  QToolButton* duplicate_;
  QToolButton* remove_;
};

}  // namespace prt::ui
