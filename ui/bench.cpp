#include "ui/bench.h"

#include "libprt/core/error.h"
#include "ui/bench_bakes.h"
#include "ui/bench_charts.h"
#include "ui/bench_hand.h"
#include "ui/main_window.h"
#include "ui/model/session.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/parameter_slider.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QScrollArea>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

namespace prt::ui {

namespace {

constexpr QSize kViewport(1280, 720);
constexpr double kPatienceForFrame = 5;         // seconds
constexpr double kFrameOfScreen = 1000.0 / 60;  // milliseconds: no hand is faster than the screen
constexpr int kRaysOfLongBake = 1 << 20;

// Milliseconds of processor time that this program has used.
double cpuMilliseconds() {
  return 1000.0 * double(std::clock()) / CLOCKS_PER_SEC;
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, std::size_t(std::ceil(part * double(values.size()))))];
}

// Times of one part of the bench, in milliseconds.
struct Times {
  std::vector<double> between, edit, draw;
  double cpu = 0;  // of all threads together
  int coarse = 0;  // frames of less than the screen's pixels

  nlohmann::json json() const {
    double sum = 0;
    for (const double t : between) sum += t;
    return {{"frames", between.size()},
            {"coarse_frames", coarse},
            {"fps", sum > 0 ? 1000 * double(between.size()) / sum : 0},
            {"median_ms", quantile(between, 0.5)},
            {"p95_ms", quantile(between, 0.95)},
            {"p99_ms", quantile(between, 0.99)},
            {"worst_ms", quantile(between, 1)},
            {"cpu_ms", between.empty() ? 0 : cpu / double(between.size())},
            {"edit_ms", quantile(edit, 0.5)},
            {"draw_ms", quantile(draw, 0.5)}};
  }
};

// How the hand moves: to and fro, no two places after each other the same.
struct Swing {
  int reach = 40, step = 4;  // steps to one side, and pixels of a step
  int clear = 8;             // pixels, beyond what counts as a click

  int offset(int move) const {
    const int at = move % (2 * reach);
    return clear + step * (at < reach ? at : 2 * reach - at);
  }
};

class Bench {
 public:
  Bench(MainWindow& window, Session& session) : window_(window), session_(session), hand_(window, session) {
    session.project().setQuestion([](const Unsaved&) { return LeaveAnswer{Leave::Discard, {}}; });
  }

  nlohmann::json run(const BenchOptions& options) {
    nlohmann::json out;
    QElapsedTimer opening;
    opening.start();
    session_.open(options.input);
    hand_.waitFor([this] { return session_.relighter().transfer() != nullptr; });
    const double firstPicture = double(opening.nsecsElapsed()) * 1e-6;
    fitViewport();
    if (options.charts) {
      out.update(measureCharts(hand_));
      session_.project().giveUp();
      return out;
    }
    hand_.edit({{"transfer.kind", "auto"},
                {"transfer.rays", "32"},
                {"transfer.bounces", "1"},
                {"material.model", "lambert"}});
    bake();
    const qreal scale = window_.viewport().devicePixelRatioF();
    out["viewport"] = {std::lround(window_.viewport().width() * scale),
                       std::lround(window_.viewport().height() * scale)};
    out["drawing"] = window_.viewport().canvas().describe().toStdString();
    out["vertices"] = session_.relighter().scene()->mesh.vertexCount();
    out["open_to_first_preview_ms"] = firstPicture;
    out["light_drag"] = dragInView(Qt::LeftButton, Qt::ShiftModifier, options.frames, false);
    hand_.edit({{"transfer.kind", "matrix"},
                {"material.model", "phong"},
                {"material.specular", "0.3"},
                {"material.exponent", "40"}});
    bake();
    out["light_drag_glossy"] = dragInView(Qt::LeftButton, Qt::ShiftModifier, options.frames, false);
    out["exponent_slide"] = slideExponent(options.frames);
    out["orbit"] = dragInView(Qt::MiddleButton, Qt::NoModifier, options.frames, false);
    hand_.edit({{"transfer.rays", std::to_string(kRaysOfLongBake)}});
    session_.bakes().bake();
    hand_.waitFor([this] { return session_.relighter().transfer() && session_.bakes().baking(); });
    out["while_baking"] = dragInView(Qt::LeftButton, Qt::ShiftModifier, 4 * options.frames, true);
    session_.bakes().cancel();
    out.update(measureBakes(hand_));
    session_.project().giveUp();
    return out;
  }

