#include "libprt/atlas/cluster_merge.h"

#include "libprt/atlas/arap.h"
#include "libprt/atlas/charts.h"
#include "libprt/atlas/convex_hull.h"
#include "libprt/atlas/stretch.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/mesh/union_find.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <unordered_map>

namespace prt {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kWasteful = 1e100;  // the score of what leaves too much of a convex hull empty

using Corners = std::array<DVec2, 3>;

/// A chart of the coarse surface, with its flat map.
struct Piece {
  std::vector<std::uint32_t> clusters;
  std::vector<std::uint32_t> arcs;  // seams and borders around and inside
  double area = 0;                  // on the surface
  double energy = 0;                // squared L2 stretch times area
  double waste = 0;                 // of its flat map's convex hull, what is no chart
  int version = 0;
  bool alive = true;
};

/// What mending some arcs between two charts (or inside of one) would make.
struct Trial {
  bool possible = false;
  double energy = 0;
  double waste = 0;
  std::vector<std::uint32_t> triangles;
  std::vector<Corners> uv;
};

struct Candidate {
  std::uint32_t a = 0, b = 0;  // charts; the same for a slit that closes from its tip
  std::vector<std::uint32_t> arcs;
  double gain = 0;
  double score = 0;
  int versionA = -1, versionB = -1;  // those that `trial` was made for
  bool tried = false;
  std::shared_ptr<Trial> trial;
};

struct Similarity {
  double cosine = 1, sine = 0;
  DVec2 from{0}, to{0};
  DVec2 operator()(const DVec2& p) const {
    const DVec2 d = p - from;
    return to + DVec2(cosine * d.x - sine * d.y, sine * d.x + cosine * d.y);
  }
};

/// The rigid motion that takes points to their partners best.
Similarity fit(const std::vector<std::pair<DVec2, DVec2>>& pairs) {
  Similarity motion;
  if (pairs.empty()) return motion;
  for (const auto& [p, q] : pairs) motion.from += p, motion.to += q;
  motion.from /= double(pairs.size());
  motion.to /= double(pairs.size());
  double cosine = 0, sine = 0;
  for (const auto& [p, q] : pairs) {
    const DVec2 a = p - motion.from, b = q - motion.to;
    cosine += dot(a, b);
    sine += a.x * b.y - a.y * b.x;
  }
  const double norm = std::hypot(cosine, sine);
  if (norm > 0) motion.cosine = cosine / norm, motion.sine = sine / norm;
  return motion;
}

}  // namespace

struct ClusterMerge::State {
  const ClusterComplex& complex;
  MergeOptions options;
  Seams seams;                       // of the coarse surface
  std::vector<std::uint8_t> isSeam;  // arcs
  std::vector<int> mendedAt;         // arcs: number of the merge that mended them
  int merges = 0;
  std::vector<std::uint32_t> pieceOf;  // of each cluster
  std::vector<Piece> pieces;
  std::vector<Corners> uv;                       // coarse triangles
  std::vector<std::vector<std::uint32_t>> rims;  // arcs around each cluster, borders left out
  double totalArea = 0, totalEnergy = 0;

  State(const ClusterComplex& c, const MergeOptions& o)
      : complex(c),
        options(o),
        seams(c.coarse),
        isSeam(c.arcs.size(), 1),
        mendedAt(c.arcs.size(), -1),
        uv(c.coarse.triangleCount()) {
    for (const RimArc& arc : c.arcs)
      for (std::uint32_t e : arc.pieces) seams.set(e);
    for (double a : c.area) totalArea += a;
    rims.resize(c.triangles.size());
    for (std::uint32_t i = 0; i < c.arcs.size(); ++i)
      if (!isBorder(i))
        for (std::uint32_t cluster : c.arcs[i].clusters) rims[cluster].push_back(i);
  }

  std::vector<std::uint32_t> joined(std::uint32_t cluster) const;
  std::uint32_t pieceAt(std::uint32_t cluster) const { return pieceOf[cluster]; }
  std::uint32_t pieceOfTriangle(std::uint32_t t) const { return pieceOf[complex.clusterOfTriangle[t]]; }

