#include "libprt/synthesis/texture_synthesis.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/mesh/union_find.h"
#include "libprt/synthesis/candidate_search.h"

#include <algorithm>

namespace prt {
namespace {

constexpr double kCoarsest = 0.25;  // patch widths between samples that still tell texels apart
constexpr int kCoarsePasses = 24, kMiddlePasses = 5;
constexpr float kUnset = -1;

double spacingOf(const MesoMesh& meso, int level, double patchWidth, int texels) {
  return meso.edgeOf(level) / patchWidth * texels;
}

/// Coordinates that go on from a neighbour.
Vec2 goingOn(const Neighbourhoods& around, std::uint32_t slot, const Vec2& from, int symmetry) {
  const int turn = around.turnOf(slot);
  return from - turnedBy(around.offset[slot], turn == 0 ? 0 : symmetry - turn, symmetry);
}

class Synthesis {
 public:
  Synthesis(const MesoMesh& meso, const SurfaceSheets& sheets, std::span<const Vec3> tangents,
            const PatchExemplars& exemplars, const SynthesisOptions& options, Job& job)
      : meso_(meso),
        sheets_(sheets),
        tangents_(tangents),
        exemplars_(exemplars),
        options_(options),
        torus_(exemplars.texels()),
        job_(job) {}

  std::vector<Vec2> run() {
    u_.assign(meso_.vertexCount(), Vec2(kUnset));
    double work = 0;
    for (int level = 0; level < meso_.levels(); ++level) work += double(countOf(level)) * passesOf(level);
    job_.begin("synthesis", work, "corrections");
    for (int level = 0; level < meso_.levels(); ++level) {
      doLevel(level);
      if (options_.preview) options_.preview(finished(countOf(level)), level + 1, meso_.levels());
    }
    return finished(u_.size());
  }

 private:
  std::size_t countOf(int level) const { return meso_.levelEnd[std::size_t(level)]; }
  /// Index into the exemplars' levels, of which the finest comes first; negative where they have none.
  int appearanceOf(int level) const {
    const int fromFinest = meso_.levels() - 1 - level;
    return fromFinest < exemplars_.levels() ? fromFinest : -1;
  }
  int passesOf(int level) const {
    if (appearanceOf(level) < 0) return kCoarsePasses;
    return level == meso_.levels() - 1 ? options_.passes : std::max(kMiddlePasses, options_.passes);
  }

  void doLevel(int level) {
    const double unit = exemplars_.texels() / options_.patchWidth;
    const Neighbourhoods around =
        makeNeighbourhoods(meso_, sheets_, tangents_, options_.symmetry, unit, level, job_);
    const std::size_t known = level == 0 ? 0 : countOf(level - 1);
    goOn(around, known);
    const double spacing = spacingOf(meso_, level, options_.patchWidth, exemplars_.texels());
    if (options_.jitter > 0 && appearanceOf(level) >= 0) {
      // The first level that tells texels apart decides what lies beside what: there, anything may come.
      const bool first = level == 0 || appearanceOf(level - 1) < 0;
      throwAbout(level, options_.jitter * (first ? 0.5 * exemplars_.texels() : spacing));
    }
    const auto sets = independentSets(around.rings);
    for (int pass = 0; pass < passesOf(level); ++pass)
      for (const auto& set : sets) correct(set, around, level, spacing);
  }

  /// New vertices take the coordinates that go on from their nearest neighbour of the level before, or else
  /// from one that has some by now; the first of each piece takes the seed's.
  void goOn(const Neighbourhoods& around, std::size_t known) {
    parallelFor(job_, known, around.count(), 8192, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
        if (const std::uint32_t slot = nearestSlot(around, std::uint32_t(p), known); slot != kNowhere)
          u_[p] = torus_.wrapped(goingOn(around, slot, u_[around.rings.list[slot]], options_.symmetry));
    });
    std::vector<std::uint32_t> queue;
    const auto spread = [&](std::uint32_t seed) {
      queue.assign(1, seed);
      for (std::size_t i = 0; i < queue.size(); ++i)
        for (const std::uint32_t q : around.rings.of(queue[i]))
          if (u_[q].x == kUnset) {
            const std::uint32_t slot = nearestSlot(around, q, around.count());
            u_[q] = torus_.wrapped(goingOn(around, slot, u_[around.rings.list[slot]], options_.symmetry));
            queue.push_back(q);
          }
    };
    for (std::uint32_t p = 0; p < known; ++p) spread(p);
    for (std::uint32_t p = std::uint32_t(known); p < around.count(); ++p) {
      if (u_[p].x == kUnset)
        u_[p] = torus_.size * Vec2(hashUniform(options_.seed, p, 0), hashUniform(options_.seed, p, 1));
      spread(p);
    }
  }

