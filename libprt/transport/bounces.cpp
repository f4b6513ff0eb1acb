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

/// Object of each surface sample: that of its vertex or triangle.
std::vector<std::uint32_t> objectsOf(const Scene& scene, const SampleSet& surface) {
  std::vector<std::uint32_t> object(surface.size());
  if (surface.texels) {
    for (std::size_t s = 0; s < object.size(); ++s) object[s] = scene.triangleObject[surface.triangle[s]];
    return object;
  }
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

/// Rows of one channel as rows of several, which are all the same.
SampleRows repeated(const SampleRows& rows, int channels) {
  const auto count = std::size_t(channels);
  SampleRows all(rows.count(), rows.width * count);
  for (std::size_t s = 0; s < rows.count(); ++s)
    for (std::size_t i = 0; i < all.width; ++i) all.row(s)[i] = rows.row(s)[i / count];
  return all;
}

/// Direct irradiance vectors as rows.
SampleRows directRows(const DirectTransfer& direct, int channels) {
  const auto functions = std::size_t(direct.diffuse.shape[1]);
  SampleRows rows(direct.samples(), functions);
  const std::span<const float> e = direct.diffuse.as<float>();
  for (std::size_t s = 0; s < rows.count(); ++s) std::copy_n(&e[s * functions], functions, rows.row(s));
  return repeated(rows, channels);
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
  SampleRows source;  // e_k, or e_k / albedo^k, as the next bounce is gathered from it
  float share = 1;    // of the total, that the last bounce added

  std::map<std::string, Array> save() const {
    const std::int32_t bounces = result.bounces;
    return {{"bounces", Array::from<std::int32_t>(std::span(&bounces, 1), {1})},
            {"share", Array::from<float>(std::span(&share, 1), {1})},
            {"total", arrayOf(result.total)},
            {"before_last", arrayOf(result.surface)},
            {"last", arrayOf(source)}};
  }

  /// Takes up a saved state of at most `most` bounces, if that is what `arrays` hold.
  void restore(const std::map<std::string, Array>& arrays, int most) {
    const auto number = [&](const char* name, DType type) {
      const auto found = arrays.find(name);
      const bool fits =
          found != arrays.end() && found->second.dtype == type && found->second.bytes.size() == 4;
      return fits ? &found->second : nullptr;
    };
    const Array *bounces = number("bounces", DType::i32), *added = number("share", DType::f32);
    if (!bounces || !added) return;
    Chain next = *this;
    next.result.bounces = bounces->as<std::int32_t>()[0];
    next.share = added->as<float>()[0];
    const bool fits = next.result.bounces > 0 && next.result.bounces <= most &&
                      fillFrom(arrays, "total", next.result.total) &&
                      fillFrom(arrays, "before_last", next.result.surface) &&
                      fillFrom(arrays, "last", next.source);
    if (fits) *this = std::move(next);
  }

  /// One more bounce: `irradiance` times `scale`.
  void add(const SampleRows& irradiance, const Rgb& scale) {
    SampleRows added(result.total.count(), result.total.width);
    addScaled(irradiance, scale, result.channels, added);
    addScaled(irradiance, scale, result.channels, result.total);
    share = float(norm(added) / norm(result.total));
    ++result.bounces;
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

BounceResult bounceBetweenSamples(const Scene& scene, const SampleSet& surface, const DirectTransfer& direct,
                                  BounceGather& gather, AreaMeans* means, const BuriedFill& fill, int bounces,
                                  float stopThreshold, Job& job, const BounceCheckpoint* checkpoint) {
  const BounceColours colours(scene.materials);
  Chain chain;
  BounceResult& result = chain.result;
  result.channels = colours.channels;
  result.total = directRows(direct, colours.channels);
  result.surface = SampleRows(result.total.count(), result.total.width);
  chain.source = directRows(direct, colours.chainChannels);
  if (checkpoint) chain.restore(checkpoint->saved, bounces);
  if (means && result.bounces == 0)
    chain.source = means->corrected(chain.source, repeated(means->direct(), colours.chainChannels));
  Rgb power(1);
  for (int k = 0; k < result.bounces; ++k) power *= colours.common;
  const double rays = gather.rayCount() + (means ? means->rayCount() : 0);
  job.begin("bounces", rays * bounces, "rays");
  job.progress(rays * result.bounces, rays * bounces);
  while (result.bounces < bounces && !(result.bounces > 0 && chain.share < stopThreshold)) {
    addScaled(chain.source, colours.factored ? power : Rgb(1), colours.channels, result.surface);
    SampleRows leaving;
    if (colours.factored) {
      leaving = chain.source;
      for (float& x : leaving.values) x /= kPiF;
      power *= colours.common;
    } else {
      leaving = leavingRadiance(scene, surface, chain.source, colours.chainChannels);
    }
    SampleRows next = gather.irradiance(leaving, job);
    fill.apply(next.values, next.stride);
    chain.add(next, colours.factored ? power : Rgb(1));
    chain.source = means ? means->corrected(next, means->gather(leaving, job)) : std::move(next);
    if (checkpoint && checkpoint->keep) checkpoint->keep(chain.save());
  }
  job.progress(rays * bounces, rays * bounces);
  return std::move(chain.result);
}

}  // namespace prt