  /// Flat map of some coarse triangles from a first guess per corner.
  Trial layFlat(std::vector<std::uint32_t> triangles, const std::function<DVec2(std::uint32_t, int)>& guess,
                const Seams& cut, double area, int rounds, Job& job) const {
    Trial trial;
    const Chart chart = makeChart(complex.coarse, cut, triangles);
    if (chart.fault() != ChartFault::None) return trial;
    const FlatChart flat(complex.coarse, chart, "chart");
    std::vector<DVec2> start(flat.positions.size(), DVec2(0));
    std::vector<int> counts(flat.positions.size(), 0);
    for (std::size_t t = 0; t < chart.faces.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        start[chart.triangles[t][i]] += guess(chart.faces[t], i);
        ++counts[chart.triangles[t][i]];
      }
    for (std::size_t v = 0; v < start.size(); ++v) start[v] /= double(counts[v]);
    const std::vector<DVec2> map = asRigidAsPossible(flat, std::move(start), rounds, job);
    if (!isInjective(flat, map)) return trial;
    const double l2 = stretchOf(flat.positions, map, flat.triangles).l2();
    if (!(l2 < options.chartStretch)) return trial;
    trial.possible = true;
    trial.energy = l2 * l2 * area;
    std::vector<DVec2> rim;
    for (std::uint32_t v : flat.rim) rim.push_back(map[v]);
    trial.waste =
        polygonArea(convexHull(std::move(rim))) - stretchOf(flat.positions, map, flat.triangles).flatArea;
    trial.triangles = chart.faces;
    for (const UVec3& t : chart.triangles) trial.uv.push_back({map[t.x], map[t.y], map[t.z]});
    return trial;
  }

