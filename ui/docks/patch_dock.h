#pragma once
// The fine structure of the surface: what kind it is, the parameters of its generator live, and the patch as
// a thing to turn.

#include "ui/model/patch_preview.h"
#include "ui/widgets/section.h"

#include <vector>

class QComboBox;
class QLabel;

namespace prt::ui {

class LayerEditor;
class MessageBar;
class PresetGrid;
class PropertyRow;
class Session;

class PatchDock : public DockColumn {
  Q_OBJECT
 public:
  explicit PatchDock(Session& session, QWidget* parent = nullptr);

  const PatchPreview& preview() const { return preview_; }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Row {
    PropertyRow* row;
    unsigned models;  // of PatchModel, as bits: those that read it
  };
  QWidget* makeHead();
  Section* makePresets();
  void makeSections();
  void refreshLayers();
  Section* makeRows(const QString& title, const std::vector<std::pair<const char*, unsigned>>& paths);
  void refresh();
  void refreshPreview();
  void makePictures();

  Session& session_;
  LayerEditor& layers_;
  PatchPreview preview_;
  QWidget* head_ = nullptr;
  QComboBox* which_;
  PresetGrid* presets_;
  MessageBar* message_;
  QLabel* facts_;
  QLabel* warning_;
  QWidget* sections_ = nullptr;  // the rows of one patch, made anew for another
  Section* reflection_ = nullptr;
  std::vector<Row> rows_;
  bool picturesWanted_ = false;
};

}  // namespace prt::ui
