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
      : id(number), kind(std::move(ofKind)), work(std::move(toDo)), finish(std::move(whenOver)),
        job([runner, number](const Progress& progress) { runner->report(number, progress); }) {}

  quint64 id;
  QString kind;
  Work work;
  Finish finish;
  Job job;
};

JobRunner::JobRunner(int threads, QObject* parent) : QObject(parent) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { workerLoop(); });
}

JobRunner::~JobRunner() { stop(); }

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

quint64 JobRunner::start(const QString& kind, const QString& title, Work work, Finish finish) {
  cancelKind(kind);
  const quint64 id = nextId_++;
  infos_.push_back({id, kind, title, JobState::Queued, {}, {}});
  forgetOld();
  {
    std::lock_guard lock(mutex_);
    queue_.push_back(std::make_shared<Task>(this, id, kind, std::move(work), std::move(finish)));
  }
  wake_.notify_one();
  Q_EMIT changed(id);
  return id;
}

void JobRunner::cancel(quint64 id) {
  std::shared_ptr<Task> dropped;
  {
    std::lock_guard lock(mutex_);
    for (const auto& task : running_)
      if (task->id == id) task->job.cancel();
    const auto found = std::find_if(queue_.begin(), queue_.end(), [&](const auto& t) { return t->id == id; });
    if (found != queue_.end()) {
      dropped = *found;
      queue_.erase(found);
    }
  }
  if (dropped) conclude(dropped, JobState::Cancelled, {});
}

void JobRunner::cancelKind(const QString& kind) {
  std::vector<quint64> same;
  for (const JobInfo& each : infos_)
    if (each.kind == kind && !each.over()) same.push_back(each.id);
  for (const quint64 id : same) cancel(id);
}

void JobRunner::pause(quint64 id) {
  std::lock_guard lock(mutex_);
  for (const auto& task : running_)
    if (task->id == id) {
      task->job.pause();
      info(id)->state = JobState::Paused;
      QMetaObject::invokeMethod(this, [this, id] { Q_EMIT changed(id); }, Qt::QueuedConnection);
    }
}

void JobRunner::resume(quint64 id) {
  std::lock_guard lock(mutex_);
  for (const auto& task : running_)
    if (task->id == id) {
      task->job.resume();
      info(id)->state = JobState::Running;
      QMetaObject::invokeMethod(this, [this, id] { Q_EMIT changed(id); }, Qt::QueuedConnection);
    }
}

const JobInfo* JobRunner::find(quint64 id) const { return const_cast<JobRunner*>(this)->info(id); }

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
      return std::none_of(running_.begin(), running_.end(), [&](const auto& t) { return t->kind == waiting->kind; });
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
  QMetaObject::invokeMethod(this, [this, id = task->id] {
    if (JobInfo* job = info(id); job && job->state == JobState::Queued) job->state = JobState::Running;
    Q_EMIT changed(id);
  }, Qt::QueuedConnection);

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
  QMetaObject::invokeMethod(this, [this, task, state, error] { conclude(task, state, error); }, Qt::QueuedConnection);
}

void JobRunner::report(quint64 id, const Progress& progress) {
  QMetaObject::invokeMethod(this, [this, id, progress] {
    if (JobInfo* job = info(id); job && !job->over()) {
      job->progress = progress;
      Q_EMIT changed(id);
    }
  }, Qt::QueuedConnection);
}

void JobRunner::conclude(const std::shared_ptr<Task>& task, JobState state, const QString& error) {
  JobInfo* job = info(task->id);
  if (!job) return;
  job->state = state;
  job->error = error;
  const JobInfo copy = *job;
  Q_EMIT changed(copy.id);
  if (task->finish) task->finish(copy);
  Q_EMIT finished(copy.id);
}

JobInfo* JobRunner::info(quint64 id) {
  const auto found = std::find_if(infos_.begin(), infos_.end(), [id](const JobInfo& each) { return each.id == id; });
  return found == infos_.end() ? nullptr : &*found;
}

void JobRunner::forgetOld() {
  while (infos_.size() > kRemembered) {
    const auto over = std::find_if(infos_.begin(), infos_.end(), [](const JobInfo& each) { return each.over(); });
    if (over == infos_.end()) return;
    infos_.erase(over);
  }
}

}  // namespace prt::ui
