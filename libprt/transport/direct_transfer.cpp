#include "libprt/transport/direct_transfer.h"

#include "libprt/basis/quadrature.h"
#include "libprt/basis/sh.h"
#include "libprt/basis/sh_rotation.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/transport/buried.h"
#include "libprt/transport/direct_sums.h"

#include <algorithm>
#include <stdexcept>

namespace prt {
namespace {

constexpr int kMaxBands = 10;

void check(const DirectSettings& settings, std::size_t samples) {
  if (settings.bands < 1 || settings.bands > kMaxBands)
    throw ValueError("cannot bake " + std::to_string(settings.bands) + " bands", "transfer.bands",
                     "use 1 to 10");
  if (settings.rays < 1 || settings.rays > kMaxRays)
    throw ValueError("cannot trace " + std::to_string(settings.rays) + " rays per sample", "transfer.rays",
                     "use 1 to " + std::to_string(kMaxRays));
  if (samples == 0)
    throw GeometryError("there is no place to bake transfer at", "samples", "give a mesh with vertices");
}

/// Coefficients of the upper hemisphere about +z, or of the clamped cosine.
std::vector<double> hemisphere(int bands, RaySpread spread) {
  const SphereRule rule = hemisphereRule(2 * bands);
  std::vector<double> y(shCount(bands)), sum(shCount(bands), 0);
  for (std::size_t i = 0; i < rule.directions.size(); ++i) {
    shEvaluate(bands, rule.directions[i], y);
    const double weight = rule.weights[i] * (spread == RaySpread::Cosine ? rule.directions[i].z : 1.0);
    for (int l = 0; l < bands; ++l) sum[shIndex(l, 0)] += weight * y[shIndex(l, 0)];
  }
  return sum;
}

/// The estimates of one sample, from sums to coefficients in the object frame.
class Estimator {
 public:
  Estimator(const DirectSums& sums, int rays)
      : sums_(sums), rays_(rays), open_(hemisphere(sums.bands, sums.spread)) {}

  /// `main` gets the coefficients that `open` sums to, `diffuse` those of `cosine` (null without).
  void run(std::size_t sample, float* main, float* diffuse) const {
    const Frame frame = bakeFrame(*sums_.samples, sample, sums_.spread, sums_.settings.seed);
    std::vector<double> local(std::size_t(shCount(sums_.bands)));
    controlled(sample, local);
    turned(frame, sums_.bands, local, main);
    if (!diffuse) return;
    const float* cosine = &sums_.cosine[sample * std::size_t(sums_.cosineStride)];
    for (int k = 0; k < shCount(sums_.settings.bands); ++k)
      local[std::size_t(k)] = 2 * kPi / rays_ * cosine[k];
    turned(frame, sums_.settings.bands, local, diffuse);
  }

 private:
  /// Mean of V Y, with v (Y - its exact integral) taken off: v = the visible share, so that nothing is
  /// left to chance where nothing is blocked.
  void controlled(std::size_t sample, std::vector<double>& out) const {
    constexpr double kRoot4Pi = 3.5449077018110318;
    const int scramble = bakeScramble(*sums_.samples, sample, sums_.settings.seed);
    const float* open = &sums_.open[sample * std::size_t(sums_.stride)];
    const float* all = &sums_.directions[std::size_t(scramble * sums_.stride)];
    const double weight = (sums_.spread == RaySpread::Cosine ? kPi : 2 * kPi) / rays_;
    const double share = open[0] * kRoot4Pi / rays_;
    for (std::size_t k = 0; k < out.size(); ++k)
      out[k] = weight * (open[k] - share * all[k]) + share * open_[k];
  }

  /// Out of the sample's frame into the object's.
  static void turned(const Frame& frame, int bands, std::vector<double>& local, float* out) {
    rotateShOnce(bands, glm::dmat3(frame.matrix()), local, local);
    std::copy_n(local.begin(), shCount(bands), out);
  }

