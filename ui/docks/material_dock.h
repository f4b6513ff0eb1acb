#pragma once
// The material of the selected object, one row per parameter of the recipe.

#include "ui/widgets/section.h"

class QComboBox;

namespace prt::ui {

class Session;

class MaterialDock : public DockColumn {
  Q_OBJECT
 public:
  explicit MaterialDock(Session& session, QWidget* parent = nullptr);

 private:
  void showObject(int object);
  void refreshObjects();

  Session& session_;
  QComboBox* objects_;
  QWidget* rows_ = nullptr;
};

}  // namespace prt::ui
