#pragma once
// The material of the selected object: presets, one row per parameter of the recipe, the lobe as a plot, and
// a word when it reflects more than it gets.

#include "ui/model/material_editor.h"
#include "ui/widgets/section.h"

#include <QStringList>

class QComboBox;
class QFrame;
class QLabel;

namespace prt::ui {

class LobePlot;
class PresetGrid;
class Session;

class MaterialDock : public DockColumn {
  Q_OBJECT
 public:
  explicit MaterialDock(Session& session, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeHead();
  Section* makePresets();
  QFrame* makeWarning();
  void showObject(int object);
  void refreshObjects();
  void refreshMaterial();
  void makePictures();

  Session& session_;
  MaterialEditor editor_;
  QComboBox* objects_;
  PresetGrid* presets_;
  QFrame* warning_;
  QLabel* warningText_;
  Section* reflection_;
  QWidget* rows_ = nullptr;  // of the object that is shown
  LobePlot* plot_;
  QStringList names_;  // in objects_
  bool picturesWanted_ = false;
};

}  // namespace prt::ui
