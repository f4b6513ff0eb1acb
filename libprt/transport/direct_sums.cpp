#include "libprt/transport/direct_sums.h"

#include "libprt/basis/sh.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/transport/buried.h"
#include "libprt/transport/memory_limit.h"

#include <algorithm>
#include <array>

namespace prt {
namespace {

/// Sums of one tile's samples on their way through a table: worked on apart, so that a tile that is cut
/// short leaves nothing behind.
struct TileSums {
  const DirectSums& all;
  std::size_t first;
  std::vector<float> open, cosine;  // of the tile's samples

  TileSums(const DirectSums& sums, std::size_t tile) : all(sums), first(tile * kBakeTile) {
    const std::size_t size = sums.tileSize(tile);
    const auto part = [&](const std::vector<float>& from, std::size_t stride) {
      return std::vector<float>(from.begin() + std::ptrdiff_t(first * stride),
                                from.begin() + std::ptrdiff_t((first + size) * stride));
    };
    open = part(sums.open, std::size_t(sums.stride));
    cosine = part(sums.cosine, std::size_t(sums.cosineStride));
  }

  /// Adds the samples at `places` of the tile, all of one direction set: visible[i] and weighted[i] are what
  /// the i-th sees, plain and times the cosine.
  void add(const RayTable& table, int scramble, std::span<const std::size_t> places,
           const std::vector<float>& visible, const std::vector<float>& weighted) {
    addTo(open, all.stride, table, scramble, places, visible);
    if (all.settings.visibility) addTo(cosine, all.cosineStride, table, scramble, places, weighted);
  }

