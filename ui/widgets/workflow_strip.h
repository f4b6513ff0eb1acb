#pragma once
// The steps of the work from left to right, each with the state of what it made; a click brings the
// dock of that step to the front. After them the layouts for the moods of work.

#include "ui/model/bake_controller.h"

#include <QWidget>

#include <functional>
#include <vector>

class QAction;
class QHBoxLayout;

namespace prt::ui {

class StateDot;

class WorkflowStrip : public QWidget {
  Q_OBJECT
 public:
  explicit WorkflowStrip(QWidget* parent = nullptr);
  /// Appends a step; `status` is asked whenever refresh() is called.
  void addStep(const QString& title, const QString& tip, std::function<ProductStatus()> status,
               std::function<void()> activate);
  /// Appends a button for a layout at the far end; it is checked as the action is.
  void addLayoutChoice(QAction* action);
  void refresh();

 private:
  struct Step {
    StateDot* dot;
    std::function<ProductStatus()> status;
  };
  QHBoxLayout* row_;
  std::vector<Step> steps_;
  QHBoxLayout* layouts_ = nullptr;  // made with the first choice
};

}  // namespace prt::ui
