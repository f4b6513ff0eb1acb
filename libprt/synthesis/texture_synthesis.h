#pragma once
// Texture synthesis on the meso mesh: patch coordinates for every vertex, such that around each the surface
// looks like the patch looks around that place (Bi-Scale Radiance Transfer, 4.3).
//
// Coarse to fine over the levels of the mesh. On each level new vertices go on from their nearest neighbour;
// then every vertex picks the best of some candidates: the places at which its neighbours' pieces of the
// patch would go on (coherence), the mean of these where they nearly agree (which spreads what curvature
// forces apart over many vertices), and places that look like them (k-coherence, Tong et al. 2002). Best is
// what differs least, in appearance, from what the neighbours show, with a small price on not going on.
// Coordinates are continuous, not texel by texel. Vertices are corrected in sets of which no two are
// neighbours, so that results depend on the seed alone.

#include "libprt/synthesis/exemplar.h"
#include "libprt/synthesis/neighbourhoods.h"

#include <functional>
#include <span>
#include <vector>

namespace prt {

/// Painted: near this point of the surface, take this part of the patch.
struct PatchWish {
  Vec3 centre{0};       ///< on the surface
  float radius = 0;     ///< of the spot on the surface
  Vec2 place{0.5f};     ///< in the patch, 0..1
  float extent = 0.1f;  ///< distance from `place` that is still fine, in patch widths
};

/// For one vertex: the place it should take, how far from there is fine (patch widths), and how strongly: 0 =
/// free.
struct VertexWish {
  Vec2 place{0};
  float extent = 0;
  float strength = 0;
};
/// Strength 1 in the middle of a spot, falling to 0 at its rim; where spots overlap the stronger one counts.
/// Vertices whose normal is more than 90 degrees off the nearest vertex' are left alone. Empty for no wishes.
std::vector<VertexWish> vertexWishes(const MesoMesh& meso, std::span<const PatchWish> wishes, Job& job);

/// What the surface shows: one exemplar, or, where layers of patches are blended (layer_masks.h), several and
/// what of each vertex each of them shows. All share one set of coordinates, chosen for what shows where.
struct PatchExemplars {
  std::span<const Exemplar> exemplars;  ///< alike in texels, turns and spacings
  std::span<const float> weights = {};  ///< [M, exemplars], add up to 1; empty: the only one is all there is

  PatchExemplars(const Exemplar& only) : exemplars(&only, 1) {}
  PatchExemplars(std::span<const Exemplar> all, std::span<const float> weightsOf)
      : exemplars(all), weights(weightsOf) {}

  int texels() const { return exemplars[0].texels; }
  std::size_t count() const { return exemplars[0].count(); }
  int turns() const { return exemplars[0].turns; }
  int levels() const { return int(exemplars[0].levels.size()); }
  bool fit(const MesoMesh& meso) const;
};

/// How good a synthesis is. Distances are roots of mean squares; 1 is what two random texels are apart.
struct SynthesisQuality {
  double distance = 0;  ///< between what a vertex' patch shows at a neighbour's place and what that one shows
  double inside = 0;    ///< the same for neighbours in one chart ..
  double across = 0;    ///< .. and for those in two: alike where seams do not show
  double coherence = 0;  ///< part of all pairs of neighbours whose coordinates go on from one to the other
  /// Side of the largest region in which they all do, in patch widths: how long the patch repeats verbatim.
  double longestRepeat = 0;
};

struct SynthesisOptions {
  double patchWidth = 0;  ///< in the mesh's unit
  int symmetry = 1;       ///< of the tangents' field and of the exemplar
  /// 0..1: how far coordinates are thrown about before each level: in half patches on the first that tells
  /// texels apart, then in distances of vertices. Breaks up the repetition of irregular patches.
  double jitter = 0;
  int passes = 2;  ///< of corrections on the finest level, 0..100; coarser ones get more
  std::uint64_t seed = 1;
  std::span<const VertexWish> wishes = {};  ///< [M], or empty
  /// Called when a level is done, coarsest first: the first `coordinates.size()` vertices have theirs. The
  /// last call is the result.
  std::function<void(std::span<const Vec2> coordinates, int level, int levels)> preview = {};
};

/// Spacings for makeExemplar(), in texels, of those levels of a mesh that are fine enough to tell texels
/// apart.
std::vector<double> exemplarSpacings(const MesoMesh& meso, double patchWidth, int texels);

/// Patch coordinates of all vertices, [M], in [0, 1)^2. Exemplars are made with exemplarSpacings() and the
/// same symmetry. Throws ValueError when they do not fit, Cancelled.
std::vector<Vec2> synthesise(const MesoMesh& meso, const SurfaceSheets& sheets,
                             std::span<const Vec3> tangents, const PatchExemplars& exemplars,
                             const SynthesisOptions& options, Job& job);

/// `chartOf`: chart of each macro triangle; empty = none are told apart.
SynthesisQuality measureSynthesis(const MesoMesh& meso, const Neighbourhoods& finest,
                                  const PatchExemplars& exemplars, std::span<const Vec2> coordinates,
                                  std::span<const std::uint32_t> chartOf);

}  // namespace prt
