#include "libprt/shade/surface_light.h"

#include "libprt/core/parallel.h"
#include "libprt/material/glossy_response.h"

#include <array>

namespace prt {

Rgb lambertRadiance(int bands, const Vec3& normal, std::span<const Rgb> incident) {
  std::array<float, kMaxResponseBands * kMaxResponseBands> response;
  lambertResponse(bands, normal, response);
  Rgb sum(0);
  for (std::size_t k = 0; k < incident.size(); ++k) sum += response[k] * incident[k];
  return sum;
}

SurfaceLight surfaceLight(const Transfer& transfer, const ShRgb& light, const SampleSet& samples,
                          std::optional<std::span<const std::uint32_t>> which) {
  SurfaceLight out{transfer.form, transfer.bands, {}, {}, {}};
  const auto& normals = samples.shadingNormal;
  const auto irradianceAt = [&] {
    return which ? irradiance(transfer, light, normals, *which) : irradiance(transfer, light, normals);
  };
  switch (transfer.form) {
    case TransferForm::None:
      out.radiance = light.c;
      out.radiance.resize(std::size_t(shCount(out.bands)), Rgb(0));
      break;
    case TransferForm::Diffuse:
      out.irradiance = irradianceAt();
      break;
    case TransferForm::Visibility:
    case TransferForm::Matrix:
      out.radiance =
          which ? transferredRadiance(transfer, light, *which) : transferredRadiance(transfer, light);
      if (transfer.diffuse.bytes.empty()) break;
      out.beyond = irradianceAt();
      const std::size_t n = std::size_t(shCount(out.bands));
      Job job;
      parallelFor(job, 0, out.beyond.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Vec3& normal = normals[which ? (*which)[i] : i];
          const auto incident = std::span<const Rgb>(out.radiance).subspan(i * n, n);
          out.beyond[i] = out.beyond[i] / kPiF - lambertRadiance(out.bands, normal, incident);
        }
      });
      break;
  }
  return out;
}

}  // namespace prt
