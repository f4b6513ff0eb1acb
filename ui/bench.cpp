#include "ui/bench.h"

#include "libprt/core/error.h"
#include "ui/main_window.h"
#include "ui/model/session.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/property_row.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QMouseEvent>
#include <QScrollArea>
#include <QWindow>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <vector>

namespace prt::ui {

namespace {

constexpr QSize kViewport(1280, 720);
constexpr double kPatience = 300;               // seconds for anything to be read or baked
constexpr double kFrameOfScreen = 1000.0 / 60;  // milliseconds: no hand is faster than the screen
constexpr int kPassesOfLongBake = 1 << 20;

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

  nlohmann::json json() const {
    double sum = 0;
    for (const double t : between) sum += t;
    return {{"frames", between.size()},
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

class Bench {
 public:
  Bench(MainWindow& window, Session& session) : window_(window), session_(session) {
    QObject::connect(&session, &Session::message, &window,
                     [this](Severity severity, const QString& text, Place) {
                       if (severity == Severity::Error && problem_.isEmpty()) problem_ = text;
                     });
  }

  nlohmann::json run(const BenchOptions& options) {
    session_.open(options.input);
    waitFor([this] { return session_.relighter().scene() != nullptr; });
    fitViewport();
    nlohmann::json out;
    edit({{"transfer.kind", "auto"},
          {"transfer.rays", "32"},
          {"transfer.bounces", "1"},
          {"material.model", "lambert"}});
    bake();
    const qreal scale = window_.viewport().devicePixelRatioF();
    out["viewport"] = {std::lround(window_.viewport().width() * scale),
                       std::lround(window_.viewport().height() * scale)};
    out["drawing"] = window_.viewport().canvas().describe().toStdString();
    out["vertices"] = session_.relighter().scene()->mesh.vertexCount();
    out["light_drag"] = dragInView(Qt::LeftButton, Qt::ShiftModifier, options.frames, false);
    edit({{"transfer.kind", "matrix"},
          {"material.model", "phong"},
          {"material.specular", "0.3"},
          {"material.exponent", "40"}});
    bake();
    out["light_drag_glossy"] = dragInView(Qt::LeftButton, Qt::ShiftModifier, options.frames, false);
    out["exponent_slide"] = slideExponent(options.frames);
    out["orbit"] = dragInView(Qt::MiddleButton, Qt::NoModifier, options.frames, false);
    edit({{"transfer.rays", std::to_string(kPassesOfLongBake)}});
    session_.bakes().bake();
    waitFor([this] { return session_.relighter().transfer() && session_.bakes().baking(); });
    out["while_baking"] = dragInView(Qt::LeftButton, Qt::ShiftModifier, 4 * options.frames, true);
    session_.bakes().cancel();
    return out;
  }

 private:
  void waitFor(const std::function<bool()>& done) {
    QElapsedTimer timer;
    timer.start();
    while (!done()) {
      if (!problem_.isEmpty()) throw ResourceError(problem_.toStdString(), "bench", {});
      if (timer.elapsed() > 1000 * kPatience)
        throw ResourceError("the scene was not ready in time", "bench", "use a smaller one");
      QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 20);
    }
  }

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

  void edit(std::initializer_list<std::pair<const char*, std::string>> values) {
    Recipe next = session_.document().recipe();
    for (const auto& [path, value] : values) setByPath(next, path, value);
    session_.document().edit(QStringLiteral("Bench"), next);
  }

  void bake() {
    session_.bakes().bake();
    waitFor([this] { return session_.bakes().fresh() && session_.jobs().idle(); });
  }

  void send(QEvent::Type type, const QPoint& at, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
    QWindow* handle = window_.windowHandle();
    const bool move = type == QEvent::MouseMove, release = type == QEvent::MouseButtonRelease;
    QMouseEvent event(type, at, handle->mapToGlobal(QPointF(at)), move ? Qt::NoButton : button,
                      release ? Qt::NoButton : Qt::MouseButtons(button), modifiers);
    QCoreApplication::sendEvent(handle, &event);
  }

  // Presses in the middle of a widget, moves to and fro, releases; a new move as soon as the picture of the
  // last one is on the screen, or at the screen's pace.
  Times drag(QWidget& widget, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, int frames,
             bool paced) {
    Canvas& canvas = window_.viewport().canvas();
    const QPoint from = widget.mapTo(&window_, widget.rect().center());
    send(QEvent::MouseButtonPress, from, button, modifiers);
    Times times;
    QElapsedTimer clock;
    clock.start();
    double last = -1, cpuBefore = 0;
    for (int i = -kWarming; i < frames; ++i) {
      const int swing = (i + kWarming + 1) % (2 * kReach),
                offset = swing < kReach ? swing : 2 * kReach - swing;
      if (i == 0) cpuBefore = cpuMilliseconds();
      const quint64 before = canvas.frames();
      const double sent = double(clock.nsecsElapsed()) * 1e-6;
      send(QEvent::MouseMove, from + QPoint(kStep * offset + kClear, 0), button, modifiers);
      const double handled = double(clock.nsecsElapsed()) * 1e-6 - sent;
      waitFor([&] { return canvas.frames() > before; });
      const double now = double(clock.nsecsElapsed()) * 1e-6;
      if (i >= 0) {
        times.between.push_back(now - last);
        times.edit.push_back(handled);
        times.draw.push_back(canvas.frameMilliseconds());
      }
      last = now;
      while (paced && double(clock.nsecsElapsed()) * 1e-6 < sent + kFrameOfScreen)
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 1);
    }
    times.cpu = cpuMilliseconds() - cpuBefore;
    send(QEvent::MouseButtonRelease, from, button, modifiers);
    return times;
  }

  nlohmann::json dragInView(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, int frames, bool paced) {
    return drag(window_.viewport(), button, modifiers, frames, paced).json();
  }

  nlohmann::json slideExponent(int frames) {
    auto* row = window_.findChild<PropertyRow*>(QStringLiteral("objects[0].material.exponent"));
    window_.bringToFront(QStringLiteral("material"));
    for (QWidget* each = row; each; each = each->parentWidget())
      if (auto* area = qobject_cast<QScrollArea*>(each)) area->ensureWidgetVisible(row);
    if (!row) throw ResourceError("there is no row for the exponent", "bench", {});
    return drag(*row->editor(), Qt::LeftButton, Qt::NoModifier, frames, false).json();
  }

  static constexpr int kWarming = 5;  // frames that are not counted
  static constexpr int kReach = 40, kStep = 4,
                       kClear = 8;  // of the hand: steps, and pixels; beyond what counts as a click

  MainWindow& window_;
  Session& session_;
  QString problem_;
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
