#include "libprt/transport/transfer_bake.h"

#include "libprt/basis/sh_product.h"
#include "libprt/core/error.h"
#include "libprt/core/half.h"
#include "libprt/core/parallel.h"
#include "libprt/transport/bounces.h"
#include "libprt/transport/matrix_store.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

DType storageOf(const TransferSettings& settings, TransferForm form) {
  return settings.storage.value_or(form == TransferForm::Matrix ? DType::f16 : DType::f32);
}

/// Plain rows in their storage type.
Array stored(std::span<const float> values, std::vector<std::int64_t> shape, DType storage, double& error) {
  error = 0;
  if (storage == DType::f32) return Array::from(values, std::move(shape));
  std::vector<std::uint16_t> half(values.size());
  std::vector<float> back(values.size());
  toHalf(values, half);
  fromHalf(half, back);
  double square = 0, difference = 0;
  for (std::size_t i = 0; i < back.size(); ++i) {
    square += double(values[i]) * values[i];
    difference += (double(back[i]) - values[i]) * (double(back[i]) - values[i]);
  }
  error = square > 0 ? std::sqrt(difference / square) : 0;
  Array array{DType::f16, std::move(shape), std::vector<std::byte>(half.size() * 2)};
  std::memcpy(array.bytes.data(), half.data(), array.bytes.size());
  return array;
}

std::vector<std::int64_t> vectorShape(std::size_t samples, int bands, int channels) {
  std::vector<std::int64_t> shape{std::int64_t(samples), shCount(bands)};
  if (channels == 3) shape.push_back(3);
  return shape;
}

/// Rows without their padding.
std::vector<float> dense(const SampleRows& rows) {
  std::vector<float> out(rows.count() * rows.width);
  for (std::size_t s = 0; s < rows.count(); ++s) std::copy_n(rows.row(s), rows.width, &out[s * rows.width]);
  return out;
}

SampleRows padded(const Array& array, std::size_t width) {
  const std::span<const float> values = array.as<float>();
  SampleRows rows(values.size() / width, width);
  for (std::size_t s = 0; s < rows.count(); ++s) std::copy_n(&values[s * width], width, rows.row(s));
  return rows;
}

void checkParts(const Scene& scene, const SampleSet& samples, const DirectTransfer& direct,
                const TransferSettings& settings, TransferForm form, const Transfer* surface,
                const SampleSet* surfaceSamples) {
  const bool fits = direct.samples() == samples.size() && direct.settings.bands == settings.bands &&
                    direct.raysPerSample > 0 && (form == TransferForm::Diffuse || direct.settings.visibility);
  if (!fits)
    throw ValueError("direct transfer is of another bake", "transfer",
                     "bake direct transfer with the same settings");
  if (settings.bounces == 0 || form == TransferForm::Visibility || samples.coversSurface()) return;
  const std::size_t needed = surfaceSamples ? surfaceSamples->size() : scene.mesh.vertexCount();
  const bool serves = surface && surface->bands == settings.bands &&
                      (surface->bounces == 0 || surface->surface.shape.size() >= 2) &&
                      (surface->bounces == 0 || std::size_t(surface->surface.shape[0]) >= needed);
  if (!serves)
    throw ValueError("points off the vertices need the vertices' transfer for their bounces", "transfer",
                     "bake the vertices first");
}

/// Light on the surface before the last bounce, and what the vertices have after it.
struct Bounced {
  int channels = 1;
  int bounces = 0;
  SampleRows total;    // of the samples
  SampleRows surface;  // of the vertices; empty without bounces
};

/// Everything that finishing needs along the way.
class Finish {
 public:
  Finish(const Scene& scene, const RayScene& rays, const SampleSet& samples, const DirectTransfer& direct,
         const TransferSettings& settings, TransferForm form, Job& job, const Transfer* surface,
         const BounceCheckpoint* checkpoint, const SampleSet* surfaceSamples)
      : scene_(scene),
        rays_(rays),
        samples_(samples),
        direct_(direct),
        settings_(settings),
        form_(form),
        job_(job),
        ownSurface_(samples.coversSurface() || surfaceSamples ? SampleSet{} : samplesAtVertices(scene)),
        surfaceSet_(samples.coversSurface() ? samples
                    : surfaceSamples        ? *surfaceSamples
                                            : ownSurface_),
        surface_(surface),
        checkpoint_(checkpoint),
        fill_(scene, samples, direct.buried.as<std::uint8_t>()),
        gather_(scene, rays, surfaceSet_, samples, direct, settings.hitMemory) {}

