#include "ui/model/autosave.h"

#include "libprt/core/error.h"

#include <utility>

namespace prt::ui {

Autosave::Autosave(Document& document, std::function<bool()> needed, QObject* parent)
    : QObject(parent), document_(document), needed_(std::move(needed)) {
  writer_.setMaxThreadCount(1);
  timer_.setInterval(10'000);
  connect(&timer_, &QTimer::timeout, this, &Autosave::write);
  connect(&document_, &Document::stateChanged, this, [this] { dirty_ = true; });
  connect(&document_, &Document::recipeChanged, this, [this] { dirty_ = true; });
  timer_.start();
}

Autosave::~Autosave() {
  writer_.waitForDone();
}

void Autosave::setPlace(std::shared_ptr<const RecoveryPlace> place) {
  writer_.waitForDone();
  place_ = std::move(place);
  holding_ = place_ && place_->read().has_value();
  dirty_ = true;
}

void Autosave::setMilliseconds(int milliseconds) {
  milliseconds > 0 ? timer_.start(milliseconds) : timer_.stop();
}

void Autosave::flush() {
  write();
  writer_.waitForDone();
}

RecoveryEntry Autosave::entry() const {
  return {document_.path(),           document_.title(), QDateTime::currentDateTime(),
          document_.editsSinceSave(), document_.saved(), document_.recipe()};
}

void Autosave::write() {
  if (!place_ || document_.inGesture()) return;
  const bool needed = needed_();
  if (needed == holding_ && !(needed && dirty_)) return;
  dirty_ = false;
  holding_ = needed;
  if (!needed) return writer_.start([place = place_] { place->forget(); });
  const QByteArray picture = thumbnail_ ? thumbnail_() : QByteArray();
  writer_.start([this, place = place_, state = entry(), picture] {
    QString problem;
    try {
      place->keep(state, picture);
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    // The destructor waits for this thread: `this` is there.
    QMetaObject::invokeMethod(
        this,
        [this, problem] {
          if (problem.isEmpty())
            Q_EMIT kept();
          else
            Q_EMIT failed(problem);
        },
        Qt::QueuedConnection);
  });
}

}  // namespace prt::ui
