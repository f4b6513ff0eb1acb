#pragma once
// One gather over what the rays of a bake hit: the operator that takes light leaving the surface to the
// irradiance, or the directional light, that it brings elsewhere. Internal to transport and meso.

#include "libprt/core/job.h"
#include "libprt/transport/direct_transfer.h"
#include "libprt/transport/hit_blocks.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace prt {

/// Rows of numbers, one row per sample, padded to whole vectors of 8 so that they can be added quickly.
struct SampleRows {
  std::size_t width = 0;   ///< used numbers per row
  std::size_t stride = 0;  ///< width rounded up to 8; what is beyond stays zero
  std::vector<float> values;

  SampleRows() = default;
  SampleRows(std::size_t count, std::size_t rowWidth)
      : width(rowWidth), stride((rowWidth + 7) / 8 * 8), values(count * stride, 0.0f) {}
  float* row(std::size_t i) { return values.data() + i * stride; }
  const float* row(std::size_t i) const { return values.data() + i * stride; }
  std::size_t count() const { return stride ? values.size() / stride : 0; }
};

/// Gathers over the rays of a direct bake: remembered hits where there are, else traced again.
class BounceGather {
 public:
  /// Light bounces between the samples of `surface`, the scene's vertices or texels and their backs; those of
  /// `samples` gather, with the rays of `direct`. All must outlive this object.
  BounceGather(const Scene& scene, const RayScene& rays, const SampleSet& surface, const SampleSet& samples,
               const DirectTransfer& direct, std::size_t hitMemory);

  /// What light leaving the surface (a row of radiance coefficients per surface sample) brings to each
  /// sample as irradiance.
  SampleRows irradiance(const SampleRows& leaving, Job& job);

  /// The same with its directions: use(sample, matrix) gets at matrix[k * leaving.width + j] the k-th
  /// coefficient (object frame, bands^2 of them) of the incident radiance that the j-th leaving one makes.
  /// Called once per sample, by several threads at once. Needs uniform rays.
  using UseMatrix = std::function<void(std::size_t sample, const float* matrix)>;
  void directional(int bands, const SampleRows& leaving, Job& job, const UseMatrix& use);

  /// Rays that one gather goes over.
  double rayCount() const { return double(samples_.size()) * direct_.raysPerSample; }

 private:
  /// Calls body(tile, hits of its rays in [begin, end), table) for the tiles [firstTile, lastTile); a table
  /// with functions of `bands` bands, or with just directions and only where rays are traced, when 0.
  using TileBody = std::function<void(
      std::size_t tile, std::span<const std::shared_ptr<const HitBlock>> blocks, const RayTable* table)>;
  void overChunk(int begin, int end, std::size_t firstTile, std::size_t lastTile, int bands, Job& job,
                 const TileBody& body);
  std::shared_ptr<const HitBlock> trace(const RayTable& table, std::size_t tile, Job& job) const;
  std::size_t tileCount() const { return (samples_.size() + kBakeTile - 1) / kBakeTile; }
  std::size_t tileSize(std::size_t tile) const {
    return std::min(samples_.size() - tile * kBakeTile, kBakeTile);
  }

  const Scene& scene_;
  const RayScene& rays_;
  const SampleSet &surface_, &samples_;
  const DirectTransfer& direct_;
  RaySpread spread_;
  std::size_t hitMemory_;
  std::atomic<std::size_t> hitBytes_{0};
  HitBlocks hits_;
};

}  // namespace prt
