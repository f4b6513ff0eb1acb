#pragma once
// Pictures from precomputed transfer, on the CPU: rasterised, shaded once per fragment, multi-threaded.
//
//   Diffuse  irradiance at the samples (vertices, or the texels around the place), interpolated, times
//            albedo/pi. Where the stored form keeps
//            radiance apart from the normal (None, Visibility, Matrix) transferred radiance is interpolated
//            and met with the pixel's own normal; what its few bands miss of the exact irradiance at the
//            samples, which these forms hold too, is interpolated and added.
//   Glossy   transferred radiance (object frame) interpolated over the surface, dotted with the
//            response of the BRDF towards the viewer at the pixel (Kautz 2002;
//            libprt/material/glossy_response.h).
//
// Surfaces seen from behind are black unless their material is two-sided. Radiance below zero (ringing
// of truncated harmonics) becomes 0. No pixel is ever NaN. The result does not depend on threads.

#include "libprt/basis/sh.h"
#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/light/light_rig.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/raster.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"
#include "libprt/transport/transfer.h"

#include <span>

namespace prt {

struct Surroundings;

enum class ShadeMethod {
  Auto,  ///< Glossy when a material is and the stored form can show it, else Diffuse
  Diffuse,
  Glossy  ///< not with the Diffuse form
};

/// What is seen. Everything referred to must outlive the call.
struct RenderInput {
  const Scene& scene;
  const SampleSet& samples;  ///< samplesAtVertices(scene), or samplesAtTexels() of its charts
  const Transfer& transfer;  ///< over `samples`
  const ShRgb& light;        ///< bands that the transfer lacks are left out
  ShadeMethod method = ShadeMethod::Auto;
  /// Irradiance at each sample, [S], to be shown in place of transfer and light (Diffuse only): for
  /// light that was computed in another way. Empty = not given.
  std::span<const Rgb> irradiance = {};
  const LightRig* background = nullptr;  ///< seen behind the scene; null = black, alpha = coverage
  /// Of each object: radiance of its own that its reflecting sides send. Empty = none.
  std::span<const Rgb> emission = {};
  /// render(): objects that are seen with the scene, see surroundings.h; null = none.
  const Surroundings* surroundings = nullptr;
};

/// Which of Diffuse and Glossy `method` means for this scene and transfer. Throws ValueError for Glossy
/// with the Diffuse form or given irradiance.
ShadeMethod resolveMethod(const RenderInput& input);

/// Shades what `view` sees; float RGBA, premultiplied. For the form None `samples` tell no more than which
/// places have a back side. Work is proportional to what is seen: transfer is
/// applied only at samples of visible triangles. Throws ValueError when sizes or bands do not match.
Image shade(const RenderInput& input, const FragmentImage& view, const Camera& camera, Job& job);

/// Rasterises with grid x grid samples per pixel, then shades, and adds surroundings and background.
Image render(const RenderInput& input, const Camera& camera, int width, int height, int grid, Job& job);

}  // namespace prt
