#include "ui/model/job_runner.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"

#include <QMetaObject>

#include <algorithm>
#include <exception>
#include <utility>

namespace prt::ui {

struct JobRunner::Task {
  Task(JobRunner* runner, quint64 number, QString ofKind, Work toDo, Finish whenOver)
      : id(number),
        kind(std::move(ofKind)),
        work(std::move(toDo)),
        finish(std::move(whenOver)),
        job([runner, number](const Progress& progress) { runner->report(number, progress); }) {}

  quint64 id;
  QString kind;
  Work work;
  Finish finish;
  bool held = false;  // paused while it waits
  Job job;
};

JobRunner::JobRunner(int threads, QObject* parent) : QObject(parent) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { workerLoop(); });
}

JobRunner::~JobRunner() {
  stop();
}

void JobRunner::stop() {
  {
    std::lock_guard lock(mutex_);
    stopping_ = true;
    queue_.clear();
    for (const auto& task : running_) task->job.cancel();
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

static JobInfo queued(const QString& kind, const QString& title) {
  JobInfo info;
  info.kind = kind;
  info.title = title;
  return info;
}

quint64 JobRunner::start(const QString& kind, const QString& title, Work work, Finish finish) {
  return add(queued(kind, title), std::move(work), std::move(finish));
}

quint64 JobRunner::startQuietly(const QString& kind, const QString& title, Work work, Finish finish) {
  JobInfo info = queued(kind, title);
  info.quiet = true;
  return add(std::move(info), std::move(work), std::move(finish));
}

quint64 JobRunner::add(JobInfo info, Work work, Finish finish) {
  const QString kind = info.kind;
  cancelKind(kind);
  std::erase_if(failed_, [&](const auto& task) { return task->kind == kind; });
  const quint64 id = info.id = nextId_++;
  infos_.push_back(std::move(info));

  forgetOld();
  {
    std::lock_guard lock(mutex_);
    queue_.push_back(std::make_shared<Task>(this, id, kind, std::move(work), std::move(finish)));
  }
  wake_.notify_one();
  Q_EMIT changed(id);
  return id;
}

// A task that waits or runs; under the mutex.
std::shared_ptr<JobRunner::Task> JobRunner::taskOf(quint64 id) {
  for (const auto& task : running_)
    if (task->id == id) return task;
  for (const auto& task : queue_)
    if (task->id == id) return task;
  return nullptr;
}

// Of a job that is not over: its end may be on the way to this thread, and comes after.
void JobRunner::setState(quint64 id, JobState state) {
  JobInfo* job = info(id);
  if (!job || job->over() || job->state == state) return;
  if (job->pause.isValid()) job->paused += 1e-3 * double(job->pause.elapsed());
  job->pause.invalidate();
  if (state == JobState::Paused) job->pause.start();
  job->state = state;
  Q_EMIT changed(id);
}

void JobRunner::cancel(quint64 id) {
  std::shared_ptr<Task> dropped, running;
  {
    std::lock_guard lock(mutex_);
    const auto task = taskOf(id);
    if (task && std::erase(queue_, task) > 0)
      dropped = task;
    else
      running = task;
  }
  if (dropped) return conclude(dropped, JobState::Cancelled, {});
  if (!running) return;
  running->job.cancel();
  setState(id, JobState::Cancelling);
}

void JobRunner::cancelKind(const QString& kind) {
  std::vector<quint64> same;
  for (const JobInfo& each : infos_)
    if (each.kind == kind && !each.over()) same.push_back(each.id);
  for (const quint64 id : same) cancel(id);
}

void JobRunner::pause(quint64 id) {
  const JobInfo* job = find(id);
  if (!job || job->over() || job->state == JobState::Cancelling) return;
  {
    std::lock_guard lock(mutex_);
    const auto task = taskOf(id);
    if (!task) return;  // its end is on the way
    task->held = true;
    task->job.pause();
  }
  setState(id, JobState::Paused);
}

void JobRunner::resume(quint64 id) {
  bool waits = false;
  {
    std::lock_guard lock(mutex_);
    const auto task = taskOf(id);
    if (!task || !task->held) return;
    task->held = false;
    task->job.resume();
    waits = std::find(queue_.begin(), queue_.end(), task) != queue_.end();
  }
  wake_.notify_all();
  setState(id, waits ? JobState::Queued : JobState::Running);
}

bool JobRunner::canRetry(quint64 id) const {
  return std::any_of(failed_.begin(), failed_.end(), [id](const auto& task) { return task->id == id; });
}

quint64 JobRunner::retry(quint64 id) {
  const auto found =
      std::find_if(failed_.begin(), failed_.end(), [id](const auto& task) { return task->id == id; });
  const JobInfo* job = find(id);
  if (found == failed_.end() || !job) return 0;
  const std::shared_ptr<Task> task = *found;
  const QString title = job->title;
  const quint64 again = start(task->kind, title, task->work, task->finish);
  Q_EMIT retried(id, again);
  return again;
}

const JobInfo* JobRunner::find(quint64 id) const {
  return const_cast<JobRunner*>(this)->info(id);
}

bool JobRunner::idle() const {
  return std::all_of(infos_.begin(), infos_.end(), [](const JobInfo& each) { return each.over(); });
}

void JobRunner::workerLoop() {
  const BackgroundWork background;
  while (const std::shared_ptr<Task> task = takeTask()) {
    run(task);
    {
      std::lock_guard lock(mutex_);
      std::erase(running_, task);
    }
    wake_.notify_all();  // one of the same kind may be waiting for this one
  }
}

// The first task whose kind is not running already; null when the runner stops.
std::shared_ptr<JobRunner::Task> JobRunner::takeTask() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const auto ready = std::find_if(queue_.begin(), queue_.end(), [this](const auto& waiting) {
      return !waiting->held && std::none_of(running_.begin(), running_.end(),
                                            [&](const auto& t) { return t->kind == waiting->kind; });
    });
    if (ready != queue_.end()) {
      std::shared_ptr<Task> task = *ready;
      queue_.erase(ready);
      running_.push_back(task);
      return task;
    }
    wake_.wait(lock);
  }
  return nullptr;
}

