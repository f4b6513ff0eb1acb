#include "libprt/atlas/auto_cut.h"

#include "libprt/atlas/arap.h"
#include "libprt/atlas/cluster_merge.h"
#include "libprt/atlas/straighten.h"
#include "libprt/atlas/untangle.h"
#include "libprt/core/error.h"
#include "libprt/core/hash.h"
#include "libprt/core/log.h"
#include "libprt/core/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>

namespace prt {
namespace {

/// Largest first, so that the last ones to finish are short.
std::vector<std::uint32_t> bySize(const Charts& charts) {
  std::vector<std::uint32_t> order(charts.charts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return charts.charts[a].faces.size() > charts.charts[b].faces.size();
  });
  return order;
}

std::size_t clusterCount(const Surface& surface, const AutoCutOptions& options) {
  if (options.clusters > 0) return options.clusters;
  return std::clamp<std::size_t>(surface.triangleCount() / 16, 24, 1500);
}

/// A first guess at a chart's flat map: each vertex where the coarse triangle of its cluster has it.
class CoarseGuess {
 public:
  CoarseGuess(const Surface& surface, const Clusters& clusters, const ClusterComplex& complex,
              const ClusterMerge& merge)
      : surface_(surface), clusters_(clusters), complex_(complex), merge_(merge) {}

  std::vector<DVec2> operator()(const Chart& chart, const FlatChart& flat, Job& job) const {
    // Triangles may have come over from a neighbour when seams were drawn tight: most of the area decides.
    std::map<std::uint32_t, double> areas;
    for (std::uint32_t f : chart.faces) areas[coarseChart(f)] += surface_.area(f);
    std::uint32_t own = areas.begin()->first;
    for (const auto& [c, area] : areas)
      if (area > areas[own]) own = c;
    const std::size_t n = flat.positions.size();
    std::vector<DVec2> guess(n, DVec2(0));
    std::vector<double> weight(n, 0.0);
    constexpr std::size_t kOften = 1024;  // some milliseconds
    for (std::size_t t = 0; t < chart.faces.size(); ++t) {
      if (t % kOften == 0) job.checkCancelled();
      if (coarseChart(chart.faces[t]) != own) continue;
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t v = chart.triangles[t][i];
        guess[v] += place(clusters_.clusterOf[chart.faces[t]], flat.positions[v]);
        weight[v] += 1;
      }
    }
    for (std::size_t v = 0; v < n; ++v)
      if (weight[v] > 0) guess[v] /= weight[v];
    spread(flat, guess, weight, job);
    return guess;
  }

 private:
  std::uint32_t coarseChart(std::uint32_t face) const {
    return merge_.chartOfCluster()[clusters_.clusterOf[face]];
  }

  /// By barycentric coordinates of the coarse triangle that holds the point best.
  DVec2 place(std::uint32_t cluster, const DVec3& p) const {
    double best = -1e300;
    DVec2 at(0);
    for (std::uint32_t t : complex_.triangles[cluster]) {
      const UVec3& c = complex_.coarse.triangles[t];
      const DVec3 a(complex_.coarse.positions[c.x]), e1 = DVec3(complex_.coarse.positions[c.y]) - a,
                                                     e2 = DVec3(complex_.coarse.positions[c.z]) - a;
      const DVec3 n = glm::cross(e1, e2), d = p - a;
      const double nn = glm::dot(n, n);
      if (!(nn > 0)) continue;
      const double u = glm::dot(glm::cross(d, e2), n) / nn, v = glm::dot(glm::cross(e1, d), n) / nn;
      const double least = std::min({u, v, 1 - u - v});
      if (least <= best) continue;
      best = least;
      const auto& uv = merge_.uvOf(t);
      at = uv[0] * (1 - u - v) + uv[1] * u + uv[2] * v;
    }
    return at;
  }

  /// Vertices without a guess take the mean of neighbours that have one, ring by ring.
  static void spread(const FlatChart& flat, std::vector<DVec2>& guess, std::vector<double>& weight,
                     Job& job) {
    while (true) {
      job.checkCancelled();
      std::vector<DVec2> sums(guess.size(), DVec2(0));
      std::vector<double> counts(guess.size(), 0.0);
      bool found = false;
      for (const auto& [a, b] : flat.edges)
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
          if (weight[from] > 0 && weight[to] == 0) sums[to] += guess[from], counts[to] += 1, found = true;
      if (!found) return;
      for (std::size_t v = 0; v < guess.size(); ++v)
        if (counts[v] > 0) guess[v] = sums[v] / counts[v], weight[v] = 1;
    }
  }