  /// Each cluster alone: its fan unrolled about its centre, turned to lie in its plane.
  void begin(Job& job) {
    pieceOf.resize(complex.triangles.size());
    pieces.resize(complex.triangles.size());
    for (std::uint32_t i = 0; i < complex.arcs.size(); ++i) {
      for (std::uint32_t c : complex.arcs[i].clusters)
        if (c != kNowhere && (pieces[c].arcs.empty() || pieces[c].arcs.back() != i))
          pieces[c].arcs.push_back(i);
    }
    std::vector<double> energies(pieces.size());
    parallelFor(job, 0, pieces.size(), 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t c = first; c < last; ++c) energies[c] = layCluster(std::uint32_t(c), job);
    });
    for (std::uint32_t c = 0; c < pieces.size(); ++c) {
      pieceOf[c] = c;
      pieces[c].clusters = {c};
      pieces[c].area = complex.area[c];
      pieces[c].energy = energies[c];
      totalEnergy += energies[c];
    }
  }

  double layCluster(std::uint32_t cluster, Job& job) {
    DVec3 normal(0);
    for (std::uint32_t t : complex.triangles[cluster]) normal += complex.coarse.areaNormal(t);
    const double length = glm::length(normal);
    const Frame frame = frameFromNormal(length > 0 ? Vec3(normal / length) : Vec3(0, 0, 1));
    const auto project = [&](std::uint32_t t, int corner) {
      const Vec3 p = frame.toLocal(complex.coarse.positions[complex.coarse.triangles[t][corner]]);
      return DVec2(p.x, p.y);
    };
    const Trial trial = layFlat(complex.triangles[cluster], project, seams, complex.area[cluster], 4, job);
    if (!trial.possible) {
      for (std::uint32_t t : complex.triangles[cluster])
        for (int i = 0; i < 3; ++i) uv[t][std::size_t(i)] = project(t, i);
      return complex.area[cluster];
    }
    for (std::size_t i = 0; i < trial.triangles.size(); ++i) uv[trial.triangles[i]] = trial.uv[i];
    return trial.energy;
  }

  Trial evaluate(const Candidate& candidate, Job& job) const {
    const Piece &a = pieces[candidate.a], &b = pieces[candidate.b];
    // b's map is moved so that the two sides of the seam meet.
    std::vector<std::pair<DVec2, DVec2>> pairs;
    if (candidate.a != candidate.b)
      for (std::uint32_t arc : candidate.arcs)
        for (std::uint32_t e : complex.arcs[arc].pieces) {
          std::uint32_t half = complex.coarse.halfOf[e], other = complex.coarse.twin[half];
          if (pieceOfTriangle(half / 3) != candidate.a) std::swap(half, other);
          const std::size_t i = half % 3, j = other % 3;
          pairs.emplace_back(uv[other / 3][(j + 1) % 3], uv[half / 3][i]);
          pairs.emplace_back(uv[other / 3][j], uv[half / 3][(i + 1) % 3]);
        }
    const Similarity motion = fit(pairs);
    std::vector<std::uint32_t> triangles;
    const auto addTriangles = [&](const Piece& piece) {
      for (std::uint32_t c : piece.clusters)
        triangles.insert(triangles.end(), complex.triangles[c].begin(), complex.triangles[c].end());
    };
    addTriangles(a);
    if (candidate.a != candidate.b) addTriangles(b);
    Seams cut = seams;
    for (std::uint32_t arc : candidate.arcs)
      for (std::uint32_t e : complex.arcs[arc].pieces) cut.set(e, false);
    const auto guess = [&](std::uint32_t t, int corner) {
      const DVec2& p = uv[t][std::size_t(corner)];
      return pieceOfTriangle(t) == candidate.a ? p : motion(p);
    };
    const double area = candidate.a == candidate.b ? a.area : a.area + b.area;
    return layFlat(std::move(triangles), guess, cut, area, 6, job);
  }

  /// Number of seams and borders that end at each place.
  std::unordered_map<std::uint32_t, int> valence;

  void countValence() {
    valence.clear();
    for (std::uint32_t i = 0; i < complex.arcs.size(); ++i)
      if (isSeam[i])
        for (std::uint32_t node : complex.arcs[i].nodes) ++valence[node];
  }

  bool isBorder(std::uint32_t arc) const { return complex.arcs[arc].clusters[1] == kNowhere; }

  /// What could be mended around a chart: with each neighbour the most valuable chain of arcs, and tips of
  /// its own slits.
  void addCandidates(std::uint32_t piece, std::vector<Candidate>& out) {
    const double unit = std::sqrt(totalArea);
    std::map<std::uint32_t, std::vector<std::uint32_t>> shared;
    for (std::uint32_t arc : pieces[piece].arcs) {
      if (!isSeam[arc] || isBorder(arc)) continue;
      const std::uint32_t left = pieceAt(complex.arcs[arc].clusters[0]),
                          right = pieceAt(complex.arcs[arc].clusters[1]);
      shared[left == piece ? right : left].push_back(arc);
    }
    for (auto& [other, arcs] : shared) {
      std::sort(arcs.begin(), arcs.end());
      arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
      if (other == piece) {
        for (std::uint32_t arc : arcs)
          if (valence[complex.arcs[arc].nodes[0]] == 1 || valence[complex.arcs[arc].nodes[1]] == 1)
            out.push_back({.a = piece,
                           .b = piece,
                           .arcs = {arc},
                           .gain = complex.arcs[arc].cost / unit,
                           .trial = nullptr});
        continue;
      }
      if (pieces[piece].area + pieces[other].area > options.chartArea * totalArea) continue;
      // Chains: arcs that follow each other through places where nothing else ends.
      std::unordered_map<std::uint32_t, std::uint32_t> at;  // node -> arc
      UnionFind sets(arcs.size());
      for (std::uint32_t i = 0; i < arcs.size(); ++i)
        for (std::uint32_t node : complex.arcs[arcs[i]].nodes)
          if (valence[node] == 2) {
            const auto [place, isNew] = at.try_emplace(node, i);
            if (!isNew) sets.join(place->second, i);
          }
      std::map<std::uint32_t, Candidate> chains;
      for (std::uint32_t i = 0; i < arcs.size(); ++i) {
        Candidate& chain = chains[sets.find(i)];
        chain.arcs.push_back(arcs[i]);
        chain.gain += complex.arcs[arcs[i]].cost / unit;
      }
      Candidate* best = nullptr;
      for (auto& [set, chain] : chains)
        if (!best || chain.gain > best->gain) best = &chain;
      best->a = std::min(piece, other);
      best->b = std::max(piece, other);
      best->gain += options.chartBonus;
      out.push_back(*best);
    }
  }

  double energyNow(const Candidate& c) const {
    return c.a == c.b ? pieces[c.a].energy : pieces[c.a].energy + pieces[c.b].energy;
  }
  double wasteNow(const Candidate& c) const {
    return c.a == c.b ? pieces[c.a].waste : pieces[c.a].waste + pieces[c.b].waste;
  }
  double scoreOf(const Candidate& c) const {
    const double waste = std::max(0.0, c.trial->waste - wasteNow(c));
    if (waste / totalArea > options.wasteBound * c.gain) return kWasteful;
    return (std::max(0.0, c.trial->energy - energyNow(c)) + options.wasteWeight * waste) / totalArea / c.gain;
  }

  /// Joins two charts, or shortens a slit.
  std::uint32_t apply(const Candidate& candidate) {
    for (std::uint32_t arc : candidate.arcs) {
      isSeam[arc] = 0;
      mendedAt[arc] = merges;
      for (std::uint32_t e : complex.arcs[arc].pieces) seams.set(e, false);
      for (std::uint32_t node : complex.arcs[arc].nodes) --valence[node];
    }
    ++merges;
    totalEnergy += candidate.trial->energy - energyNow(candidate);
    std::uint32_t kept = candidate.a;
    if (candidate.a != candidate.b) {
      std::uint32_t gone = candidate.b;
      if (pieces[kept].clusters.size() < pieces[gone].clusters.size()) std::swap(kept, gone);
      Piece &into = pieces[kept], &from = pieces[gone];
      for (std::uint32_t c : from.clusters) pieceOf[c] = kept;
      into.clusters.insert(into.clusters.end(), from.clusters.begin(), from.clusters.end());
      into.arcs.insert(into.arcs.end(), from.arcs.begin(), from.arcs.end());
      into.area += from.area;
      from = Piece{};
      from.alive = false;
    }
    Piece& piece = pieces[kept];
    std::erase_if(piece.arcs, [&](std::uint32_t arc) { return !isSeam[arc]; });
    std::sort(piece.arcs.begin(), piece.arcs.end());
    piece.arcs.erase(std::unique(piece.arcs.begin(), piece.arcs.end()), piece.arcs.end());
    piece.energy = candidate.trial->energy;
    piece.waste = candidate.trial->waste;
    ++piece.version;
    for (std::size_t i = 0; i < candidate.trial->triangles.size(); ++i)
      uv[candidate.trial->triangles[i]] = candidate.trial->uv[i];
    return kept;
  }
};

