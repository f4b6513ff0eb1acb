#include "app/cli/interrupt.h"

#include <pthread.h>
#include <unistd.h>

namespace prt::cli {

Interrupt::Interrupt() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  sigaddset(&signals_, SIGUSR1);  // ends the waiting thread
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is an error of write(), not the end
  std::signal(SIGPIPE, SIG_IGN);
}

void Interrupt::watch(Job& job) {
  waiter_ = std::thread([this, &job] {
    for (int count = 0;;) {
      int number = 0;
      if (sigwait(&signals_, &number) != 0 || ending_) return;
      if (number == SIGUSR1) continue;
      if (++count > 1) _exit(130);
      job.cancel();
    }
  });
}

Interrupt::~Interrupt() {
  if (!waiter_.joinable()) return;
  ending_ = true;
  pthread_kill(waiter_.native_handle(), SIGUSR1);
  waiter_.join();
}

}  // namespace prt::cli
