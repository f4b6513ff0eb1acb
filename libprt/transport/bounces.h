#pragma once
// The chain of diffuse bounces between the vertices of a scene, or the texels of its atlas. Internal to
// transport.

#include "libprt/core/job.h"
#include "libprt/transport/area_means.h"
#include "libprt/transport/bounce_gather.h"
#include "libprt/transport/buried.h"
#include "libprt/transport/transfer_bake.h"

#include <span>
#include <vector>

namespace prt {

/// How colours go through the chain. A chain of one channel serves every scene whose albedos are all grey, or
/// all equal: then bounce k is the albedo-free chain times albedo^k.
struct BounceColours {
  int chainChannels = 1;  ///< channels that are gathered
  int channels = 1;       ///< channels of the result
  bool factored = false;  ///< albedo^k is applied afterwards
  Rgb common{0};          ///< that albedo

  explicit BounceColours(std::span<const Material> materials);
};

/// Light leaving the surface: albedo / pi times irradiance, for every sample of the surface set. `channels`
/// of `irradiance`'s rows vary fastest.
SampleRows leavingRadiance(const Scene& scene, const SampleSet& surface, const SampleRows& irradiance,
                           int channels);

/// Irradiance vectors of the surface samples, rows of n^2 * channels numbers.
struct BounceResult {
  int channels = 1;
  int bounces = 0;
  SampleRows total;    ///< e_0 + ... + e_bounces
  SampleRows surface;  ///< e_0 + ... + e_(bounces-1), each as the next bounce was gathered from it
};

/// Adds bounces to the direct irradiance until `bounces` are done or one adds less than `stopThreshold` of
/// the total (Frobenius norms). `gather` must gather at the surface set itself. Without `means` light leaves
/// from the bare values at the samples. `checkpoint` may be null.
BounceResult bounceBetweenSamples(const Scene& scene, const SampleSet& surface, const DirectTransfer& direct,
                                  BounceGather& gather, AreaMeans* means, const BuriedFill& fill, int bounces,
                                  float stopThreshold, Job& job,
                                  const BounceCheckpoint* checkpoint = nullptr);

}  // namespace prt
