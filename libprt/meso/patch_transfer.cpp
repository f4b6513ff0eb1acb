#include "libprt/meso/patch_transfer.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/meso/neumann_tail.h"
#include "libprt/transport/bake_rays.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace prt {
namespace {

DirectSettings directSettings(const PatchTransferSettings& settings) {
  if (settings.bounces < 0 || settings.bounces > kMaxPatchBounces)
    throw ValueError("cannot bounce " + std::to_string(settings.bounces) + " times", "rtt.bounces",
                     "use 0 to " + std::to_string(kMaxPatchBounces));
  DirectSettings direct;
  direct.bands = settings.bands;
  direct.rays = settings.rays;
  direct.seed = settings.seed;
  direct.hitMemory = settings.bounces > 0 ? settings.hitMemory : 0;
  direct.phase = "light on the patch";
  return direct;
}

/// How colour goes through the bounces of a patch, as BounceColours does for objects.
struct PatchColours {
  bool uniform = true;  ///< one albedo everywhere: the chain is gathered without it
  bool grey = true;
  std::vector<Rgb> albedo;  ///< [V]

  explicit PatchColours(const Patch& patch) {
    for (std::size_t v = 0; v < patch.albedo.size(); ++v) {
      const Rgb c = patch.albedo[v] * lookUp(patch.albedoTexture, Vec2(patch.mesh.positions[v]));
      albedo.push_back(c);
      grey = grey && c.x == c.y && c.y == c.z;
      uniform = uniform && c == albedo.front();
    }
  }
  int channels() const { return grey ? 1 : 3; }
  int chainChannels() const { return grey || uniform ? 1 : 3; }
};

/// Rows of samples at all vertices.
SampleRows atVertices(const SampleRows& samples, std::span<const std::uint32_t> sampleOf) {
  SampleRows out(sampleOf.size(), samples.width);
  for (std::size_t v = 0; v < sampleOf.size(); ++v)
    std::copy_n(samples.row(sampleOf[v]), samples.stride, out.row(v));
  return out;
}

/// Every number `times` times in a row.
SampleRows repeated(const SampleRows& rows, int times) {
  SampleRows out(rows.count(), rows.width * std::size_t(times));
  for (std::size_t s = 0; s < rows.count(); ++s)
    for (std::size_t i = 0; i < out.width; ++i) out.row(s)[i] = rows.row(s)[i / std::size_t(times)];
  return out;
}

double squares(const SampleRows& rows) {
  double sum = 0;
  for (const float x : rows.values) sum += double(x) * x;
  return sum;
}

/// Light that came out the same in all channels - nothing bounced - needs one.
void foldGrey(PatchLight& light) {
  for (std::size_t v = 0; v < light.rows.count(); ++v)
    for (std::size_t i = 0; i < light.rows.width; i += 3) {
      const float* rgb = light.rows.row(v) + i;
      if (rgb[0] != rgb[1] || rgb[0] != rgb[2]) return;
    }
  SampleRows grey(light.rows.count(), light.lights);
  for (std::size_t v = 0; v < grey.count(); ++v)
    for (std::size_t i = 0; i < light.lights; ++i) grey.row(v)[i] = light.rows.row(v)[3 * i];
  light.rows = std::move(grey);
  light.channels = 1;
}

/// The chain of bounces e_{k+1} = G (albedo / pi) e_k.
class Chain {
 public:
  Chain(const PatchScene& patch, BounceGather& gather)
      : patch_(patch), gather_(gather), colours_(*patch.patch) {}

  /// Adds up `bounces` bounces of the direct light of some samples; without e_0 itself unless `withDirect`.
  SampleRows run(const SampleRows& direct, const PatchTransferSettings& settings, bool withDirect, int& done,
                 Job& job) {
    const int channels = colours_.channels();
    SampleRows last = repeated(direct, colours_.chainChannels());
    SampleRows total(direct.count(), direct.width * std::size_t(channels));
    if (withDirect) add(direct, Rgb(1), total);
    NeumannTail tail(colours_.chainChannels());
    Rgb power(1);
    for (done = 0; done < settings.bounces; ++done) {
      last = gather_.irradiance(leaving(last), job);
      if (squares(last) == 0) return total;  // nothing sees anything
      if (colours_.uniform) power *= colours_.albedo.front();
      if (settings.bounces >= kAllBounces) tail.add(last);
      const double sum = squares(total);
      add(last, colours_.uniform ? power : Rgb(1), total);
      const double added = squares(last) * double(power.x * power.x);
      const double share = double(settings.stopThreshold);
      if (share > 0 && added < share * share * sum) return ++done, total;
    }
    if (settings.bounces >= kAllBounces) {
      const Rgb common = colours_.uniform ? colours_.albedo.front() : Rgb(1);
      tail.extrapolate(std::span(&common.x, std::size_t(channels)), total, job);
    }
    return total;
  }

