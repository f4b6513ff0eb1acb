#include "ui/docks/bake_footer.h"

#include "ui/docks/jobs_dock.h"
#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include <cmath>

namespace prt::ui {

BakeFooter::BakeFooter(Session& session, const QString& name, const QStringList& stages, QWidget* parent)
    : QWidget(parent),
      session_(session),
      stages_(stages),
      bar_(new QProgressBar),
      state_(new QLabel),
      button_(new QPushButton) {
  bar_->setObjectName(name + QStringLiteral("Progress"));
  bar_->setTextVisible(false);
  bar_->setFixedHeight(kGrid);
  state_->setObjectName(name + QStringLiteral("State"));
  setRole(state_, "muted");
  state_->setWordWrap(true);
  button_->setObjectName(name + QStringLiteral("Bake"));
  button_->setToolTip(tr("Bake everything that is out of date; while it bakes: stop, keeping what is done."));
  connect(button_, &QPushButton::clicked, &session_.bakes(), &BakeController::bakeOrCancel);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  for (QWidget* each :
       {static_cast<QWidget*>(bar_), static_cast<QWidget*>(state_), static_cast<QWidget*>(button_)})
    column->addWidget(each);
}

const JobInfo* BakeFooter::ownJob() const {
  const BakeController& bakes = session_.bakes();
  const bool fresh = bakes.worstStatus(stages_) == ProductStatus::Fresh;
  return bakes.baking() && !fresh ? session_.jobs().find(bakes.job()) : nullptr;
}

void BakeFooter::refresh(bool offered, const QString& text) {
  const BakeController& bakes = session_.bakes();
  const JobInfo* job = offered ? ownJob() : nullptr;
  bar_->setVisible(job);
  if (job) {
    const Progress& p = job->progress;
    bar_->setRange(0, 1000);
    bar_->setValue(int(std::lround(1000 * p.fraction())));
    state_->setText(tr("%1 \u00b7 %2").arg(QString::fromStdString(p.phase), progressText(p)));
  } else {
    state_->setText(text);
  }
  button_->setVisible(offered);
  button_->setEnabled(bakes.baking() || bakes.worstStatus(stages_) != ProductStatus::Fresh);
  button_->setText(bakes.baking() ? tr("Cancel") : tr("Bake"));
  button_->setIcon(icon(bakes.baking() ? QStringLiteral("process-stop") : QStringLiteral("run-build")));
}

}  // namespace prt::ui
