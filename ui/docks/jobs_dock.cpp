#include "ui/docks/jobs_dock.h"

#include "ui/model/expression.h"
#include "ui/widgets/theme.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

namespace prt::ui {

namespace {

// 12 300 000 -> "12.3 M"
QString shortNumber(double value) {
  if (value >= 1e6) return formatNumber(value / 1e6, value >= 1e8 ? 0 : 1) + QStringLiteral(" M");
  if (value >= 1e3) return formatNumber(value / 1e3, value >= 1e5 ? 0 : 1) + QStringLiteral(" k");
  return formatNumber(value, 0);
}

QString stateText(const JobInfo& job) {
  const QString done = job.progress.total > 0
                           ? QStringLiteral(" \u00b7 %1 %").arg(int(100 * job.progress.fraction()))
                           : QString();
  switch (job.state) {
    case JobState::Queued:
      return QObject::tr("waiting for the one before it");
    case JobState::Paused:
      return QObject::tr("paused") + done;
    case JobState::Cancelling:
      return QObject::tr("stopping\u2026");
    case JobState::Done:
      return QObject::tr("done");
    case JobState::Cancelled:
      return QObject::tr("cancelled");
    case JobState::Failed:
      return job.error;
    case JobState::Running:
      break;
  }
  const QString phase = QString::fromStdString(job.progress.phase);
  const QString detail = progressText(job.progress);
  return phase.isEmpty() || detail.isEmpty() ? phase + detail : phase + QStringLiteral(" \u00b7 ") + detail;
}

}  // namespace

QString progressText(const Progress& p) {
  QStringList parts;
  if (p.rate() > 0 && !p.unit.empty())
    parts << QObject::tr("%1 %2/s").arg(shortNumber(p.rate()), QString::fromStdString(p.unit));
  if (p.secondsLeft() >= 0) parts << QObject::tr("%1 left").arg(formatSeconds(p.secondsLeft()));
  return parts.join(QStringLiteral(" \u00b7 "));
}

JobRow::JobRow(JobRunner& runner, quint64 id)
    : runner_(runner),
      id_(id),
      title_(new QLabel),
      ended_(new QLabel),
      detail_(new QLabel),
      bar_(new QProgressBar),
      pause_(new QToolButton),
      cancel_(new QToolButton),
      retry_(new QToolButton) {
  setRole(detail_, "muted");
  detail_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  detail_->setWordWrap(true);
  bar_->setTextVisible(false);
  bar_->setRange(0, 1000);
  cancel_->setIcon(icon(QStringLiteral("process-stop")));
  cancel_->setToolTip(tr("Cancel; what is done is kept."));
  cancel_->setObjectName(QStringLiteral("cancelJob"));
  pause_->setObjectName(QStringLiteral("pauseJob"));
  connect(cancel_, &QToolButton::clicked, this, [this] { runner_.cancel(id_); });
  connect(pause_, &QToolButton::clicked, this, [this] {
    const JobInfo* job = runner_.find(id_);
    if (job && job->state == JobState::Paused)
      runner_.resume(id_);
    else
      runner_.pause(id_);
  });
  retry_->setIcon(icon(QStringLiteral("view-refresh")));
  retry_->setText(tr("Try again"));
  retry_->setToolTip(tr("Start it again, once the reason is out of the way."));
  retry_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  retry_->setObjectName(QStringLiteral("retryJob"));
  connect(retry_, &QToolButton::clicked, this, [this] { runner_.retry(id_); });
  setObjectName(QStringLiteral("jobRow"));
  detail_->setObjectName(QStringLiteral("jobState"));
  ended_->setProperty("role", QStringLiteral("muted"));
  auto* head = new QHBoxLayout;
  head->setSpacing(2);
  head->addWidget(title_, 1);
  head->addWidget(ended_);
  head->addWidget(pause_);
  head->addWidget(cancel_);
  head->addWidget(retry_);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(2 * kGrid, 2, 2 * kGrid, 2);
  all->setSpacing(3);
  all->addLayout(head);
  all->addWidget(bar_);
  all->addWidget(detail_);
  refresh();
}

void JobRow::refresh() {
  const JobInfo* job = runner_.find(id_);
  if (!job) return;
  title_->setText(job->title);
  const bool live = !job->over(), failed = job->state == JobState::Failed;
  detail_->setText(stateText(*job));
  detail_->setVisible(live || failed);
  ended_->setText(failed ? tr("failed") : stateText(*job));
  ended_->setVisible(!live);
  if (failed) setRole(ended_, "failed");
  bar_->setVisible(live);
  bar_->setValue(int(1000 * job->progress.fraction()));
  const bool paused = job->state == JobState::Paused, stopping = job->state == JobState::Cancelling;
  bar_->setEnabled(!paused && !stopping);
  pause_->setVisible(live && !stopping);
  retry_->setVisible(failed && runner_.canRetry(id_));
  pause_->setIcon(
      icon(paused ? QStringLiteral("media-playback-start") : QStringLiteral("media-playback-pause")));
  pause_->setToolTip(paused ? tr("Go on") : tr("Pause"));
  cancel_->setVisible(live && !stopping);
}

JobsDock::JobsDock(JobRunner& runner, QWidget* parent)
    : QWidget(parent),
      runner_(runner),
      rows_(nullptr),
      empty_(new QLabel(tr("Nothing is running. Bakes start by themselves after edits and show up here."))) {
  setObjectName(QStringLiteral("dockBody"));
  auto* content = new QWidget;
  rows_ = new QVBoxLayout(content);
  rows_->setContentsMargins(0, kGrid, 0, kGrid);
  rows_->setSpacing(0);
  setRole(empty_, "muted");
  empty_->setWordWrap(true);
  empty_->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  rows_->addWidget(empty_);
  rows_->addStretch(1);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(content);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(scroll);
  connect(&runner_, &JobRunner::changed, this, &JobsDock::refresh);
  connect(&runner_, &JobRunner::retried, this, &JobsDock::refresh);  // the failed one cannot be any more
}

void JobsDock::refresh(quint64 id) {
  const auto found = shown_.find(id);
  if (found != shown_.end()) return found->second->refresh();
  const JobInfo* job = runner_.find(id);
  if (!job || (job->quiet && job->state != JobState::Failed)) return;
  auto* row = new JobRow(runner_, id);
  rows_->insertWidget(0, row);  // the newest on top
  shown_[id] = row;
  empty_->hide();
  tidy();
}

void JobsDock::tidy() {
  for (auto it = shown_.begin(); it != shown_.end() && int(shown_.size()) > kShown;) {
    const JobInfo* job = runner_.find(it->first);
    if (job && !job->over()) {
      ++it;
      continue;
    }
    it->second->deleteLater();
    it = shown_.erase(it);
  }
}

}  // namespace prt::ui
