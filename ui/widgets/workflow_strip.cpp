#include "ui/widgets/workflow_strip.h"

#include "ui/widgets/state_dot.h"
#include "ui/widgets/theme.h"

#include <QAction>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace prt::ui {

WorkflowStrip::WorkflowStrip(QWidget* parent) : QWidget(parent), row_(new QHBoxLayout(this)) {
  row_->setContentsMargins(0, 0, 2 * kGrid, 0);
  row_->setSpacing(2);
}

void WorkflowStrip::addStep(const QString& title, const QString& tip, std::function<ProductStatus()> status,
                            std::function<void()> activate) {
  if (!steps_.empty()) {
    auto* arrow = new QLabel(QStringLiteral("\u203a"));
    setRole(arrow, "muted");
    arrow->setContentsMargins(kGrid, 0, kGrid, 0);
    row_->addWidget(arrow);
  }
  auto* dot = new StateDot;
  auto* button = new QToolButton;
  button->setText(title);
  button->setToolTip(tip);
  button->setFocusPolicy(Qt::NoFocus);
  connect(button, &QToolButton::clicked, this, std::move(activate));
  row_->addWidget(dot);
  row_->addWidget(button);
  steps_.push_back({dot, std::move(status)});
}

void WorkflowStrip::addLayoutChoice(QAction* action) {
  if (!layouts_) {
    auto* frame = new QFrame;
    frame->setObjectName(QStringLiteral("layoutChoices"));
    layouts_ = new QHBoxLayout(frame);
    layouts_->setContentsMargins(2, 2, 2, 2);
    layouts_->setSpacing(2);
    row_->addSpacing(4 * kGrid);
    row_->addWidget(frame);
  }
  auto* button = new QToolButton;
  button->setDefaultAction(action);
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  button->setFocusPolicy(Qt::NoFocus);
  layouts_->addWidget(button);
}

void WorkflowStrip::refresh() {
  for (const Step& step : steps_) step.dot->setStatus(step.status());
}

}  // namespace prt::ui
