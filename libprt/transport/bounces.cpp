#include "libprt/transport/bounces.h"

#include "libprt/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace prt {
namespace {

bool grey(const Rgb& c) {
  return c.x == c.y && c.y == c.z;
}

/// Object of each surface sample: that of its vertex.
std::vector<std::uint32_t> objectsOf(const Scene& scene, const SampleSet& surface) {
  std::vector<std::uint32_t> object(surface.size());
  std::copy(scene.vertexObject.begin(), scene.vertexObject.end(), object.begin());
  for (std::size_t v = 0; v < surface.back.size(); ++v)
    if (surface.back[v] != kNone) object[surface.back[v]] = scene.vertexObject[v];
  return object;
}

double norm(const SampleRows& rows) {
  double sum = 0;
  for (const float x : rows.values) sum += double(x) * x;
  return std::sqrt(sum);
}

/// Direct irradiance vectors as rows, the same in every channel.
SampleRows directRows(const DirectTransfer& direct, int channels) {
  const auto functions = std::size_t(direct.diffuse.shape[1]);
  SampleRows rows(direct.samples(), functions * std::size_t(channels));
  const std::span<const float> e = direct.diffuse.as<float>();
  for (std::size_t s = 0; s < direct.samples(); ++s)
    for (std::size_t k = 0; k < functions; ++k)
      for (std::size_t c = 0; c < std::size_t(channels); ++c)
        rows.row(s)[k * std::size_t(channels) + c] = e[s * functions + k];
  return rows;
}

/// to += scale * from, where `from` may have one channel for the three of `to`.
void addScaled(const SampleRows& from, const Rgb& scale, int channels, SampleRows& to) {
  const auto c = std::size_t(channels);
  const bool spread = from.width != to.width;
  for (std::size_t s = 0; s < to.count(); ++s) {
    float* out = to.row(s);
    const float* in = from.row(s);
    for (std::size_t i = 0; i < to.width; ++i) out[i] += scale[int(i % c)] * in[spread ? i / c : i];
  }
}

Array arrayOf(const SampleRows& rows) {
  return Array::from<float>(std::span<const float>(rows.values),
                            {std::int64_t(rows.count()), std::int64_t(rows.stride)});
}

/// Fills rows of the right size from an array; false when it is not what arrayOf made of such rows.
bool fillFrom(const std::map<std::string, Array>& arrays, const std::string& name, SampleRows& rows) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) return false;
  const Array& array = found->second;
  const std::vector<std::int64_t> shape{std::int64_t(rows.count()), std::int64_t(rows.stride)};
  if (array.dtype != DType::f32 || array.shape != shape ||
      array.bytes.size() != rows.values.size() * sizeof(float))
    return false;
  std::memcpy(rows.values.data(), array.bytes.data(), array.bytes.size());
  return true;
}

/// The chain between two bounces.
struct Chain {
  BounceResult result;
  SampleRows last;  // e_k, or e_k / albedo^k

  std::map<std::string, Array> save() const {
    const std::int32_t bounces = result.bounces;
    return {{"bounces", Array::from<std::int32_t>(std::span(&bounces, 1), {1})},
            {"total", arrayOf(result.total)},
            {"before_last", arrayOf(result.beforeLast)},
            {"last", arrayOf(last)}};
  }

  /// Takes up a saved state of at most `most` bounces, if that is what `arrays` hold.
  void restore(const std::map<std::string, Array>& arrays, int most) {
    const auto found = arrays.find("bounces");
    if (found == arrays.end() || found->second.dtype != DType::i32 ||
        found->second.bytes.size() != sizeof(std::int32_t))
      return;
    Chain next = *this;
    next.result.bounces = found->second.as<std::int32_t>()[0];
    const bool fits = next.result.bounces > 0 && next.result.bounces <= most &&
                      fillFrom(arrays, "total", next.result.total) &&
                      fillFrom(arrays, "before_last", next.result.beforeLast) &&
                      fillFrom(arrays, "last", next.last);
    if (fits) *this = std::move(next);
  }

  /// Whether the last bounce added less than this share of the total.
  bool endsBelow(float share) const {
    if (result.bounces == 0) return false;
    SampleRows added = result.total;
    for (std::size_t i = 0; i < added.values.size(); ++i) added.values[i] -= result.beforeLast.values[i];
    return norm(added) < share * norm(result.total);
  }
};

}  // namespace

BounceColours::BounceColours(std::span<const Material> materials) {
  const bool allGrey = std::ranges::all_of(materials, [](const Material& m) { return grey(m.albedo); });
  const bool allEqual =
      std::ranges::all_of(materials, [&](const Material& m) { return m.albedo == materials.front().albedo; });
  channels = allGrey ? 1 : 3;
  factored = allEqual;
  common = materials.front().albedo;
  chainChannels = allGrey || allEqual ? 1 : 3;
}

SampleRows leavingRadiance(const Scene& scene, const SampleSet& surface, const SampleRows& irradiance,
                           int channels) {
  SampleRows leaving = irradiance;
  const std::vector<std::uint32_t> object = objectsOf(scene, surface);
  const auto c = std::size_t(channels);
  for (std::size_t s = 0; s < surface.size(); ++s) {
    const Rgb factor = scene.materials[object[s]].albedo / kPiF;
    float* row = leaving.row(s);
    for (std::size_t i = 0; i < leaving.width; ++i) row[i] *= factor[int(i % c)];
  }
  return leaving;
}

BounceResult bounceBetweenVertices(const Scene& scene, const SampleSet& surface, const DirectTransfer& direct,
                                   BounceGather& gather, const BuriedFill& fill, int bounces,
                                   float stopThreshold, Job& job, const BounceCheckpoint* checkpoint) {
  const BounceColours colours(scene.materials);
  Chain chain;
  BounceResult& result = chain.result;
  result.channels = colours.channels;
  result.total = directRows(direct, colours.channels);
  result.beforeLast = result.total;
  chain.last = directRows(direct, colours.chainChannels);
  if (checkpoint) chain.restore(checkpoint->saved, bounces);
  Rgb power(1);
  for (int k = 0; k < result.bounces; ++k) power *= colours.common;
  job.begin("bounces", gather.rayCount() * bounces, "rays");
  job.progress(gather.rayCount() * result.bounces, gather.rayCount() * bounces);
  while (result.bounces < bounces && !chain.endsBelow(stopThreshold)) {
    SampleRows leaving;
    if (colours.factored) {
      leaving = chain.last;
      for (float& x : leaving.values) x /= kPiF;
      power *= colours.common;
    } else {
      leaving = leavingRadiance(scene, surface, chain.last, colours.chainChannels);
    }
    chain.last = gather.irradiance(leaving, job);
    fill.apply(chain.last.values, chain.last.stride);
    result.beforeLast = result.total;
    addScaled(chain.last, colours.factored ? power : Rgb(1), colours.channels, result.total);
    ++result.bounces;
    if (checkpoint && checkpoint->keep) checkpoint->keep(chain.save());
  }
  job.progress(gather.rayCount() * bounces, gather.rayCount() * bounces);
  return std::move(chain.result);
}

}  // namespace prt