 private:
  static void addTo(std::vector<float>& sums, int stride, const RayTable& table, int scramble,
                    std::span<const std::size_t> places, const std::vector<float>& weights) {
    std::vector<const float*> from;
    std::vector<float*> to;
    for (std::size_t i = 0; i < places.size(); ++i) {
      from.push_back(&weights[i * std::size_t(table.size())]);
      to.push_back(&sums[places[i] * std::size_t(stride)]);
    }
    accumulateProducts(table.functions(scramble), table.size(), stride / RayTable::kColumns,
                       int(places.size()), from.data(), to.data());
  }
};

template <class T>
const Array& fitting(const std::map<std::string, Array>& arrays, const std::string& name,
                     std::vector<std::int64_t> shape) {
  const auto found = arrays.find(name);
  if (found == arrays.end() || found->second.dtype != dtypeOf<T>() || found->second.shape != shape ||
      found->second.bytes.size() != found->second.size() * sizeof(T))
    throw FileError("array '" + name + "' of a bake's checkpoint is missing or does not fit", "checkpoint",
                    "bake again from the start");
  return found->second;
}

template <class T>
std::vector<T> vectorOf(const Array& array) {
  const std::span<const T> values = array.as<T>();
  return {values.begin(), values.end()};
}

}  // namespace

DirectSums::DirectSums(std::shared_ptr<const Scene> sceneOf, std::shared_ptr<const RayScene> raysOf,
                       std::shared_ptr<const SampleSet> samplesOf, const DirectSettings& s)
    : scene(std::move(sceneOf)),
      rays(std::move(raysOf)),
      samples(std::move(samplesOf)),
      settings(s),
      spread(s.visibility ? RaySpread::Uniform : RaySpread::Cosine),
      bands(s.visibility ? 2 * s.bands - 1 : s.bands),
      stride(sumStride(shCount(bands))),
      cosineStride(s.visibility ? sumStride(shCount(s.bands)) : 0) {
  // The sums, and the product that is made from them.
  requireMemory(count() * std::size_t(2 * (stride + cosineStride)) * sizeof(float), "direct transfer",
                "simplify the mesh or use fewer bands");
  open.assign(count() * std::size_t(stride), 0.0f);
  cosine.assign(count() * std::size_t(cosineStride), 0.0f);
  directions.assign(std::size_t(kScrambles * stride), 0.0f);
  tileRays.assign((count() + kBakeTile - 1) / kBakeTile, 0);
  hits = HitBlocks(tileRays.size());
}

int DirectSums::least() const {
  return int(*std::min_element(tileRays.begin(), tileRays.end()));
}
int DirectSums::most() const {
  return int(*std::max_element(tileRays.begin(), tileRays.end()));
}

bool DirectSums::trace(int from, int to, Job& job, const std::function<bool()>& rest) {
  const RayTable table(spread, std::max(bands, 2), from, to, settings.seed, job);
  accumulateDirections(table);
  std::atomic<bool> resting{false};
  parallelFor(job, 0, tileRays.size(), 1, [&](std::size_t tile, std::size_t) {
    if (int(tileRays[tile]) != from) return;
    if (!resting && rest && rest()) resting = true;
    if (!resting) traceTile(table, tile, job);
  });
  return !resting;
}

void DirectSums::accumulateDirections(const RayTable& table) {
  if (table.begin() != directionRays) return;
  const std::vector<float> ones(std::size_t(table.size()), 1.0f);
  const float* weights = ones.data();
  for (int s = 0; s < kScrambles; ++s) {
    float* sum = &directions[std::size_t(s * stride)];
    accumulateProducts(table.functions(s), table.size(), stride / RayTable::kColumns, 1, &weights, &sum);
  }
  directionRays = table.begin() + table.size();
}

void DirectSums::traceTile(const RayTable& table, std::size_t tile, Job& job) {
  const std::size_t size = tileSize(tile), first = tile * kBakeTile;
  const auto rayCount = std::size_t(table.size());
  SampleTracer tracer(*scene, *rays, *samples, spread, settings.seed, table);
  std::shared_ptr<HitBlock> block;
  if (hits.covered(tile) == table.begin() && hitBytes.load() < settings.hitMemory)
    block = std::make_shared<HitBlock>(table.begin(), table.begin() + table.size(), size);

  // Samples of one direction set go through its tables together.
  std::array<std::vector<std::size_t>, kScrambles> groups;
  for (std::size_t i = 0; i < size; ++i)
    groups[std::size_t(bakeScramble(*samples, first + i, settings.seed))].push_back(i);
  TileSums sums(*this, tile);
  std::vector<float> visible, weighted;
  for (int scramble = 0; scramble < kScrambles; ++scramble) {
    const std::vector<std::size_t>& places = groups[std::size_t(scramble)];
    visible.resize(places.size() * rayCount);
    weighted.resize(settings.visibility ? visible.size() : 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      job.checkCancelled();
      const std::span<float> cosines =
          weighted.empty() ? std::span<float>() : std::span(weighted).subspan(i * rayCount, rayCount);
      tracer.trace(first + places[i], std::span(visible).subspan(i * rayCount, rayCount), cosines,
                   block.get(), places[i]);
    }
    sums.add(table, scramble, places, visible, weighted);
  }

  std::copy(sums.open.begin(), sums.open.end(), open.begin() + std::ptrdiff_t(first * std::size_t(stride)));
  std::copy(sums.cosine.begin(), sums.cosine.end(),
            cosine.begin() + std::ptrdiff_t(first * std::size_t(cosineStride)));
  tileRays[tile] = std::uint32_t(table.begin() + table.size());
  if (block) {
    block->shrink();
    hitBytes += block->bytes();
    hits.add(tile, std::move(block));
  }
  job.advance(double(size) * table.size());
}

/// A sample can only be buried where much is blocked: few need a closer look.
void DirectSums::findBuriedSamples(Job& job) {
  constexpr float kRoot4Pi = 3.5449077f;
  constexpr float kMuchBlocked = 0.15f;
  std::vector<std::uint8_t> candidates(count());
  for (std::size_t s = 0; s < count(); ++s) {
    const float visibleShare = open[s * std::size_t(stride)] * kRoot4Pi / float(tileRays[s / kBakeTile]);
    candidates[s] = visibleShare < 1 - kMuchBlocked;
  }
  buried = findBuried(*scene, *rays, *samples, candidates, settings.seed, job);
}

std::map<std::string, Array> DirectSums::save() const {
  const auto samplesCount = std::int64_t(count());
  const std::array<std::uint32_t, 4> setup{std::uint32_t(settings.bands), settings.visibility,
                                           std::uint32_t(settings.seed), std::uint32_t(settings.seed >> 32)};
  const std::array<std::int32_t, 1> rayCount{directionRays};
  return {
      {"setup", Array::from(std::span<const std::uint32_t>(setup), {4})},
      {"open", Array::from(std::span<const float>(open), {samplesCount, stride})},
      {"cosine", Array::from(std::span<const float>(cosine), {samplesCount, cosineStride})},
      {"directions", Array::from(std::span<const float>(directions), {kScrambles, stride})},
      {"direction_rays", Array::from(std::span<const std::int32_t>(rayCount), {1})},
      {"tile_rays", Array::from(std::span<const std::uint32_t>(tileRays), {std::int64_t(tileRays.size())})},
      {"buried", Array::from(std::span<const std::uint8_t>(buried), {std::int64_t(buried.size())})}};
}

void DirectSums::load(const std::map<std::string, Array>& arrays) {
  const auto samplesCount = std::int64_t(count());
  const auto setup = vectorOf<std::uint32_t>(fitting<std::uint32_t>(arrays, "setup", {4}));
  const auto rayCount = vectorOf<std::int32_t>(fitting<std::int32_t>(arrays, "direction_rays", {1}));
  auto newTileRays =
      vectorOf<std::uint32_t>(fitting<std::uint32_t>(arrays, "tile_rays", {std::int64_t(tileRays.size())}));
  const auto found = arrays.find("buried");
  const bool known = found != arrays.end() && found->second.size() > 0;
  auto newBuried =
      vectorOf<std::uint8_t>(fitting<std::uint8_t>(arrays, "buried", {known ? samplesCount : 0}));
  auto newOpen = vectorOf<float>(fitting<float>(arrays, "open", {samplesCount, stride}));
  auto newCosine = vectorOf<float>(fitting<float>(arrays, "cosine", {samplesCount, cosineStride}));
  auto newDirections = vectorOf<float>(fitting<float>(arrays, "directions", {kScrambles, stride}));
  const auto most = *std::max_element(newTileRays.begin(), newTileRays.end());
  const bool fits = setup[0] == std::uint32_t(settings.bands) &&
                    setup[1] == std::uint32_t(settings.visibility) &&
                    (std::uint64_t(setup[3]) << 32 | setup[2]) == settings.seed &&
                    most <= std::uint32_t(kMaxRays) && rayCount[0] >= int(most) && rayCount[0] <= kMaxRays;
  if (!fits)
    throw FileError("belongs to a bake with other settings", "checkpoint", "bake again from the start");
  open = std::move(newOpen), cosine = std::move(newCosine), directions = std::move(newDirections);
  directionRays = rayCount[0], tileRays = std::move(newTileRays), buried = std::move(newBuried);
  hits = HitBlocks(tileRays.size());
  hitBytes = 0;
}

}  // namespace prt
