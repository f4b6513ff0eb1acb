#pragma once
// The charts of the scene: cut, laid flat, packed - by hand and by itself - with the atlas as a thing to work
// on.

#include "ui/widgets/section.h"

#include <vector>

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace prt::ui {

class ChartEditor;
class ChartView;
class MessageBar;
class NumberField;
class PropertyRow;
class Session;

class ChartDock : public DockColumn {
  Q_OBJECT
 public:
  explicit ChartDock(Session& session, QWidget* parent = nullptr);

  ChartView& view() { return *view_; }
  /// Asks for a file and writes the atlas as texture coordinates of the mesh.
  void exportCoordinates();

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  Section* makeAtlas();
  Section* makeCut();
  Section* makeChart();
  Section* makeFlat();
  Section* makePack();
  QPushButton* makeButton(const char* name, const QString& text, const QString& tip,
                          std::function<void()> run);
  void refresh();
  void refreshNumbers();
  void refreshFaults();
  void refreshChart();

  Session& session_;
  ChartEditor& charts_;
  ChartView* view_;
  QComboBox *shown_, *shade_;
  QLabel *numbers_, *state_;
  QProgressBar* bar_;
  MessageBar* message_;
  QPushButton *cut_ = nullptr, *auto_ = nullptr, *mend_ = nullptr, *clear_ = nullptr, *flatten_ = nullptr,
              *pack_ = nullptr, *import_ = nullptr, *export_ = nullptr, *cancel_ = nullptr;
  QCheckBox *creases_ = nullptr, *locked_ = nullptr;
  QWidget* faults_;
  QStringList faultTexts_;
  Section* chart_ = nullptr;
  QLabel* chartFacts_ = nullptr;
  NumberField *weight_ = nullptr, *corners_ = nullptr;
};

}  // namespace prt::ui
