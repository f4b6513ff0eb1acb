#pragma once
// How the patch is laid over the surface: grown by synthesis along a field of directions, or by the mesh's
// own coordinates; what came of it, in numbers and as the id map.

#include "ui/model/synthesis_look.h"
#include "ui/widgets/section.h"

#include <functional>
#include <vector>

class QCheckBox;
class QHBoxLayout;
class QLabel;
class QPushButton;

namespace prt::ui {

class BakeFooter;
class NumberField;
class PropertyRow;
class Session;

class SynthesisDock : public DockColumn {
  Q_OBJECT
 public:
  explicit SynthesisDock(Session& session, QWidget* parent = nullptr);

 private:
  Section* makeShown();
  Section* makeRows(const QString& title, const std::vector<const char*>& paths);
  void refresh();
  void makeStrokes();
  void refreshStrokes();
  void makeWishes();
  void refreshWishes();
  /// Shares the row in equal parts, however narrow the dock is.
  QPushButton* makeButton(QHBoxLayout* row, const char* name, const QString& text, const QString& tip,
                          std::function<void()> run);
  void refreshResult();
  QString resultText() const;

  Session& session_;
  SynthesisLook look_;
  QCheckBox* shown_;
  PropertyRow *views_ = nullptr, *filter_ = nullptr;
  Section *laying_ = nullptr, *direction_ = nullptr, *texture_ = nullptr, *parts_ = nullptr,
          *layers_ = nullptr;
  std::vector<PropertyRow*> grownRows_, laidRows_;
  QLabel* map_;
  QPushButton *draw_ = nullptr, *erase_ = nullptr;
  QCheckBox* field_ = nullptr;
  QPushButton *paint_ = nullptr, *clear_ = nullptr;
  QCheckBox *wishes_ = nullptr, *ids_ = nullptr;
  NumberField* width_ = nullptr;
  QLabel *strokes_ = nullptr, *spots_ = nullptr;
  BakeFooter* footer_;
};

}  // namespace prt::ui
