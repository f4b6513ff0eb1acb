#pragma once
// What is in the scene: the objects with their sizes, and what the reader found and mended.

#include "ui/widgets/section.h"

class QLabel;
class QTreeWidget;

namespace prt::ui {

class Session;

class SceneDock : public DockColumn {
  Q_OBJECT
 public:
  explicit SceneDock(Session& session, QWidget* parent = nullptr);

 private:
  void refresh();

  Session& session_;
  QTreeWidget* objects_;
  QLabel* report_;
};

}  // namespace prt::ui
