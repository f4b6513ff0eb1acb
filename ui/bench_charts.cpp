#include "ui/bench_charts.h"

#include "ui/bench_hand.h"
#include "ui/main_window.h"
#include "ui/model/chart_editor.h"
#include "ui/model/session.h"

#include <QElapsedTimer>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace prt::ui {

namespace {

constexpr int kTries = 5;
constexpr const char* kDetail = "0.75";
constexpr double kTriangles = 10000;  // of the chart under the hand, as nearly as the cut has one

double milliseconds(const QElapsedTimer& timer) {
  return 1e-6 * double(timer.nsecsElapsed());
}

class ChartBench {
 public:
  explicit ChartBench(BenchHand& hand) : hand_(hand), charts_(hand.session().charts()) {}

  nlohmann::json run() {
    const auto before = hand_.session().relighter().scene();
    hand_.edit({{"mesh.path", "builtin:bird"}, {"mesh.detail", kDetail}, {"transfer.rays", "64"}});
    hand_.window().bringToFront(QStringLiteral("charts"));
    hand_.waitFor([&] { return hand_.session().relighter().scene() != before; });
    settle();
    charts_.autoCut();
    settle();
    const auto& all = charts_.charts().charts;
    if (all.empty()) return {};
    const auto off = [](const Chart& chart) { return std::abs(double(chart.faces.size()) - kTriangles); };
    const auto picked = std::min_element(all.begin(), all.end(),
                                         [&](const Chart& a, const Chart& b) { return off(a) < off(b); });
    face_ = picked->faces.front();
    const std::size_t faces = picked->faces.size();
    charts_.setCornerCount(chart(), 8);
    settle();
    charts_.beginMove(QStringLiteral("Move corner"));
    for (int i = 0; i < kTries; ++i) moveCorner();
    charts_.endMove();
    charts_.setCornerCount(chart(), 0);
    charts_.setFollowCreases(false);
    settle();
    for (int i = 0; i < kTries; ++i) cut(i);
    return {{"faces", faces},
            {"corner_edit_ms", corner_.edit},
            {"corner_start_ms", corner_.start},
            {"corner_step_ms", corner_.step},
            {"cut_edit_ms", cut_.edit},
            {"cut_start_ms", cut_.start},
            {"cut_step_ms", cut_.step}};
  }

 private:
  struct Worst {
    double edit = 0, start = 0, step = 0;
  };

  int chart() const { return charts_.chartAt(face_); }
  FlatMapPtr map() const { return charts_.items()[std::size_t(chart())].map; }
  void settle() {
    hand_.waitFor([this] { return charts_.ready() && charts_.settled() && hand_.session().jobs().idle(); });
  }

  // From an edit that has just been made: the next map, and the one after it.
  void follow(const QElapsedTimer& timer, const std::function<bool()>& begun, Worst& worst) {
    worst.edit = std::max(worst.edit, milliseconds(timer));
    hand_.waitFor(begun);
    worst.start = std::max(worst.start, milliseconds(timer));
    const FlatMapPtr first = map();
    hand_.waitFor([&] { return map() != first || charts_.settled(); });
    worst.step = std::max(worst.step, milliseconds(timer));
    hand_.waitFor([this] { return hand_.session().jobs().idle(); });
  }

  void moveCorner() {
    std::vector<std::uint32_t> corners = charts_.cornersOf(chart());
    corners[2] += 1;
    QElapsedTimer timer;
    timer.start();
    charts_.setCorners(chart(), corners, QStringLiteral("Move corner"));
    follow(
        timer, [&] { return map() && map()->corners == corners; }, corner_);
  }

  // An edge that leads in from the rim, by two clicks.
  void cut(int number) {
    const Chart& shape = charts_.charts().charts[std::size_t(chart())];
    const auto& rim = shape.loops.front();
    std::vector<bool> onRim(shape.vertices.size(), false);
    for (const std::uint32_t v : rim) onRim[v] = true;
    const std::uint32_t from = rim[std::size_t(13 * number + 5) % rim.size()];
    for (const UVec3& t : shape.triangles)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t to = t[(k + 1) % 3];
        if (t[k] != from || onRim[to]) continue;
        charts_.click(shape.vertices[from]);
        QElapsedTimer timer;
        timer.start();
        charts_.click(shape.vertices[to]);
        follow(
            timer, [&] { return map() != nullptr; }, cut_);
        return charts_.endPath();
      }
  }

  BenchHand& hand_;
  ChartEditor& charts_;
  std::uint32_t face_ = 0;
  Worst corner_, cut_;
};

}  // namespace

nlohmann::json measureCharts(BenchHand& hand) {
  return {{"charts", ChartBench(hand).run()}};
}

}  // namespace prt::ui