 private:
  // Other sizes would be other work: the window gets whatever it needs around this viewport.
  void fitViewport() {
    const QSize wanted = kViewport / window_.viewport().devicePixelRatioF();
    window_.setMinimumSize(0, 0);
    window_.showNormal();
    for (int i = 0; i < 3; ++i) {
      window_.resize(window_.size() + wanted - window_.viewport().size());
      for (int j = 0; j < 20; ++j) QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
    }
  }

  void bake() {
    session_.bakes().bake();
    hand_.waitFor([this] { return session_.bakes().fresh() && session_.jobs().idle(); });
  }

  // Presses in the middle of a widget, moves to and fro, releases; a new move as soon as the picture of the
  // last one is on the screen, or at the screen's pace. Every move must change the picture.
  Times drag(QWidget& widget, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, const Swing& swing,
             int frames, bool paced) {
    Canvas& canvas = window_.viewport().canvas();
    const QPoint from = widget.mapTo(&window_, widget.rect().center());
    hand_.send(QEvent::MouseButtonPress, from, button, modifiers);
    Times times;
    QElapsedTimer clock;
    clock.start();
    double last = -1, cpuBefore = 0;
    for (int i = -kWarming; i < frames; ++i) {
      if (i == 0) cpuBefore = cpuMilliseconds();
      const quint64 before = canvas.frames();
      const double sent = double(clock.nsecsElapsed()) * 1e-6;
      hand_.send(QEvent::MouseMove, from + QPoint(swing.offset(i + kWarming + 1), 0), button, modifiers);
      const double handled = double(clock.nsecsElapsed()) * 1e-6 - sent;
      hand_.waitFor([&] { return canvas.frames() > before; }, kPatienceForFrame);
      const double now = double(clock.nsecsElapsed()) * 1e-6;
      if (i >= 0) {
        times.between.push_back(now - last);
        times.edit.push_back(handled);
        times.draw.push_back(canvas.frameMilliseconds());
        times.coarse += canvas.coarse();
      }
      last = now;
      if (paced) hand_.waitFor([&] { return double(clock.nsecsElapsed()) * 1e-6 >= sent + kFrameOfScreen; });
    }
    times.cpu = cpuMilliseconds() - cpuBefore;
    hand_.send(QEvent::MouseButtonRelease, from, button, modifiers);
    return times;
  }

  nlohmann::json dragInView(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, int frames, bool paced) {
    return drag(window_.viewport(), button, modifiers, {}, frames, paced).json();
  }

  // A step is a pixel or two: beyond the ends of the slider nothing would change any more.
  nlohmann::json slideExponent(int frames) {
    const QString path = QStringLiteral("objects[0].material.exponent");
    window_.bringToFront(QStringLiteral("material"));
    auto* slider = window_.findChild<ParameterSlider*>(path + QStringLiteral(" slider"));
    if (!slider) throw ResourceError("there is no slider for the exponent", "bench", {});
    for (QWidget* each = slider; each; each = each->parentWidget())
      if (auto* area = qobject_cast<QScrollArea*>(each)) area->ensureWidgetVisible(slider);
    return drag(*slider, Qt::LeftButton, Qt::NoModifier, {.reach = 14, .step = 2, .clear = 0}, frames, false)
        .json();
  }

  static constexpr int kWarming = 5;  // frames that are not counted

  MainWindow& window_;
  Session& session_;
  BenchHand hand_;
};

}  // namespace

int runBench(MainWindow& window, Session& session, const BenchOptions& options) {
  try {
    std::printf("%s\n", Bench(window, session).run(options).dump(2).c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "prt-studio: %s\n", error.what());
    return 1;
  }
}

}  // namespace prt::ui