  const Surface& surface_;
  const Clusters& clusters_;
  const ClusterComplex& complex_;
  const ClusterMerge& merge_;
};

struct LaidChart {
  std::vector<DVec2> uv;
  StretchSum stretch;
  bool failed = false;
};

/// The same for every chart.
ChartOptions alike(const FlattenOptions& options) {
  return [&options](std::size_t, const FlatChart&) { return options; };
}

LaidChart layChart(const Surface& surface, const Chart& chart, std::size_t number,
                   const ChartOptions& optionsOf, const CoarseGuess* guess, double& left, Job& job) {
  LaidChart laid;
  const FlatChart flat(surface, chart, chartName(number));
  job.checkCancelled();
  FlattenOptions options = optionsOf(number, flat);
  options.name = chartName(number);
  std::vector<DVec2> start;
  if (guess && options.boundary == ChartBoundary::Free) {
    constexpr int kRounds = 8;
    start = asRigidAsPossible(flat, (*guess)(chart, flat, job), kRounds, job);
    if (!untangle(flat, start, job)) start.clear();  // from Tutte's map, which takes a little longer
  }
  // How many steps it will take nobody knows: each takes an eighth of what is left of the chart's progress.
  const auto stepDone = [&](const std::vector<DVec2>&) {
    constexpr double kPart = 0.125;
    job.advance(left * kPart);
    left -= left * kPart;
  };
  laid.uv = flatten(flat, options, job, start.empty() ? nullptr : &start, stepDone);
  laid.stretch = stretchOf(flat.positions, laid.uv, flat.triangles);
  return laid;
}

Hash128 keyOf(const Chart& chart) {
  Hasher hasher;
  hasher.add(chart.faces).add(chart.vertices).add(chart.loops[0]);
  return hasher.result();
}

/// The search on the surface itself, once the coarse one is done.
class FineCut {
 public:
  FineCut(const Surface& surface, std::span<const float> costs, const AutoCutOptions& options,
          const Clusters& clusters, const ClusterComplex& complex, ClusterMerge& merge, Job& job)
      : surface_(surface),
        costs_(costs),
        options_(options),
        clusters_(clusters),
        complex_(complex),
        merge_(merge),
        guess_(surface, clusters, complex, merge),
        job_(job) {}

  FlatCharts run() {
    do {
      cut();
      lay();
      ++round_;
    } while (cutAgain());
    FlatCharts result{seams_, std::move(charts_), {}, {}};
    for (LaidChart& chart : laid_) {
      result.uv.push_back(std::move(chart.uv));
      result.stretch.push_back(chart.stretch);
    }
    return result;
  }

 private:
  static constexpr int kPatience = 4;  // rounds in which joints are taken back one by one

  void cut() {
    seams_ = Seams(surface_);
    for (std::uint32_t a = 0; a < complex_.arcs.size(); ++a)
      if (merge_.isSeam(a))
        for (std::uint32_t e : complex_.arcs[a].edges)
          if (!surface_.isBorder(e)) seams_.set(e);
    straightenSeams(surface_, costs_, seams_, job_);
    straightenSeams(surface_, costs_, seams_, job_);
    for (std::uint32_t e : halved_) seams_.set(e);  // drawn tight they might no longer halve
    charts_ = makeDisks(surface_, seams_, costs_, job_);
  }

