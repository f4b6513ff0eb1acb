#pragma once
// The layers of patches as a stack, the uppermost first and the patch that they cover at the bottom: which
// one is worked on, here and in the Patch dock, and the brush that paints where it covers what is below.

#include "ui/widgets/section.h"

class QCheckBox;
class QLabel;
class QListWidget;
class QPushButton;
class QToolButton;

namespace prt::ui {

class LayerEditor;
class NumberField;
class Painting;
class Session;

class LayerSection : public Section {
  Q_OBJECT
 public:
  explicit LayerSection(Session& session, QWidget* parent = nullptr);

 private:
  void makeList();
  QWidget* makeBar();
  void makeBrush();
  void refresh();
  void refreshList();
  int layerOf(int row) const;
  int rowOf(int layer) const;

  Session& session_;
  LayerEditor& layers_;
  Painting& painting_;
  QListWidget* list_;
  QToolButton *add_, *remove_;
  QPushButton *paint_, *erase_;
  NumberField *width_, *strength_;
  QCheckBox* shown_;
  QLabel* state_;
};

}  // namespace prt::ui
