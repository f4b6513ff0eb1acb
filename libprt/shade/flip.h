#pragma once
// FLIP: how visible the differences are to somebody who flips between two images.
//   LDR: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild 2020, "FLIP: A Difference
//        Evaluator for Alternating Images".
//   HDR: Andersson, Nilsson, Shirley and Akenine-Moeller 2021, "Visualizing Errors in Rendered High
//        Dynamic Range Images": the worst LDR difference over a range of exposures.
// 0 = no visible difference, 1 = the largest possible.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/shade/metrics.h"

namespace prt {

/// Pixels per degree of a 0.7 m wide 3840-pixel screen seen from 0.7 m: the papers' standard.
inline constexpr float kFlipPixelsPerDegree = 67.0206f;

struct FlipResult {
  double mean = 0;                            ///< over the counted pixels
  Image map;                                  ///< one channel, 0..1; 0 where the mask leaves out
  int exposures = 1;                          ///< HDR only: how many were tried
  float firstExposure = 0, lastExposure = 0;  ///< HDR only: stops
};

/// Both images hold linear Rec.709 colour in 0..1 (clamped) - decode sRGB files first. Masked pixels
/// are black in both. Throws ValueError when sizes differ.
FlipResult ldrFlip(const Image& image, const Image& reference, const PixelMask& mask, Job& job,
                   float pixelsPerDegree = kFlipPixelsPerDegree);

/// Linear radiance of any range, negative values as 0. The range of exposures comes from the counted
/// pixels of the reference, which makes the measure asymmetric.
FlipResult hdrFlip(const Image& image, const Image& reference, const PixelMask& mask, Job& job,
                   float pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace prt
