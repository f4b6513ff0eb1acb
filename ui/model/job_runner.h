#pragma once
// Runs the library's long functions behind the interface. Work happens on threads of low priority;
// everything that a widget sees arrives by signals on the thread that owns the runner, as values or
// immutable shared products.

#include "libprt/core/job.h"

#include <QElapsedTimer>
#include <QObject>
#include <QString>

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace prt::ui {

/// Cancelling: it was told to stop and has not yet.
enum class JobState { Queued, Running, Paused, Cancelling, Done, Cancelled, Failed };

/// What there is to know about one job.
struct JobInfo {
  quint64 id = 0;
  QString kind;   ///< jobs of one kind run one after another
  QString title;  ///< for people
  JobState state = JobState::Queued;
  Progress progress;   ///< its seconds without pauses
  QString error;       ///< of a failed job
  bool quiet = false;  ///< of no interest to people unless it fails

  bool over() const { return state >= JobState::Done; }

  QElapsedTimer pause = {};  ///< valid while it is paused
  double paused = 0;         ///< seconds of pauses in this phase
};

class JobRunner : public QObject {
  Q_OBJECT
 public:
  using Work = std::function<void(Job&)>;
  /// Called on the runner's thread when the work ended, unless the runner is gone.
  using Finish = std::function<void(const JobInfo&)>;

  /// `threads`: jobs that run, or are paused, at a time. Each uses all cores where it can.
  explicit JobRunner(int threads = 4, QObject* parent = nullptr);
  /// Cancels everything and waits for it: at most as long as the library takes to react.
  ~JobRunner() override;
  /// The same, early; nothing can be started after it.
  void stop();

  /// Queues work. A job of the same kind that waits is dropped and one that runs is cancelled: the newest
  /// request is the one that counts.
  quint64 start(const QString& kind, const QString& title, Work work, Finish finish = {});
  /// The same for what the interface does for itself (thumbnails): not listed for people unless it fails.
  quint64 startQuietly(const QString& kind, const QString& title, Work work, Finish finish = {});

  /// What waits ends at once, what runs as soon as it notices.
  void cancel(quint64 id);
  void cancelKind(const QString& kind);
  /// What waits stays waiting, what runs stops where it is and keeps its memory.
  void pause(quint64 id);
  void resume(quint64 id);
  /// Whether a failed job can be tried again: nothing of its kind was asked for since.
  bool canRetry(quint64 id) const;
  /// Starts it again as a new job; 0 when it cannot.
  quint64 retry(quint64 id);

  /// The jobs that wait or run, and the last few that are over; oldest first.
  const std::vector<JobInfo>& jobs() const { return infos_; }
  const JobInfo* find(quint64 id) const;
  bool idle() const;

 Q_SIGNALS:
  /// A job was added, progressed, or ended.
  void changed(quint64 id);
  void finished(quint64 id);
  /// A failed job goes on as another one.
  void retried(quint64 failed, quint64 id);

 private:
  struct Task;
  static constexpr std::size_t kRemembered = 20;

  std::shared_ptr<Task> taskOf(quint64 id);
  void setState(quint64 id, JobState state);
  quint64 add(JobInfo info, Work work, Finish finish);
  void workerLoop();
  std::shared_ptr<Task> takeTask();
  void run(const std::shared_ptr<Task>& task);
  void report(quint64 id, const Progress& progress);
  void conclude(const std::shared_ptr<Task>& task, JobState state, const QString& error);
  JobInfo* info(quint64 id);
  void forgetOld();

  std::mutex mutex_;  // guards queue_, running_, stopping_ and Task::held
  std::condition_variable wake_;
  std::deque<std::shared_ptr<Task>> queue_;
  std::vector<std::shared_ptr<Task>> running_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;

  // Below: only on the runner's own thread, and never under the mutex.
  std::vector<JobInfo> infos_;
  std::vector<std::shared_ptr<Task>> failed_;  // can be tried again; one of a kind
  quint64 nextId_ = 1;
};

}  // namespace prt::ui
