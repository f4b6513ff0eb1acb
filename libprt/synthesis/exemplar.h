#pragma once
// The exemplar of texture synthesis: what a radiance transfer texture looks like around each of its texels,
// at several scales, in a few numbers. Texels whose numbers are alike look alike from every side under every
// light. (Tong et al. 2002 measured textons instead; appearance vectors are Lefebvre and Hoppe 2006,
// "Appearance-space texture synthesis".)
//
// Made in three steps: the table as a product of few terms (weighted by the roots of solid angles, see
// meso/rtt_compress.h), for each texel the terms of a window around it, blurred to its scale, and of those
// the principal components. The patch repeats, so windows go around its border.

#include "libprt/core/job.h"
#include "libprt/meso/rtt.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

inline constexpr int kAppearance = 8;  ///< numbers of an appearance vector

/// The exemplar at one scale. Texel (u, v) has the index v * texels + u.
struct ExemplarLevel {
  double spacing = 1;  ///< texels from one sample to the next at this scale
  /// [turns, texel, kAppearance] of the patch turned counter-clockwise by 2 pi / turns times the first index.
  /// Two texels drawn at random are at a mean squared distance of 1; all zero for a patch of one colour.
  std::vector<float> appearance;
  /// [turns, texel, similar] texels of the patch as it is that look most like the turned one, best first, far
  /// apart from each other and, where nothing is turned, from the texel itself.
  std::vector<std::uint32_t> similar;
  double kept = 1;  ///< part of the variance of all windows that kAppearance numbers hold

  const float* at(int turn, std::uint32_t texel, std::size_t texels2) const {
    return appearance.data() + (std::size_t(turn) * texels2 + texel) * kAppearance;
  }
};

struct Exemplar {
  int texels = 0;                     ///< a side
  int turns = 1;                      ///< the symmetry of the orientation field: 1, 2 or 4
  int similar = 0;                    ///< texels per set
  std::vector<ExemplarLevel> levels;  ///< the finest first

  std::size_t count() const { return std::size_t(texels) * std::size_t(texels); }
};

struct ExemplarOptions {
  int turns = 1;    ///< 1, 2 or 4
  int terms = 12;   ///< of the table, 1..64
  int similar = 3;  ///< texels per set, 1..8
  std::vector<double> spacings =
      {};  ///< texels between samples, of every level; at most a quarter of the side
};

/// Same result for any number of threads. Throws ValueError for options out of range, Cancelled.
Exemplar makeExemplar(const Rtt& rtt, const ExemplarOptions& options, Job& job);

/// The table as seen when the patch is turned counter-clockwise by `quarters` quarter turns: same texels,
/// each with its views and lights turned.
Rtt turnedResponses(const Rtt& rtt, int quarters);

}  // namespace prt