  void lay() {
    const std::vector<std::uint32_t> order = bySize(charts_);
    laid_.assign(order.size(), {});
    std::mutex mutex;
    job_.begin("laying charts flat", double(surface_.triangleCount()), "triangles");
    parallelFor(job_, 0, order.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Chart& chart = charts_.charts[order[i]];
        const Hash128 key = keyOf(chart);
        {
          const std::lock_guard lock(mutex);
          if (const auto found = known_.find(key); found != known_.end()) {
            laid_[order[i]] = found->second;
            job_.advance(double(chart.faces.size()));
            continue;
          }
        }
        LaidChart laid;
        double left = double(chart.faces.size());  // of its progress
        try {
          laid = layChart(surface_, chart, order[i], alike(options_.flatten), &guess_, left, job_);
        } catch (const GeometryError&) {
          laid.failed = true;
        }
        const std::lock_guard lock(mutex);
        known_[key] = laid;
        laid_[order[i]] = std::move(laid);
        job_.advance(left);
      }
    });
  }

  /// Cuts what failed or stretches too much; false when nothing needs it. Every round makes some chart
  /// smaller and a single triangle has no stretch: it ends, with the bound kept.
  bool cutAgain() {
    double energy = 0, area = 0;
    std::vector<std::pair<double, std::uint32_t>> worst;
    std::vector<std::uint32_t> again;
    for (std::uint32_t c = 0; c < laid_.size(); ++c) {
      const double chartArea = charts_.charts[c].area;
      area += chartArea;
      if (laid_[c].failed) {
        again.push_back(c);
        continue;
      }
      const double l2 = laid_[c].stretch.l2();
      energy += l2 * l2 * chartArea;
      worst.emplace_back(l2, c);
    }
    std::sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a > b; });
    double excess = energy - options_.stretch * options_.stretch * area;
    for (const auto& [l2, c] : worst) {
      if (l2 <= options_.chartStretch && !(excess > 0)) break;
      again.push_back(c);
      // Cut in two it will be as good as the mean, or half as bad; later on no more is hoped for than that.
      const double half = 0.5 * (l2 * l2 - 1);
      const double less =
          round_ > kPatience ? half : std::max(l2 * l2 - options_.stretch * options_.stretch, half);
      excess -= less * charts_.charts[c].area;
    }
    bool changed = false;
    for (std::uint32_t c : again) changed |= undo(c) || halve(c);
    if (changed) return true;
    double none = 0;
    for (std::uint32_t c : again)  // a single triangle that cannot be laid flat: the error names it
      if (laid_[c].failed)
        laid_[c] = layChart(surface_, charts_.charts[c], c, alike(options_.flatten), nullptr, none, job_);
    return false;
  }

  /// One joint less; where the chart failed, is far off or has been tried for long, as many as halve it.
  bool undo(std::uint32_t chart) {
    const std::uint32_t cluster = mainCluster(charts_.charts[chart]);
    const bool bad = laid_[chart].failed || laid_[chart].stretch.l2() > 1.5 * options_.chartStretch;
    const std::size_t size = merge_.chartSize(cluster);
    const std::size_t enough = round_ > kPatience ? size / 2 : bad ? size * 8 / 10 : size;
    bool changed = false;
    while (merge_.undoLast(cluster)) {
      changed = true;
      if (merge_.chartSize(cluster) <= enough) break;
    }
    return changed;
  }

  /// Where no joint is left: a cut through the middle, between two far ends.
  bool halve(std::uint32_t chart) {
    const std::vector<std::uint32_t>& faces = charts_.charts[chart].faces;
    if (faces.size() < 2) return false;
    std::vector<std::uint32_t> order = flood(flood(faces[0]).back());
    for (std::uint32_t f : order) side_[f] = 0;
    for (std::size_t i = 0; i < order.size() / 2; ++i) side_[order[i]] = 1;
    for (std::size_t i = 0; i < order.size() / 2; ++i)
      for (std::uint32_t half = 3 * order[i]; half < 3 * order[i] + 3; ++half) {
        const std::uint32_t other = surface_.twin[half];
        if (other != kNowhere && !seams_[surface_.edge[half]] && side_[other / 3] == 0)
          halved_.push_back(surface_.edge[half]);
      }
    return true;
  }

  /// Triangles of a chart in the order in which steps over its edges reach them.
  std::vector<std::uint32_t> flood(std::uint32_t from) {
    side_.resize(surface_.triangleCount());
    ++stamp_;
    std::vector<std::uint32_t> order{from};
    seen_.resize(surface_.triangleCount(), 0);
    seen_[from] = stamp_;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::uint32_t half = 3 * order[i]; half < 3 * order[i] + 3; ++half) {
        const std::uint32_t other = surface_.twin[half];
        if (other == kNowhere || seams_[surface_.edge[half]] || seen_[other / 3] == stamp_) continue;
        seen_[other / 3] = stamp_;
        order.push_back(other / 3);
      }
    return order;
  }

  std::uint32_t mainCluster(const Chart& chart) const {
    std::map<std::uint32_t, double> areas;
    for (std::uint32_t f : chart.faces) areas[clusters_.clusterOf[f]] += surface_.area(f);
    std::uint32_t best = areas.begin()->first;
    for (const auto& [c, area] : areas)
      if (area > areas[best]) best = c;
    return best;
  }

  const Surface& surface_;
  std::span<const float> costs_;
  const AutoCutOptions& options_;
  const Clusters& clusters_;
  const ClusterComplex& complex_;
  ClusterMerge& merge_;
  CoarseGuess guess_;
  Job& job_;
  Seams seams_;
  Charts charts_;
  std::vector<LaidChart> laid_;
  std::map<Hash128, LaidChart> known_;
  int round_ = 0;
  std::vector<std::uint32_t> halved_;  // edges cut where no joint was left
  std::vector<std::uint8_t> side_;     // [F]
  std::vector<std::uint32_t> seen_;    // [F]
  std::uint32_t stamp_ = 0;
};

}  // namespace