void JobRunner::run(const std::shared_ptr<Task>& task) {
  QMetaObject::invokeMethod(
      this,
      [this, id = task->id] {
        if (JobInfo* job = info(id); job && job->state == JobState::Queued) job->state = JobState::Running;
        Q_EMIT changed(id);
      },
      Qt::QueuedConnection);

  JobState state = JobState::Done;
  QString error;
  try {
    task->work(task->job);
  } catch (const Cancelled&) {
    state = JobState::Cancelled;
  } catch (const std::bad_alloc&) {
    state = JobState::Failed;
    error = QStringLiteral("not enough memory (close other programs, or use a smaller mesh or fewer bands)");
  } catch (const std::exception& problem) {
    state = JobState::Failed;
    error = QString::fromUtf8(problem.what());
  }
  QMetaObject::invokeMethod(
      this, [this, task, state, error] { conclude(task, state, error); }, Qt::QueuedConnection);
}

void JobRunner::report(quint64 id, const Progress& progress) {
  QMetaObject::invokeMethod(
      this,
      [this, id, progress] {
        JobInfo* job = info(id);
        if (!job || job->over()) return;
        if (progress.phase != job->progress.phase) job->paused = 0;
        job->progress = progress;
        job->progress.seconds = std::max(0.0, progress.seconds - job->paused);
        Q_EMIT changed(id);
      },
      Qt::QueuedConnection);
}

void JobRunner::conclude(const std::shared_ptr<Task>& task, JobState state, const QString& error) {
  JobInfo* job = info(task->id);
  if (!job) return;
  job->state = state;
  job->error = error;
  if (state == JobState::Failed) failed_.push_back(task);
  const JobInfo copy = *job;
  Q_EMIT changed(copy.id);
  if (task->finish) task->finish(copy);
  Q_EMIT finished(copy.id);
}

JobInfo* JobRunner::info(quint64 id) {
  const auto found =
      std::find_if(infos_.begin(), infos_.end(), [id](const JobInfo& each) { return each.id == id; });
  return found == infos_.end() ? nullptr : &*found;
}

void JobRunner::forgetOld() {
  while (infos_.size() > kRemembered) {
    const auto over =
        std::find_if(infos_.begin(), infos_.end(), [](const JobInfo& each) { return each.over(); });
    if (over == infos_.end()) return;
    infos_.erase(over);
  }
}

}  // namespace prt::ui
