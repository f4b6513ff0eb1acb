#pragma once
// What the rays of a bake meet, kept small, so that one tracing serves every bounce. Internal to transport.

#include "libprt/transport/bake_rays.h"
#include "libprt/transport/ray_scene.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace prt {

/// Hits that reflect light, of the samples of one tile and a run of rays: 10 bytes each, 14 when rays
/// spread uniformly. Hits of one sample follow each other in order of ray numbers.
struct HitBlock {
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };
  HitBlock(int begin, int end, std::size_t sampleCount)
      : beginRay(begin), endRay(end), samples(sampleCount) {}

  int beginRay, endRay;
  std::vector<Range> samples;              ///< [tile samples] each sample's hits
  std::vector<std::uint32_t> triangle;     ///< highest bit: met from behind, on a two-sided surface
  std::vector<std::uint32_t> barycentric;  ///< weights of corners 1 and 2 in 16 bits each, low half first
  std::vector<std::uint16_t> ray;          ///< number from beginRay
  std::vector<float> cosine;               ///< to the shading normal, clamped; empty when rays spread with it

  /// Gives back what the vectors hold in reserve.
  void shrink() {
    triangle.shrink_to_fit(), barycentric.shrink_to_fit(), ray.shrink_to_fit(), cosine.shrink_to_fit();
  }
  std::size_t bytes() const {
    return samples.size() * sizeof(Range) + triangle.size() * (cosine.empty() ? 10 : 14);
  }
};

inline constexpr std::uint32_t kBackHit = 0x80000000u;

/// Hit blocks of all tiles as far as they are kept: tile t has those of rays 0 .. covered(t), in order.
/// Blocks are immutable and shared, copies cheap.
class HitBlocks {
 public:
  HitBlocks() = default;
  explicit HitBlocks(std::size_t tiles) : tiles_(tiles) {}

  int covered(std::size_t tile) const {
    return tile < tiles_.size() && !tiles_[tile].empty() ? tiles_[tile].back()->endRay : 0;
  }
  const std::vector<std::shared_ptr<const HitBlock>>& of(std::size_t tile) const { return tiles_[tile]; }
  /// Keeps a block that goes on where the tile's last one ended. Different tiles may be added to at once.
  void add(std::size_t tile, std::shared_ptr<const HitBlock> block) {
    tiles_[tile].push_back(std::move(block));
  }
  std::size_t bytes() const;

 private:
  std::vector<std::vector<std::shared_ptr<const HitBlock>>> tiles_;
};

/// Traces the rays of a table from one sample after the other. One per thread at a time.
class SampleTracer {
 public:
  SampleTracer(const Scene& scene, const RayScene& rays, const SampleSet& samples, RaySpread spread,
               std::uint64_t seed, const RayTable& table);

  /// visible[r] = 1 where ray r, in order of numbers, meets nothing and leaves above the geometric
  /// horizon, else 0. `cosine`, unless empty, gets the same times the cosine to the shading normal, clamped.
  /// With a block, what reflects light is added to it as sample `place`.
  void trace(std::size_t sample, std::span<float> visible, std::span<float> cosine, HitBlock* block = nullptr,
             std::size_t place = 0);

 private:
  void findBlocked(const Vec3& origin, bool hits);
  void clipAtHorizon(const Vec3& normal);
  void keepHits(HitBlock& block, std::size_t place);

  const Scene& scene_;
  const RayScene& rays_;
  const SampleSet& samples_;
  RaySpread spread_;
  std::uint64_t seed_;
  const RayTable& table_;
  // Of the sample's rays, in tracing order:
  WorldRays directions_;
  std::vector<std::uint8_t> blocked_;
  std::vector<float> cosine_;             // to the shading normal, clamped
  std::vector<Hit> hits_;                 // invalid where below the horizon
  std::span<const std::uint16_t> order_;  // ray number at each place
  std::vector<std::uint16_t> place_;      // place of each ray
};

}  // namespace prt
