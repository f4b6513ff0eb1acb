#pragma once
// What reaches the samples of a surface under given light, in the form that pictures are made from. The CPU
// renderer, the GL renderer and the studio all start here.

#include "libprt/basis/sh.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/transfer.h"

#include <optional>
#include <span>
#include <vector>

namespace prt {

/// What a white diffuse surface reflects of incident radiance in `bands` bands: irradiance / pi.
Rgb lambertRadiance(int bands, const Vec3& normal, std::span<const Rgb> incident);

struct SurfaceLight {
  TransferForm form = TransferForm::None;
  int bands = 0;
  /// Diffuse: irradiance, [S].
  std::vector<Rgb> irradiance;
  /// Visibility and Matrix: transferred radiance, [S * bands^2]; None: the light itself, [bands^2].
  std::vector<Rgb> radiance;
  /// Visibility and Matrix: what a white diffuse surface reflects beyond what `radiance` gives it, [S]. Light
  /// times visibility goes beyond any number of bands, and the cosine meets it there. Empty where nothing
  /// is known of it.
  std::vector<Rgb> beyond;
};

/// At all samples, or at those of a list, in its order. Bands that the light lacks are 0.
SurfaceLight surfaceLight(const Transfer& transfer, const ShRgb& light, const SampleSet& samples,
                          std::optional<std::span<const std::uint32_t>> which = {});

}  // namespace prt