ClusterMerge::ClusterMerge(const ClusterComplex& complex, const MergeOptions& options)
    : state_(std::make_unique<State>(complex, options)) {}
ClusterMerge::~ClusterMerge() = default;

void ClusterMerge::run(Job& job) {
  State& s = *state_;
  job.begin("merging charts", double(s.complex.triangles.size()), "charts");
  s.begin(job);
  s.countValence();
  const double budget = s.options.stretch * s.options.stretch * s.totalArea;

  // Candidates by pair of charts; the queue holds scores, stale ones are told by their stamp.
  std::vector<Candidate> candidates;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> byPair;
  using Entry = std::tuple<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<std::uint8_t> open;
  const auto tryAll = [&](std::vector<std::uint32_t> list) {
    parallelFor(job, 0, list.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        Candidate& c = candidates[list[i]];
        c.trial = std::make_shared<Trial>(s.evaluate(c, job));
        c.tried = true;
        c.versionA = s.pieces[c.a].version;
        c.versionB = s.pieces[c.b].version;
      }
    });
    for (std::uint32_t i : list) {
      Candidate& c = candidates[i];
      if (!c.trial->possible) {
        c.score = kNever;
        c.trial.reset();
        continue;
      }
      c.score = s.scoreOf(c);
      if (c.score == kWasteful) {  // until one of the two has grown
        c.trial.reset();
        continue;
      }
      queue.push({c.score, i});
    }
  };
  const auto insert = [&](Candidate c) {
    const auto number = std::uint32_t(candidates.size());
    byPair[{c.a, c.b}].push_back(number);
    candidates.push_back(std::move(c));
    open.push_back(1);
    return number;
  };

  std::vector<std::uint32_t> fresh;
  for (std::uint32_t p = 0; p < s.pieces.size(); ++p) {
    std::vector<Candidate> around;
    s.addCandidates(p, around);
    for (Candidate& c : around)
      if (c.a == p || c.a == c.b) fresh.push_back(insert(std::move(c)));
  }
  tryAll(fresh);

  // Four guesses at a time are looked into, however many threads there are.
  constexpr std::size_t kTogether = 4;
  constexpr int kPatience = 40;
  int tooMuch = 0;
  while (!queue.empty() && tooMuch < kPatience) {
    job.checkCancelled();
    std::vector<std::uint32_t> stale;
    while (!queue.empty() && stale.size() < kTogether) {
      const auto [score, number] = queue.top();
      if (open[number] && score == candidates[number].score) {
        const Candidate& c = candidates[number];
        const bool known =
            c.tried && c.versionA == s.pieces[c.a].version && c.versionB == s.pieces[c.b].version;
        if (known) break;
        stale.push_back(number);
      }
      queue.pop();
    }
    if (!stale.empty()) {
      tryAll(stale);
      continue;
    }
    if (queue.empty()) break;
    const std::uint32_t number = std::get<1>(queue.top());
    queue.pop();
    Candidate& c = candidates[number];
    if (s.totalEnergy + c.trial->energy - s.energyNow(c) > budget) {
      open[number] = 0;  // a smaller one may still fit
      ++tooMuch;
      continue;
    }
    const Candidate chosen = std::move(c);
    open[number] = 0;
    const std::uint32_t a = chosen.a, b = chosen.b;
    // What was known of the neighbours guides the order in which they are tried again.
    std::map<std::uint32_t, double> known;
    for (auto place = byPair.begin(); place != byPair.end();) {
      const auto [x, y] = place->first;
      if (x != a && x != b && y != a && y != b) {
        ++place;
        continue;
      }
      for (std::uint32_t i : place->second) {
        if (!open[i]) continue;
        open[i] = 0;
        const std::uint32_t other = x == a || x == b ? y : x;
        const auto [at, isNew] = known.try_emplace(other, candidates[i].score);
        if (!isNew) at->second = std::min(at->second, candidates[i].score);
        candidates[i].trial.reset();
      }
      place = byPair.erase(place);
    }
    const std::uint32_t kept = s.apply(chosen);
    std::vector<Candidate> around;
    s.addCandidates(kept, around);
    for (Candidate& next : around) {
      const std::uint32_t other = next.a == kept ? next.b : next.a;
      const auto guess = known.find(other);
      const bool slit = next.a == next.b;
      if (!slit && guess != known.end() && guess->second == kNever) continue;  // it failed when smaller
      next.score = !slit && guess != known.end() ? guess->second : 0;
      const std::uint32_t i = insert(std::move(next));
      queue.push({candidates[i].score, i});
    }
    job.progress(double(s.merges), double(s.pieces.size()));
  }
}

