#include "libprt/atlas/pack_layout.h"

#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"

#include <algorithm>
#include <optional>

namespace prt {
namespace {

/// All free charts in all turns at one scale.
struct Masks {
  std::vector<std::vector<PackMask>> of;  // [charts][turns]
};

class LayoutSearch {
 public:
  LayoutSearch(const PackTask& task, int cells, double work, Job& job)
      : task_(task),
        cells_(cells),
        turns_(std::clamp(task.options.turns >= kMany ? 2 * task.options.turns : task.options.turns, 1, 64)),
        work_(work),
        job_(job),
        empty_(task.grid(cells)) {}

  PackLayout run(const PackLayout* start) {
    if (start)
      start_ = start, best_ = *start;
    else
      bisect();
    if (best_.part > 0) grow();
    return best_;
  }

 private:
  static constexpr std::size_t kChains = 4;  // however many threads there are
  static constexpr int kPatience = 4;        // rounds
  static constexpr int kMany = 8;            // turns: fewer are meant to be those alone
  static constexpr double kNone = 1e300;
  static constexpr double kChance = 0.2;

  /// The order by area alone, over the scale.
  void bisect() {
    double fits = 0, fails = 0.95 - task_.lockedArea, next = std::min(0.75, 0.9 * fails);
    for (int round = 0; round < 8; ++round) {
      if (tryPart(next))
        fits = next;
      else
        fails = next;
      next = fits > 0 ? 0.5 * (fits + fails) : next * 0.85;
      if (fits > 0 && fails - fits < 0.01) break;
    }
    for (int round = 0; best_.part == 0 && round < 40; ++round, next *= 0.7) tryPart(next);
  }

  /// Chains of orders: what found no place comes earlier, and when all fit, all grow.
  void grow() {
    std::vector<std::vector<std::uint32_t>> orders(kChains, best_.order);
    const double share = work_ / double(task_.free.size() * kChains);
    const int most = int((task_.free.size() < 16 ? 8 : 24) * task_.options.effort);
    const int rounds = std::clamp(int(share), 1, most);
    double step = 0.02;
    int failures = 0;
    for (int round = 0; round < rounds && step > 0.002; ++round) {
      const double part = best_.part * (1 + step);
      if (part > 0.98) {
        step *= 0.5;
        continue;
      }
      makeMasks(part);
      std::vector<std::optional<std::vector<PackSpot>>> found(kChains);
      parallelFor(job_, 0, kChains, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k)
          found[k] = advance(orders[k], std::uint32_t(round) * kChains + std::uint32_t(k));
      });
      bool better = false;
      for (std::size_t k = 0; k < kChains && !better; ++k)
        if (found[k]) {
          best_ = {part, cells_, std::move(*found[k]), orders[k]};
          std::fill(orders.begin(), orders.end(), std::vector<std::uint32_t>(orders[k]));
          better = true;
        }
      failures = better ? 0 : failures + 1;
      if (failures >= kPatience) step *= 0.6, failures = 0;
    }
  }

