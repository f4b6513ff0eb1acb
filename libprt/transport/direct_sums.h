#pragma once
// The running sums of a direct bake: what has been traced, tile by tile. Internal to transport.

#include "libprt/core/array.h"
#include "libprt/core/job.h"
#include "libprt/transport/direct_transfer.h"
#include "libprt/transport/hit_blocks.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace prt {

struct DirectSums {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const RayScene> rays;
  std::shared_ptr<const SampleSet> samples;
  DirectSettings settings;
  RaySpread spread;
  int bands;         ///< of the summed functions: 2n-1 for visibility, else n
  int stride;        ///< floats per sample in `open`
  int cosineStride;  ///< floats per sample in `cosine`; 0 without visibility

  std::vector<float> open;        ///< [S, stride] sum of V Y in the sample's local frame
  std::vector<float> cosine;      ///< [S, cosineStride] sum of V cos Y, cos to the shading normal
  std::vector<float> directions;  ///< [kScrambles, stride] sum of Y over rays 0 .. directionRays
  int directionRays = 0;
  std::vector<std::uint32_t> tileRays;  ///< [tiles] rays done
  std::vector<std::uint8_t> buried;     ///< [S]; empty until known
  HitBlocks hits;
  std::atomic<std::size_t> hitBytes{0};

  DirectSums(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
             std::shared_ptr<const SampleSet> samples, const DirectSettings& settings);

  std::size_t count() const { return samples->size(); }
  std::size_t tileSize(std::size_t tile) const { return std::min(count() - tile * kBakeTile, kBakeTile); }
  /// Rays that every tile has, and that any tile has.
  int least() const;
  int most() const;

  /// Rays [from, to) of all tiles that stand at `from`. A tile is done as a whole or not at all. Returns
  /// false, with tiles left to do, once `rest` says true.
  bool trace(int from, int to, Job& job, const std::function<bool()>& rest);
  /// Decides `buried`; at least the first level's rays must be there.
  void findBuriedSamples(Job& job);

  std::map<std::string, Array> save() const;
  /// Throws FileError, before anything changes, when the arrays do not fit.
  void load(const std::map<std::string, Array>& arrays);

 private:
  void accumulateDirections(const RayTable& table);
  void traceTile(const RayTable& table, std::size_t tile, Job& job);
};

}  // namespace prt