  const DirectSums& sums_;
  double rays_;
  std::vector<double> open_;  // coefficients where nothing is blocked
};

}  // namespace

struct DirectBake::Impl : DirectSums {
  using DirectSums::DirectSums;
  std::vector<int> ends = bakeLevels(settings.rays);

  int levelsDone() const {
    return buried.empty() ? 0 : int(std::upper_bound(ends.begin(), ends.end(), least()) - ends.begin());
  }
  /// Where the next run of rays ends: at a level, at what another tile has done already, or when it is
  /// as long as may be.
  int nextStop(int from, int target) const {
    int stop = std::min(target, from + kChunkRays);
    for (const std::uint32_t done : tileRays)
      if (int(done) > from) stop = std::min(stop, int(done));
    return stop;
  }
};

DirectBake::DirectBake(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
                       std::shared_ptr<const SampleSet> samples, const DirectSettings& settings) {
  check(settings, samples->size());
  impl_ = std::make_unique<Impl>(std::move(scene), std::move(rays), std::move(samples), settings);
}

DirectBake::~DirectBake() = default;

int DirectBake::level() const {
  return impl_->levelsDone();
}
int DirectBake::levels() const {
  return int(impl_->ends.size());
}

void DirectBake::advance(Job& job, const std::function<bool()>& rest) {
  Impl& b = *impl_;
  if (done()) return;
  const int target = b.ends[std::size_t(level())];
  double done = 0;
  for (std::size_t t = 0; t < b.tileRays.size(); ++t)
    done += double(b.tileSize(t)) * std::min<double>(b.tileRays[t], b.ends.back());
  const double total = std::max(b.settings.phaseRays, double(b.count()) * b.ends.back());
  job.begin(b.settings.phase, total, "rays", b.settings.phaseRaysBefore + done);
  while (b.least() < target)
    if (!b.trace(b.least(), b.nextStop(b.least(), target), job, rest)) return;
  if (b.buried.empty()) b.findBuriedSamples(job);
}

DirectTransfer DirectBake::product(Job& job) const {
  const DirectSums& b = *impl_;
  const int done = b.least();
  if (done == 0 || done != b.most() || done != b.directionRays || b.buried.empty())
    throw std::logic_error("a direct bake has a product only when a level is complete");
  const auto functions = std::size_t(shCount(b.settings.bands)), wide = std::size_t(shCount(b.bands));
  std::vector<float> main(b.count() * wide), diffuse(b.settings.visibility ? b.count() * functions : 0);
  const Estimator estimator(b, done);
  parallelFor(job, 0, b.count(), kBakeTile, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      estimator.run(s, &main[s * wide], diffuse.empty() ? nullptr : &diffuse[s * functions]);
  });
  const BuriedFill fill(*b.scene, *b.samples, b.buried);
  fill.apply(main, wide);
  if (!diffuse.empty()) fill.apply(diffuse, functions);

  DirectTransfer product;
  product.settings = b.settings;
  product.raysPerSample = done;
  const auto count = std::int64_t(b.count());
  if (b.settings.visibility) {
    product.visibility = Array::from(std::span<const float>(main), {count, std::int64_t(wide)});
    product.diffuse = Array::from(std::span<const float>(diffuse), {count, std::int64_t(functions)});
  } else {
    product.diffuse = Array::from(std::span<const float>(main), {count, std::int64_t(functions)});
  }
  product.buried = Array::from(std::span<const std::uint8_t>(b.buried), {count});
  if (b.settings.hitMemory > 0) product.hits = std::make_shared<HitBlocks>(b.hits);
  return product;
}

std::map<std::string, Array> DirectBake::checkpoint() const {
  return impl_->save();
}

void DirectBake::restore(const std::map<std::string, Array>& checkpoint) {
  impl_->load(checkpoint);
  // What was begun is finished, even when fewer rays are wanted now.
  impl_->ends = bakeLevels(std::max(impl_->settings.rays, impl_->directionRays));
}

}  // namespace prt