  void makeMasks(double part) {
    if (part == maskedPart_) return;
    maskedPart_ = part;
    masks_.of.assign(task_.charts.size(), {});
    const double scale = task_.scaleOf(part), margin = task_.margin(cells_);
    parallelFor(job_, 0, task_.free.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const std::uint32_t c = task_.free[i];
        masks_.of[c].reserve(std::size_t(turns_));
        for (int t = 0; t < turns_; ++t)
          masks_.of[c].push_back(makeMask(task_.turned(c, scale, angleOf(c, t), cells_), margin)),
              prepareSearch(masks_.of[c].back());
      }
    });
  }

  double angleOf(std::uint32_t chart, int turn) const {
    return task_.angles[chart] + 2 * kPi * double(turn) / double(turns_);
  }

  /// Whether the order by area fits; keeps it then.
  bool tryPart(double part) {
    makeMasks(part);
    std::uint32_t left = 0;
    auto spots = layOut(task_.free, 0, 0, left);
    if (spots) best_ = {part, cells_, std::move(*spots), task_.free};
    return spots.has_value();
  }

  /// A layout in an order; without one the chart that had no place moves ahead.
  std::optional<std::vector<PackSpot>> advance(std::vector<std::uint32_t>& order,
                                               std::uint32_t number) const {
    constexpr double kSnugness[] = {0, 0.2, 0.5, 1.0};
    std::uint32_t left = 0;
    auto spots = layOut(order, kSnugness[number % kChains], number, left);
    if (!spots && left > 0) {
      const auto to = std::uint32_t(hashUniform(5, number) * double(left));
      std::rotate(order.begin() + to, order.begin() + left, order.begin() + left + 1);
    } else if (!spots && order.size() > 1) {  // the first one: any other may come before
      std::swap(order[0], order[1 + std::size_t(hashUniform(6, number) * double(order.size() - 1))]);
    }
    return spots;
  }

  /// On fine cells only some turns: about that on the coarse ones, and others by chance.
  bool tries(std::uint32_t chart, int turn, std::uint32_t number) const {
    if (!start_) return true;
    const double away = std::abs(std::remainder(angleOf(chart, turn) - start_->spots[chart].angle, 2 * kPi));
    return away < 2.1 * kPi / turns_ || hashUniform(8, number, std::uint32_t(turn) * 65536 + chart) < kChance;
  }

  struct Place {
    const PackMask* mask = nullptr;
    double angle = 0;
    int x = 0, y = 0;
    double score = kNone;  // less is better
  };

  /// Takes a turn's lowest place when it is better.
  void offer(const PackGrid& grid, const PackMask& mask, double angle, double snugness, Place& best) const {
    // No further up than a better score could still be.
    const double reach = (best.score + snugness) * cells_ - 0.5 * mask.height;
    const int limit = reach >= cells_ ? cells_ : int(reach) + 1 + mask.height;
    int x = 0, y = 0;
    if (limit < mask.height || !grid.find(mask, limit, x, y)) return;
    double score = (y + 0.5 * mask.height + 1e-3 * x) / cells_;
    if (snugness > 0) score -= snugness * grid.contact(mask, x, y);
    if (score < best.score) best = {&mask, angle, x, y, score};
  }

  /// `snugness`: what touching others all around is worth, in heights of the square. `left`: place in the
  /// order of the first chart that found no place.
  std::optional<std::vector<PackSpot>> layOut(const std::vector<std::uint32_t>& order, double snugness,
                                              std::uint32_t number, std::uint32_t& left) const {
    PackGrid grid = empty_;
    std::vector<PackSpot> spots(task_.charts.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      const std::uint32_t c = order[i];
      job_.checkCancelled();
      Place best;
      for (int t = 0; t < turns_; ++t)
        if (tries(c, t, number)) offer(grid, masks_.of[c][std::size_t(t)], angleOf(c, t), snugness, best);
      if (best.score == kNone) {
        left = i;
        return std::nullopt;
      }
      grid.place(*best.mask, best.x, best.y);
      spots[c] = {best.angle, best.x, best.y};
    }
    return spots;
  }

  const PackTask& task_;
  int cells_, turns_;
  double work_;
  Job& job_;
  PackGrid empty_;
  Masks masks_;
  double maskedPart_ = -1;
  const PackLayout* start_ = nullptr;
  PackLayout best_;
};

}  // namespace

std::vector<DVec2> PackTask::turned(std::uint32_t chart, double scale, double angle, int cells) const {
  std::vector<DVec2> outline;
  outline.reserve(charts[chart].outline.size());
  const double s = scale * relative[chart] * cells, cosine = std::cos(angle) * s, sine = std::sin(angle) * s;
  for (const DVec2& p : charts[chart].outline)
    outline.emplace_back(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y);
  return outline;
}

double PackTask::margin(int cells) const {
  const double texels = options.gutter + (options.size % cells == 0 ? 0.01 : 0.51);
  return texels * cells / options.size + 1e-6;
}

PackGrid PackTask::grid(int cells) const {
  PackGrid grid(cells);
  for (std::uint32_t c = 0; c < locked.size(); ++c) {
    if (!locked[c].locked) continue;
    std::vector<DVec2> outline;
    for (const DVec2& p : charts[c].outline) outline.push_back(locked[c](p) * double(cells));
    const PackMask mask = makeMask(outline, margin(cells));
    // The mask begins at a whole cell; a locked chart does not: it takes one more on each side.
    const DVec2 at = -mask.origin;
    for (const int dx : {0, 1})
      for (const int dy : {0, 1}) grid.place(mask, int(std::floor(at.x)) + dx, int(std::floor(at.y)) + dy);
  }
  return grid;
}

PackLayout searchLayout(const PackTask& task, int cells, double work, Job& job, const PackLayout* start) {
  return LayoutSearch(task, cells, work, job).run(start);
}

}  // namespace prt
