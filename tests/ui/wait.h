#pragma once
// Lets events happen until something is true.

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QThread>

namespace prt::test {

template <class Condition>
bool waitFor(Condition condition, int milliseconds = 60000) {
  QElapsedTimer timer;
  for (timer.start(); timer.elapsed() < milliseconds;) {
    if (condition()) return true;
    QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
    QThread::msleep(1);
  }
  return condition();
}

/// Lets events happen for a while.
inline void pass(int milliseconds) {
  waitFor([] { return false; }, milliseconds);
}

}  // namespace prt::test