  Transfer run() {
    Transfer out;
    out.form = form_;
    out.bands = settings_.bands;
    out.samples = samples_.size();
    out.raysPerSample = direct_.raysPerSample;
    out.raysWanted = settings_.rays;
    const Bounced bounced = bounce();
    out.channels = bounced.channels;
    out.bounces = bounced.bounces;
    const auto count = std::int64_t(out.samples);
    const std::vector<float> e = dense(bounced.total);
    if (out.bounces > 0)
      out.surface = Array::from(std::span<const float>(dense(bounced.surface)),
                                vectorShape(bounced.surface.count(), out.bands, out.channels));
    const DType storage = storageOf(settings_, form_);
    if (form_ == TransferForm::Diffuse) {
      out.values = stored(e, vectorShape(out.samples, out.bands, out.channels), storage, out.storageError);
      return out;
    }
    out.diffuse = Array::from(std::span<const float>(e), vectorShape(out.samples, out.bands, out.channels));
    if (form_ == TransferForm::Visibility)
      out.values = stored(direct_.visibility.as<float>(), {count, shCount(2 * out.bands - 1)}, storage,
                          out.storageError);
    else
      out.values = matrices(bounced, storage, out.storageError);
    return out;
  }

 private:
  Bounced bounce() {
    Bounced bounced;
    bounced.total = padded(direct_.diffuse, std::size_t(shCount(settings_.bands)));
    if (settings_.bounces == 0 || form_ == TransferForm::Visibility) return bounced;
    if (samples_.coversSurface()) {
      std::optional<AreaMeans> means;  // previews do without, and texels: they are small
      if (settings_.areaMeans && direct_.final() && !samples_.texels)
        means.emplace(scene_, rays_, samples_, direct_, settings_.hitMemory / 8, job_);
      BounceResult chain =
          bounceBetweenSamples(scene_, samples_, direct_, gather_, means ? &*means : nullptr, fill_,
                               settings_.bounces, settings_.stopThreshold, job_, checkpoint_);
      return {chain.channels, chain.bounces, std::move(chain.total), std::move(chain.surface)};
    }
    if (surface_->bounces == 0) return bounced;
    bounced.channels = surface_->channels;
    bounced.bounces = surface_->bounces;
    bounced.surface = padded(surface_->surface, std::size_t(shCount(settings_.bands) * surface_->channels));
    job_.begin("bounces", gather_.rayCount(), "rays");
    const SampleRows gathered =
        gather_.irradiance(leavingRadiance(scene_, surfaceSet_, bounced.surface, bounced.channels), job_);
    const SampleRows direct = std::move(bounced.total);
    bounced.total = gathered;
    for (std::size_t s = 0; s < direct.count(); ++s)
      for (std::size_t i = 0; i < gathered.width; ++i)
        bounced.total.row(s)[i] += direct.row(s)[i / std::size_t(bounced.channels)];
    return bounced;
  }

  Array matrices(const Bounced& bounced, DType storage, double& storageError) {
    const auto functions = std::size_t(shCount(settings_.bands)), channels = std::size_t(bounced.channels);
    const MatrixLayout layout{samples_.size(), channels, functions};
    MatrixPacker packer(layout, storage);
    if (bounced.bounces > 0) {
      job_.begin("transfer matrices", gather_.rayCount(), "rays");
      const SampleRows leaving = leavingRadiance(scene_, surfaceSet_, bounced.surface, bounced.channels);
      gather_.directional(settings_.bands, leaving, job_, [&](std::size_t sample, const float* indirect) {
        packer.pack(sample, withDirect(sample, indirect, channels).data());
      });
    } else {
      parallelFor(job_, 0, samples_.size(), kBakeTile, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) packer.pack(s, withDirect(s, nullptr, channels).data());
      });
    }
    return packer.take(fill_, storageError);
  }

  /// T_0 in every channel, plus what bounces add (null: nothing).
  std::vector<float> withDirect(std::size_t sample, const float* indirect, std::size_t channels) const {
    const auto functions = std::size_t(shCount(settings_.bands)),
               wide = std::size_t(shCount(2 * settings_.bands - 1));
    std::vector<float> direct(functions * functions), matrix(direct.size() * channels);
    expandVisibility(settings_.bands, direct_.visibility.as<float>().subspan(sample * wide, wide), direct);
    for (std::size_t i = 0; i < matrix.size(); ++i)
      matrix[i] = direct[i / channels] + (indirect ? indirect[i] : 0.0f);
    return matrix;
  }

  const Scene& scene_;
  const RayScene& rays_;
  const SampleSet& samples_;
  const DirectTransfer& direct_;
  const TransferSettings& settings_;
  TransferForm form_;
  Job& job_;
  SampleSet ownSurface_;
  const SampleSet& surfaceSet_;
  const Transfer* surface_;
  const BounceCheckpoint* checkpoint_;
  BuriedFill fill_;
  BounceGather gather_;
};

}  // namespace

