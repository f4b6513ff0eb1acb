#include "libprt/core/job.h"

#include "libprt/core/error.h"

#include <utility>

namespace prt {

Job::Job(Listener listener, double listenerHz)
    : listener_(std::move(listener)),
      minInterval_(
          std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / listenerHz))) {}

void Job::begin(std::string phase, double total, std::string unit, double done) {
  {
    std::lock_guard lock(mutex_);
    phase_ = std::move(phase);
    unit_ = std::move(unit);
    done_ = before_ = done;
    total_ = total;
    begun_ = Clock::now();
  }
  notify(true);
}

void Job::progress(double done, double total) {
  done_ = done;
  total_ = total;
  notify(total > 0 && done >= total);
}

void Job::advance(double amount) {
  double done = done_.load(std::memory_order_relaxed);
  while (!done_.compare_exchange_weak(done, done + amount, std::memory_order_relaxed)) {
  }
  const double total = total_.load(std::memory_order_relaxed);
  notify(total > 0 && done < total && done + amount >= total);
}

Progress Job::snapshot() const {
  std::lock_guard lock(mutex_);
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  return {phase_, done_.load(), total_.load(), unit_, seconds, before_.load()};
}

void Job::checkCancelled() {
  if (paused_.load(std::memory_order_relaxed)) {
    std::unique_lock lock(mutex_);
    resumed_.wait(lock, [this] { return !paused_ || cancelled_; });
  }
  if (cancelled()) throw Cancelled();
}

void Job::cancel() noexcept {
  cancelled_ = true;
  std::lock_guard lock(mutex_);
  resumed_.notify_all();
}

void Job::pause() {
  paused_ = true;
}

void Job::resume() {
  paused_ = false;
  std::lock_guard lock(mutex_);
  resumed_.notify_all();
}

void Job::notify(bool always) {
  if (!listener_) return;
  {
    std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (!always && now - lastNotified_ < minInterval_) return;
    lastNotified_ = now;
  }
  std::lock_guard lock(listenerMutex_);
  listener_(snapshot());
}

}  // namespace prt
