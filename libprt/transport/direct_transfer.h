#pragma once
// Direct transfer: what light from outside, shadowed but not reflected, does at every sample. The first of
// the two products of a transfer bake; it holds no albedo, so that editing a material never traces shadows
// again. Estimated by rays over the hemisphere of each sample, in progressive passes that can be
// interrupted, saved, resumed and extended, always to the same bits, whatever the number of threads.
//
// Estimators. Irradiance vectors e (n bands): rays spread with the cosine about the shading normal,
// e_k = pi/N sum V Y_k; or, where visibility is wanted too, uniform rays, weighted with the cosine.
// Visibility: v_k = 2pi/N sum V Y_k for 2n-1 bands, which holds T_0 = integral of V y y^T exactly
// (ALGORITHMS 1.6). Both as control variate against the unblocked hemisphere: an unblocked sample has no
// error at all. Rays below the horizon of the geometric normal count as blocked.

#include "libprt/core/array.h"
#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/sample_set.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace prt {

class HitBlocks;

/// Most rays per sample that any bake takes: beyond, the rounding of float sums shows.
inline constexpr int kMaxRays = 1 << 20;

struct DirectSettings {
  int bands = 5;            ///< of the light, 1..10
  int rays = 4096;          ///< per sample, 1..kMaxRays
  bool visibility = false;  ///< also the visibility function, for glossy surfaces
  std::uint64_t seed = 1;
  /// Bytes that may be spent on remembering what rays hit, for bounces; 0 = none. It changes speed only:
  /// bounces trace again what is not remembered. Hits are traced a little slower than mere shadows.
  std::size_t hitMemory = 0;
  std::string phase = "direct transfer";  ///< name of the phase that advance() begins
  /// Rays of all bakes that share the phase, and of those before this one; 0 = it has the phase for itself.
  double phaseRays = 0, phaseRaysBefore = 0;

  /// Those that decide the product's values.
  bool sameValues(const DirectSettings& o) const {
    return bands == o.bands && visibility == o.visibility && seed == o.seed;
  }
};

/// Immutable once shared. Depends on the geometry, on which materials are two-sided, and on the settings.
struct DirectTransfer {
  DirectSettings settings;
  int raysPerSample = 0;  ///< gathered so far; final when it reaches settings.rays
  /// [S, n^2] f32, object frame: dot with light coefficients = irradiance at the sample's shading normal.
  Array diffuse;
  /// [S, (2n-1)^2] f32, object frame: coefficients of V clipped by the geometric horizon; empty if unwanted.
  Array visibility;
  /// [S] u8: 1 = inside of something; its values are those of its neighbours on the mesh.
  Array buried;
  /// What the rays met, while this process remembers; null otherwise. Not part of the product.
  std::shared_ptr<const HitBlocks> hits;

  std::size_t samples() const { return diffuse.shape.empty() ? 0 : std::size_t(diffuse.shape[0]); }
  bool final() const { return raysPerSample >= settings.rays; }
};

class DirectBake {
 public:
  /// Throws ValueError for settings out of range, ResourceError when the sums would not fit in memory.
  DirectBake(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
             std::shared_ptr<const SampleSet> samples, const DirectSettings& settings);
  ~DirectBake();

  /// Levels of refinement; level() of them are complete. The first takes 16 rays per sample.
  int level() const;
  int levels() const;
  bool done() const { return level() == levels(); }

  /// Completes the next level. Begins a phase of `job` counted in rays, out of those of all levels. Throws
  /// Cancelled within milliseconds; whatever tiles were done stay done, and the next call goes on from
  /// there. `rest`, if given, is asked before every tile (from many threads): once it says true, advance()
  /// returns early in the same way, so that a checkpoint can be taken in the midst of a long level.
  void advance(Job& job, const std::function<bool()>& rest = {});

  /// What the completed level gives. Throws std::logic_error between levels (after Cancelled) and before
  /// the first.
  DirectTransfer product(Job& job) const;

  /// Everything needed to go on later, also in the midst of a level, as named arrays.
  std::map<std::string, Array> checkpoint() const;
  /// Goes on from a checkpoint of a bake with the same geometry, bands, seed and visibility; `rays` may
  /// differ (more extends it). Throws FileError, leaving this object as it was, when it does not fit.
  void restore(const std::map<std::string, Array>& checkpoint);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prt
