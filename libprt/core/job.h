#pragma once
// Long work: progress, cancellation and pause, passed by reference to every function that may take
// longer than a frame. One Job belongs to one task; any thread may cancel, pause or watch it.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>

namespace prt {

/// A snapshot of a job. `done` and `total` count in `unit` ("rays", "vertices", "bytes").
struct Progress {
  std::string phase;
  double done = 0;
  double total = 0;  ///< 0 = not known
  std::string unit;
  double seconds = 0;  ///< since the phase began, pauses included
  double before = 0;   ///< of `done`, what was there when the phase began

  double fraction() const { return total > 0 ? done / total : 0; }
  double rate() const { return seconds > 0 ? (done - before) / seconds : 0; }
  /// Seconds left at the rate so far; negative when it is not known.
  double secondsLeft() const {
    return done > before && total > 0 ? (total - done) / (done - before) * seconds : -1;
  }
};

class Job {
 public:
  using Listener = std::function<void(const Progress&)>;

  Job() = default;
  /// The listener is called from worker threads, one call at a time, at most `listenerHz` times a
  /// second and always when a phase begins and ends. It must not throw and must not block.
  explicit Job(Listener listener, double listenerHz = 20);
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Starts a phase of `total` units of work; ends the one before. `done` of them were done earlier.
  void begin(std::string phase, double total, std::string unit = {}, double done = 0);
  /// Sets the work done in this phase. Thread-safe.
  void progress(double done, double total);
  /// Adds to the work done in this phase. Thread-safe, cheap enough to call once a tile.
  void advance(double amount);
  Progress snapshot() const;

  /// Throws Cancelled when the job was cancelled; waits here while it is paused. Work must call it
  /// at least every 50 ms.
  void checkCancelled();
  void cancel() noexcept;
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

  void pause();
  void resume();
  bool paused() const noexcept { return paused_.load(std::memory_order_relaxed); }

 private:
  void notify(bool always);

  using Clock = std::chrono::steady_clock;
  Listener listener_;
  Clock::duration minInterval_{};
  mutable std::mutex mutex_;  // guards phase_, unit_, begun_, lastNotified_
  std::mutex listenerMutex_;  // one listener call at a time
  std::condition_variable resumed_;
  std::string phase_, unit_;
  std::atomic<double> done_{0}, total_{0}, before_{0};
  Clock::time_point begun_ = Clock::now();
  Clock::time_point lastNotified_{};
  std::atomic<bool> cancelled_{false}, paused_{false};
};

}  // namespace prt
