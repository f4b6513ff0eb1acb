#include "ui/bench_bakes.h"

#include "ui/bench_hand.h"
#include "ui/docks/jobs_dock.h"
#include "ui/main_window.h"
#include "ui/model/session.h"
#include "ui/viewport/viewport.h"

#include <QAbstractButton>
#include <QElapsedTimer>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace prt::ui {

namespace {

// When the button is clicked. A bake of rays without end is cancelled so many milliseconds after its first
// preview; one of few rays so many after it has begun to write what they gave.
struct Moment {
  int rays;
  double after;
};
constexpr int kEndless = 1 << 20, kFew = 64;
constexpr Moment kMoments[] = {{kEndless, 0}, {kEndless, 700}, {kEndless, 5300},  // writing a checkpoint
                               {kFew, 0},     {kFew, 40},      {kFew, 150},      {kFew, 300}};

double milliseconds(const QElapsedTimer& timer) {
  return 1e-6 * double(timer.nsecsElapsed());
}

QAbstractButton* cancelButton(JobsDock& dock) {
  for (auto* each : dock.findChildren<QAbstractButton*>(QStringLiteral("cancelJob")))
    if (each->isVisible()) return each;
  return nullptr;
}

// Calls back whenever transfer arrives, for as long as it lives.
class Arrival {
 public:
  template <class Call>
  Arrival(const BakeController& bakes, Call call)
      : connection_(QObject::connect(&bakes, &BakeController::productArrived, &bakes,
                                     [call](const QString& stage, const ProductState&) {
                                       if (stage == QStringLiteral("transfer")) call();
                                     })) {}
  ~Arrival() { QObject::disconnect(connection_); }
  Arrival(const Arrival&) = delete;

 private:
  QMetaObject::Connection connection_;
};

class BakeBench {
 public:
  BakeBench(BenchHand& hand, const char* kind) : hand_(hand), session_(hand.session()), kind_(kind) {}

  nlohmann::json run() {
    for (const Moment& moment : kMoments) bakeAndCancel(moment);
    std::sort(done_.begin(), done_.end());
    return {{"first_preview_ms", preview_},
            {"cancels", done_.size()},
            {"cancel_answered_ms", answered_},
            {"cancel_done_ms", done_.empty() ? 0 : done_.back()},
            {"cancel_done_median_ms", done_.empty() ? 0 : done_[done_.size() / 2]}};
  }

 private:
  // Another seed is another bake: nothing of the last one serves it.
  void bakeAndCancel(const Moment& moment) {
    static int seed = 1000;
    hand_.waitFor([&] { return session_.jobs().idle(); });
    // Frames drawn when the first preview arrives: the next one shows it.
    const Canvas& canvas = hand_.window().viewport().canvas();
    std::optional<quint64> shown;
    const Arrival arrival(session_.bakes(), [&] {
      if (!shown) shown = canvas.frames();
    });
    QElapsedTimer timer;
    timer.start();
    hand_.edit({{"transfer.kind", kind_},
                {"transfer.rays", std::to_string(moment.rays)},
                {"transfer.seed", std::to_string(++seed)}});
    session_.bakes().bake();
    if (moment.rays == kEndless) {
      hand_.waitFor([&] { return shown && canvas.frames() > *shown; });
      preview_ = std::max(preview_, milliseconds(timer));
    } else {
      hand_.waitFor([this] { return writing() || !session_.bakes().baking(); });
    }
    hand_.pass(moment.after);
    cancel();
  }

  // The last and largest product of the bake.
  bool writing() {
    const JobInfo* job = session_.jobs().find(session_.bakes().job());
    if (!job || job->progress.phase != "writing") return false;
    const auto& stages = session_.bakes().stageInfos();
    return std::any_of(stages.begin(), stages.end(), [](const StageInfo& stage) {
      return stage.name == QStringLiteral("transfer") && stage.status == ProductStatus::Baking;
    });
  }

  void cancel() {
    auto& dock = *hand_.window().findChild<JobsDock*>();
    const quint64 job = session_.bakes().job();
    QAbstractButton* button = cancelButton(dock);
    if (!job || !button) return;  // it was over before
    QElapsedTimer timer;
    timer.start();
    hand_.click(*button);
    dock.repaint();
    answered_ = std::max(answered_, milliseconds(timer));
    hand_.waitFor([&] { return session_.jobs().find(job)->over(); });
    done_.push_back(milliseconds(timer));
  }

  BenchHand& hand_;
  Session& session_;
  const char* kind_;
  double preview_ = 0, answered_ = 0;
  std::vector<double> done_;
};

}  // namespace

nlohmann::json measureBakes(BenchHand& hand) {
  hand.window().bringToFront(QStringLiteral("jobs"));
  return {{"bake_diffuse", BakeBench(hand, "diffuse").run()},
          {"bake_glossy", BakeBench(hand, "matrix").run()}};
}

}  // namespace prt::ui
