#pragma once
// Both scales together: transferred light at the vertices meets the patch's response at the pixels (Bi-Scale
// Radiance Transfer, equation 4):
//   exit radiance = sum over i of B_i(u, v) (M_p L)_i,
// with (u, v) from the id map or the mesh's coordinates, v the view in the local frame, and M_p L
// interpolated over the triangle in the frames of its corners. Radiance below zero becomes 0; no pixel is
// ever NaN; the result does not depend on threads. Objects that carry no patch show their material, see
// plain_objects.h.

#include "libprt/basis/sh.h"
#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/light/light_rig.h"
#include "libprt/shade/biscale_view.h"
#include "libprt/shade/surroundings.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/transfer.h"

#include <span>
#include <vector>

namespace prt {

/// Transferred radiance at the frames that a view needs, in these frames.
class BiscaleLight {
 public:
  BiscaleLight() = default;
  /// `samples` begin with the vertices of the scene. The form Diffuse holds too little but for matte
  /// surfaces: ValueError. Functions that transfer or light lack are 0; those that `surface.responses` lacks
  /// are left out.
  BiscaleLight(const BiscaleSurface& surface, std::span<const std::uint32_t> frames, const SampleSet& samples,
               const Transfer& transfer, const ShRgb& light, Job& job);

  /// [3][padded] floats of a frame, by its place in BiscaleView::frames.
  const float* radiance(std::uint32_t place) const { return records_.data() + place * 3 * padded_; }
  std::size_t padded() const { return padded_; }
  /// Those of all frames, one after the other.
  std::span<const float> records() const { return records_; }

 private:
  void takeIrradiance(std::span<const std::uint32_t> place, std::span<const Rgb> irradiance);

  std::size_t padded_ = 0;
  std::vector<float> records_;
};

/// Linear radiance of a fragment of a tile of a view of `surface`.
Rgb shadeBiscale(const BiscaleTile& tile, const BiscaleFragment& fragment, const BiscaleLight& light,
                 const BiscaleSurface& surface);

struct BiscaleInput {
  const BiscaleSurface& surface;
  const SampleSet& samples;
  const Transfer& transfer;  ///< None: no macro transport
  const ShRgb& light;
  const LightRig* background = nullptr;  ///< seen behind the scene; null = black, alpha = coverage
  bool viewDependent = true;
  const Surroundings* surroundings = nullptr;  ///< objects that are seen with it; null = none
};

/// Float RGBA, premultiplied. Throws ValueError when sizes do not fit, Cancelled.
Image renderBiscale(const BiscaleInput& input, const Camera& camera, int width, int height, int grid,
                    Job& job);

}  // namespace prt