  /// The nearest neighbour below `end` that has coordinates.
  std::uint32_t nearestSlot(const Neighbourhoods& around, std::uint32_t p, std::size_t end) const {
    std::uint32_t best = kNowhere;
    float least = 1e30f;
    for (std::uint32_t slot = around.rings.start[p]; slot < around.rings.start[p + 1]; ++slot) {
      const std::uint32_t q = around.rings.list[slot];
      if (q >= end || u_[q].x == kUnset) continue;
      if (const float d2 = dot(around.offset[slot], around.offset[slot]); d2 < least) least = d2, best = slot;
    }
    return best;
  }

  void throwAbout(int level, double texels) {
    const float far = float(texels);
    parallelFor(job_, 0, countOf(level), 16384, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) {
        const auto dimension = std::uint32_t(2 + 2 * level);
        const Vec2 h(hashUniform(options_.seed, p, dimension), hashUniform(options_.seed, p, dimension + 1));
        u_[p] = torus_.wrapped(u_[p] + far * (2.0f * h - 1.0f));
      }
    });
  }

  void correct(const std::vector<std::uint32_t>& set, const Neighbourhoods& around, int level,
               double spacing) {
    parallelFor(job_, 0, set.size(), 1024, [&](std::size_t begin, std::size_t end) {
      CandidateSearch search(exemplars_, appearanceOf(level), spacing);
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t p = set[i];
        const VertexWish* wish = options_.wishes.empty() ? nullptr : &options_.wishes[p];
        u_[p] = search.best(p, around, u_, wish);
      }
    });
    job_.advance(double(set.size()));
  }

  /// In patch widths.
  std::vector<Vec2> finished(std::size_t count) const {
    std::vector<Vec2> out(count);
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = u_[i] / torus_.size;
      for (int k = 0; k < 2; ++k)
        if (!(out[i][k] < 1)) out[i][k] = 0;
    }
    return out;
  }

  const MesoMesh& meso_;
  const SurfaceSheets& sheets_;
  std::span<const Vec3> tangents_;
  const PatchExemplars& exemplars_;
  const SynthesisOptions& options_;
  TexelTorus torus_;
  Job& job_;
  std::vector<Vec2> u_;  // in texels
};

}  // namespace

std::vector<VertexWish> vertexWishes(const MesoMesh& meso, std::span<const PatchWish> wishes, Job& job) {
  std::vector<VertexWish> out;
  if (wishes.empty()) return out;
  out.resize(meso.vertexCount());
  for (const PatchWish& wish : wishes) {
    job.checkCancelled();
    std::size_t nearest = 0;
    float least = 1e30f;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (const float d = distance(meso.positions[i], wish.centre); d < least) least = d, nearest = i;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const float d = distance(meso.positions[i], wish.centre);
      if (!(d < wish.radius) || dot(meso.normals[i], meso.normals[nearest]) < 0) continue;
      const float strength = std::min(1.0f, 2 * (1 - d / wish.radius));
      if (strength > out[i].strength) out[i] = {wish.place, wish.extent, strength};
    }
  }
  return out;
}

std::vector<double> exemplarSpacings(const MesoMesh& meso, double patchWidth, int texels) {
  std::vector<double> spacings;
  for (int level = meso.levels() - 1; level >= 0; --level) {
    const double spacing = spacingOf(meso, level, patchWidth, texels);
    if (spacing > kCoarsest * texels) break;
    spacings.push_back(spacing);
  }
  return spacings;
}