bool ClusterMerge::isSeam(std::uint32_t arc) const {
  return state_->isSeam[arc] != 0;
}

const std::vector<std::uint32_t>& ClusterMerge::chartOfCluster() const {
  return state_->pieceOf;
}

const std::array<DVec2, 3>& ClusterMerge::uvOf(std::uint32_t coarseTriangle) const {
  return state_->uv[coarseTriangle];
}

std::vector<std::uint32_t> ClusterMerge::State::joined(std::uint32_t cluster) const {
  std::vector<std::uint32_t> clusters{cluster};
  std::vector<bool> inside(complex.triangles.size(), false);
  inside[cluster] = true;
  for (std::size_t k = 0; k < clusters.size(); ++k)
    for (std::uint32_t arc : rims[clusters[k]])
      if (!isSeam[arc])
        for (std::uint32_t c : complex.arcs[arc].clusters)
          if (!inside[c]) inside[c] = true, clusters.push_back(c);
  return clusters;
}

std::size_t ClusterMerge::chartSize(std::uint32_t cluster) const {
  return state_->joined(cluster).size();
}

bool ClusterMerge::undoLast(std::uint32_t cluster) {
  State& s = *state_;
  // The chart as the seams have it, which may have been undone before.
  const std::vector<std::uint32_t> clusters = s.joined(cluster);
  int last = -1;
  for (std::uint32_t c : clusters)
    for (std::uint32_t arc : s.rims[c]) last = std::max(last, s.mendedAt[arc]);
  if (last < 0) return false;
  for (std::uint32_t c : clusters)
    for (std::uint32_t arc : s.rims[c])
      if (s.mendedAt[arc] == last) {
        s.isSeam[arc] = 1;
        s.mendedAt[arc] = -1;
        for (std::uint32_t e : s.complex.arcs[arc].pieces) s.seams.set(e);
      }
  return true;
}

}  // namespace prt
