#pragma once
// Light on the surface of a patch: for a set of lights - the functions of a spherical-harmonic basis, or
// single directional ones - the irradiance that each brings to every vertex, shadowed and reflected back and
// forth over the torus. "Treat the patch as a tiny PRT scene" (ALGORITHMS 6.3): rays are traced once, however
// many views and lights there are.
//
// Direct light in spherical harmonics comes from low-discrepancy rays spread with the cosine, with the open
// hemisphere as control variate; bounces gather over what those rays hit (transport's Neumann gather) with
// the albedo at the vertices. Reflection inside the patch is diffuse: a Phong lobe counts towards the viewer
// only.

#include "libprt/core/job.h"
#include "libprt/meso/patch_scene.h"
#include "libprt/transport/bounce_gather.h"
#include "libprt/transport/direct_transfer.h"

#include <functional>
#include <memory>
#include <span>

namespace prt {

/// Most bounces inside a patch.
inline constexpr int kMaxPatchBounces = 500;
/// So many bounces mean all: what the rest of the series would add is extrapolated from its last terms. White
/// surfaces with narrow gaps need that: light finds out of them slowly.
inline constexpr int kAllBounces = 32;

struct PatchTransferSettings {
  int bands = 5;            ///< 1..10
  int rays = 1024;          ///< per vertex
  int bounces = 2;          ///< 0 = shadows only, at most kMaxPatchBounces
  float stopThreshold = 0;  ///< end when a bounce adds less than this share of what is there
  std::uint64_t seed = 1;
  std::size_t hitMemory = std::size_t{1} << 30;  ///< bytes for remembering hits; changes speed only
};

/// Irradiance at the vertices, per light: rows[v] holds `lights` * `channels` numbers, channels fastest.
struct PatchLight {
  std::size_t lights = 0;
  int channels = 1;  ///< 3 where bounces carry colour
  int bounces = 0;   ///< in it
  int rays = 0;      ///< per sample
  SampleRows rows;   ///< [V]

  /// out[lights * channels] = the row interpolated in a triangle.
  void at(const TriMesh& mesh, std::uint32_t triangle, const Vec2& barycentric, float* out) const;
};

/// The rays over a patch's surface and what comes of them. Levels refine as in DirectBake.
class PatchTransferBake {
 public:
  /// Throws ValueError for settings out of range, ResourceError when the sums would not fit in memory.
  PatchTransferBake(const PatchScene& patch, const PatchTransferSettings& settings);

  int level() const { return bake_.level(); }
  int levels() const { return bake_.levels(); }
  bool done() const { return bake_.done(); }
  /// Completes the next level.
  void advance(Job& job) { bake_.advance(job); }

  /// Light of the basis functions after the completed level.
  PatchLight basisLight(Job& job) const;
  /// Directional lights of irradiance 1 across the beam (unit directions, z > 0): what they bring by bounces
  /// only, without their direct light, or with it. Direct light is that at the vertices.
  PatchLight directionalLight(std::span<const Vec3> directions, bool withDirect, Job& job) const;

  /// Rays of the levels done, all samples together.
  double raysTraced() const;

 private:
  PatchLight bounced(SampleRows direct, std::size_t lights, bool withDirect, Job& job) const;

  PatchScene patch_;
  PatchTransferSettings settings_;
  DirectBake bake_;
};

}  // namespace prt
