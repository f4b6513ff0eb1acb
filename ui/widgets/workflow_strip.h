#pragma once
// The steps of the work from left to right, each with the state of what it made; a click brings the
// dock of that step to the front.

#include "ui/model/bake_controller.h"

#include <QWidget>

#include <functional>
#include <vector>

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
  void refresh();

 private:
  struct Step {
    StateDot* dot;
    std::function<ProductStatus()> status;
  };
  QHBoxLayout* row_;
  std::vector<Step> steps_;
};

}  // namespace prt::ui