bool PatchExemplars::fit(const MesoMesh& meso) const {
  const auto alike = [this](const Exemplar& e) {
    return e.texels == texels() && e.turns == turns() && int(e.levels.size()) == levels();
  };
  return exemplars.size() <= ShownExemplars::kMost &&
         std::all_of(exemplars.begin(), exemplars.end(), alike) &&
         (weights.empty() ? exemplars.size() == 1 : weights.size() == meso.vertexCount() * exemplars.size());
}

std::vector<Vec2> synthesise(const MesoMesh& meso, const SurfaceSheets& sheets,
                             std::span<const Vec3> tangents, const PatchExemplars& exemplars,
                             const SynthesisOptions& options, Job& job) {
  if (!(options.patchWidth > 0))
    throw ValueError("the patch has no width", "synthesis.scale", "use a positive number");
  if (!exemplars.fit(meso) || exemplars.turns() != options.symmetry ||
      tangents.size() != meso.vertexCount() ||
      (!options.wishes.empty() && options.wishes.size() != meso.vertexCount()))
    throw ValueError("mesh, field and exemplar do not fit together", "synthesis", "make them alike");
  return Synthesis(meso, sheets, tangents, exemplars, options, job).run();
}

SynthesisQuality measureSynthesis(const MesoMesh& meso, const Neighbourhoods& finest,
                                  const PatchExemplars& exemplars, std::span<const Vec2> coordinates,
                                  std::span<const std::uint32_t> chartOf) {
  const TexelTorus torus(exemplars.texels());
  const bool tells = exemplars.levels() > 0;
  const double texelsApart = tells ? exemplars.exemplars[0].levels[0].spacing : 1.0;
  double sums[2] = {0, 0}, pairs[2] = {0, 0}, coherent = 0;
  const float near = float(std::max(1.0, 0.5 * texelsApart));
  UnionFind regions(finest.count());
  for (std::uint32_t p = 0; p < finest.count(); ++p) {
    const ShownExemplars shown = tells ? exemplarsShown(exemplars, p) : ShownExemplars{};
    for (std::uint32_t slot = finest.rings.start[p]; slot < finest.rings.start[p + 1]; ++slot) {
      const std::uint32_t q = finest.rings.list[slot];
      const Vec2 here = coordinates[p] * torus.size, there = coordinates[q] * torus.size;
      const int turn = finest.turnOf(slot);
      const bool crosses = !chartOf.empty() && chartOf[meso.triangle[p]] != chartOf[meso.triangle[q]];
      ++pairs[crosses];
      for (std::size_t k = 0; k < shown.count; ++k) {
        const ExemplarLevel& level = shown.exemplar[k]->levels[0];
        sums[crosses] += double(
            shown.weight[k] *
            appearanceDistance2(level.at(0, torus.texel(here + finest.offset[slot]), exemplars.count()),
                                level.at(turn, torus.texel(there), exemplars.count())));
      }
      const Vec2 off = torus.shortest(there - finest.offset[slot] - here);
      if (turn != 0 || std::abs(off.x) > near || std::abs(off.y) > near) continue;
      ++coherent;
      regions.join(p, q);
    }
  }
  std::vector<std::uint32_t> size(finest.count(), 0);
  std::uint32_t largest = 0;
  for (std::uint32_t p = 0; p < finest.count(); ++p) largest = std::max(largest, ++size[regions.find(p)]);
  const auto root = [](double sum, double count) { return count > 0 ? std::sqrt(sum / count) : 0; };
  SynthesisQuality quality;
  quality.distance = root(sums[0] + sums[1], pairs[0] + pairs[1]);
  quality.inside = root(sums[0], pairs[0]);
  quality.across = root(sums[1], pairs[1]);
  quality.coherence = pairs[0] + pairs[1] > 0 ? coherent / (pairs[0] + pairs[1]) : 0;
  quality.longestRepeat = std::sqrt(double(largest) / 1.155) * texelsApart / exemplars.texels();
  return quality;
}

}  // namespace prt