  int channels() const { return colours_.channels(); }

 private:
  /// Radiance that leaves the vertices, without the albedo where it is the same everywhere.
  SampleRows leaving(const SampleRows& samples) const {
    SampleRows rows = atVertices(samples, patch_.sampleOf);
    const auto channels = std::size_t(colours_.chainChannels());
    for (std::size_t v = 0; v < rows.count(); ++v) {
      const Rgb factor = (colours_.uniform ? Rgb(1) : colours_.albedo[v]) / kPiF;
      float* row = rows.row(v);
      for (std::size_t i = 0; i < rows.width; ++i) row[i] *= factor[int(i % channels)];
    }
    return rows;
  }

  /// to += scale * from, where `from` may have one channel for the three of `to`.
  void add(const SampleRows& from, const Rgb& scale, SampleRows& to) const {
    const std::size_t spread = to.width / from.width, channels = std::size_t(colours_.channels());
    for (std::size_t s = 0; s < to.count(); ++s)
      for (std::size_t i = 0; i < to.width; ++i)
        to.row(s)[i] += scale[int(i % channels)] * from.row(s)[i / spread];
  }

  const PatchScene& patch_;
  BounceGather& gather_;
  PatchColours colours_;
};

}  // namespace

void PatchLight::at(const TriMesh& mesh, std::uint32_t triangle, const Vec2& b, float* out) const {
  const UVec3& t = mesh.triangles[triangle];
  const float w0 = 1 - b.x - b.y, w1 = b.x, w2 = b.y;
  const float *r0 = rows.row(t.x), *r1 = rows.row(t.y), *r2 = rows.row(t.z);
  for (std::size_t i = 0; i < rows.width; ++i) out[i] = w0 * r0[i] + w1 * r1[i] + w2 * r2[i];
}

PatchTransferBake::PatchTransferBake(const PatchScene& patch, const PatchTransferSettings& settings)
    : patch_(patch),
      settings_(settings),
      bake_(patch.scene, patch.rays, patch.samples, directSettings(settings)) {}

double PatchTransferBake::raysTraced() const {
  const int done = bake_.level();
  return done == 0
             ? 0
             : double(bakeLevels(settings_.rays)[std::size_t(done - 1)]) * double(patch_.samples->size());
}

PatchLight PatchTransferBake::basisLight(Job& job) const {
  const DirectTransfer direct = bake_.product(job);
  const auto lights = std::size_t(direct.settings.bands) * std::size_t(direct.settings.bands);
  SampleRows rows(direct.samples(), lights);
  const std::span<const float> e = direct.diffuse.as<float>();
  for (std::size_t s = 0; s < rows.count(); ++s) std::copy_n(&e[s * lights], lights, rows.row(s));
  return bounced(std::move(rows), lights, true, job);
}

PatchLight PatchTransferBake::directionalLight(std::span<const Vec3> directions, bool withDirect,
                                               Job& job) const {
  const SampleSet& samples = *patch_.samples;
  std::vector<float> x, y, z;
  for (const Vec3& d : directions) x.push_back(d.x), y.push_back(d.y), z.push_back(d.z);
  SampleRows rows(samples.size(), directions.size());
  job.begin("shadows on the patch", double(samples.size() * directions.size()), "rays");
  parallelFor(job, 0, samples.size(), kBakeTile, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint8_t> blocked(directions.size());
    for (std::size_t s = begin; s < end; ++s) {
      if (s % 16 == 0) job.checkCancelled();
      patch_.rays->occludedFrom(samples.origin[s], x, y, z, blocked);
      for (std::size_t l = 0; l < directions.size(); ++l)
        if (!blocked[l] && dot(samples.geometricNormal[s], directions[l]) > 0)
          rows.row(s)[l] = std::max(0.0f, dot(samples.shadingNormal[s], directions[l]));
    }
    job.advance(double((end - begin) * directions.size()));
  });
  return bounced(std::move(rows), directions.size(), withDirect, job);
}

PatchLight PatchTransferBake::bounced(SampleRows direct, std::size_t lights, bool withDirect,
                                      Job& job) const {
  const DirectTransfer rays = bake_.product(job);
  BounceGather gather(*patch_.scene, *patch_.rays, *patch_.samples, *patch_.samples, rays,
                      settings_.hitMemory);
  PatchLight light;
  light.lights = lights;
  light.rays = rays.raysPerSample;
  if (settings_.bounces > 0)
    job.begin("light inside the patch", gather.rayCount() * settings_.bounces, "rays");
  Chain chain(patch_, gather);
  const SampleRows total = chain.run(direct, settings_, withDirect, light.bounces, job);
  light.channels = chain.channels();
  light.rows = atVertices(total, patch_.sampleOf);
  if (light.channels == 3) foldGrey(light);
  return light;
}

}  // namespace prt