void check(const TransferSettings& settings) {
  const auto inRange = [](const std::string& path, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw ValueError(
        "is out of range", path,
        "use " + std::to_string(std::int64_t(low)) + " to " + std::to_string(std::int64_t(high)));
  };
  inRange("transfer.bands", settings.bands, 1, 10);
  inRange("transfer.rays", settings.rays, 1, kMaxRays);
  inRange("transfer.bounces", settings.bounces, 0, kMaxBounces);
  inRange("transfer.threshold", settings.stopThreshold, 0, 1);
  if (settings.storage && *settings.storage != DType::f16 && *settings.storage != DType::f32)
    throw ValueError("cannot store transfer as " + toString(*settings.storage), "transfer.storage",
                     "use f16 or f32");
  if (settings.form == TransferForm::Visibility && settings.bounces > 0 && settings.shadows)
    throw ValueError("the visibility form holds shadows only", "transfer.kind",
                     "use matrix, or set transfer.bounces to 0");
}

TransferForm resolveForm(const TransferSettings& settings, std::span<const Material> materials) {
  if (!settings.shadows) return TransferForm::None;
  if (settings.form) return *settings.form;
  if (std::ranges::none_of(materials, [](const Material& m) { return m.glossy(); }))
    return TransferForm::Diffuse;
  return settings.bounces == 0 ? TransferForm::Visibility : TransferForm::Matrix;
}

DirectSettings directSettings(const TransferSettings& settings, TransferForm form) {
  DirectSettings direct;
  direct.bands = settings.bands;
  direct.rays = settings.rays;
  direct.visibility = form == TransferForm::Visibility || form == TransferForm::Matrix;
  direct.seed = settings.seed;
  direct.hitMemory = settings.bounces > 0 && form != TransferForm::Visibility ? settings.hitMemory : 0;
  return direct;
}

Transfer finishTransfer(const Scene& scene, const RayScene& rays, const SampleSet& samples,
                        const DirectTransfer& direct, const TransferSettings& settings, TransferForm form,
                        Job& job, const Transfer* surface, const BounceCheckpoint* checkpoint,
                        const SampleSet* surfaceSamples) {
  check(settings);
  if (form == TransferForm::None) {
    Transfer none;
    none.bands = settings.bands;
    none.samples = samples.size();
    return none;
  }
  checkParts(scene, samples, direct, settings, form, surface, surfaceSamples);
  return Finish(scene, rays, samples, direct, settings, form, job, surface, checkpoint, surfaceSamples).run();
}

Transfer bakeTransfer(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
                      std::shared_ptr<const SampleSet> samples, const TransferSettings& settings, Job& job,
                      const std::function<void(Transfer)>& preview) {
  check(settings);
  const TransferForm form = resolveForm(settings, scene->materials);
  if (form == TransferForm::None) return finishTransfer(*scene, *rays, *samples, {}, settings, form, job);
  DirectBake bake(scene, rays, samples, directSettings(settings, form));
  while (!bake.done()) {
    bake.advance(job);
    if (preview && !bake.done())
      preview(finishTransfer(*scene, *rays, *samples, bake.product(job), settings, form, job));
  }
  return finishTransfer(*scene, *rays, *samples, bake.product(job), settings, form, job);
}

}  // namespace prt