StretchSum FlatCharts::total() const {
  StretchSum sum;
  for (std::size_t c = 0; c < stretch.size(); ++c) {
    // Charts are packed by area: each at the scale at which it is as large as its surface.
    const double scale = stretch[c].flatArea > 0 ? std::sqrt(stretch[c].area / stretch[c].flatArea) : 1;
    sum += stretch[c].scaled(scale);
  }
  return sum;
}

FlatCharts autoCut(const Surface& surface, std::span<const float> costs, const AutoCutOptions& options,
                   Job& job) {
  if (!(options.stretch > 1))
    throw ValueError("a bound of " + std::to_string(options.stretch) + " on the stretch cannot be met",
                     "charts.stretch", "use 1.01 or more");
  job.begin("clustering", 0);
  const std::vector<float> bends = bendAngles(surface, job);
  const Clusters clusters = makeClusters(surface, bends, clusterCount(surface, options), job);
  const ClusterComplex complex = makeClusterComplex(surface, clusters, costs, job);
  MergeOptions merging;
  merging.stretch = 1 + 0.85 * (options.stretch - 1);  // the surface is rougher than its coarse copy
  merging.chartStretch = 1 + 0.85 * (options.chartStretch - 1);
  // One chart's equations take more than its share of time when it is large.
  constexpr double kLargest = 80000;  // triangles
  merging.chartArea = kLargest / double(std::max<std::size_t>(1, surface.triangleCount()));
  ClusterMerge merge(complex, merging);
  merge.run(job);
  FlatCharts charts = FineCut(surface, costs, options, clusters, complex, merge, job).run();
  if (const std::string missed = boundMissed(charts, options.stretch); !missed.empty()) logWarning(missed);
  return charts;
}

std::string boundMissed(const FlatCharts& charts, double bound) {
  const double all = charts.total().l2();
  if (all <= bound || charts.stretch.empty()) return {};
  // The chart that adds most to what is over.
  std::size_t worst = 0;
  const auto excess = [&](std::size_t c) {
    const double l2 = charts.stretch[c].l2();
    return (l2 * l2 - 1) * charts.stretch[c].area;
  };
  for (std::size_t c = 1; c < charts.stretch.size(); ++c)
    if (!(excess(c) <= excess(worst))) worst = c;
  return fmt::format(
      "the charts stretch {:.3f} together, the bound is {:.3f}: most of it is in {}, which has {:.3f}", all,
      bound, chartName(worst), charts.stretch[worst].l2());
}

FlatCharts flattenCharts(const Surface& surface, const Seams& seams, const FlattenOptions& options, Job& job,
                         const ChartPreview& preview) {
  return flattenCharts(surface, seams, makeCharts(surface, seams, job), alike(options), job, preview);
}

FlatCharts flattenCharts(const Surface& surface, const Seams& seams, Charts charts,
                         const ChartOptions& optionsOf, Job& job, const ChartPreview& preview) {
  FlatCharts result;
  result.seams = seams;
  result.charts = std::move(charts);
  const std::vector<std::uint32_t> order = bySize(result.charts);
  result.uv.resize(order.size());
  result.stretch.resize(order.size());
  for (std::size_t c = 0; c < order.size(); ++c)  // the first one at fault is named, whatever runs first
    if (result.charts.charts[c].fault() != ChartFault::None)
      FlatChart(surface, result.charts.charts[c], chartName(c));
  job.begin("laying charts flat", double(surface.triangleCount()), "triangles");
  std::mutex mutex;
  parallelFor(job, 0, order.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Chart& chart = result.charts.charts[order[i]];
      double left = double(chart.faces.size());
      LaidChart laid = layChart(surface, chart, order[i], optionsOf, nullptr, left, job);
      const std::lock_guard lock(mutex);
      result.stretch[order[i]] = laid.stretch;
      result.uv[order[i]] = std::move(laid.uv);
      if (preview) preview(order[i], result.uv[order[i]]);
      job.advance(left);
    }
  });
  return result;
}

}  // namespace prt
