#pragma once
// Several patches on one surface: each layer covers what lies below it where its mask is painted, and is
// blended with it where the mask is between 0 and 1. Responses blend (B is linear), so a half-covered place
// looks as half of it covered by each. All layers share one set of patch coordinates, grown for what shows
// where (texture_synthesis.h).

#include "libprt/core/job.h"
#include "libprt/synthesis/id_map.h"
#include "libprt/synthesis/point_grid.h"

#include <span>
#include <vector>

namespace prt {

/// Layers over the patch, at most: their weights are the channels of one texture.
inline constexpr int kMostLayers = 3;

/// Painted: the layer covers what is near this point of the surface.
struct LayerSpot {
  Vec3 centre{0};      ///< on the surface
  float radius = 0;    ///< nothing is covered beyond
  float strength = 1;  ///< of the mask in its middle, 0..1
  bool operator==(const LayerSpot&) const = default;
};

/// The mask of one layer: in the inner half of a spot its strength, from there smoothly down to 0 at its rim;
/// where spots overlap the stronger one counts. A spot lies on the side of the surface that it was painted
/// on: places that face more than 90 degrees away from its middle are left alone.
class LayerMask {
 public:
  LayerMask(const MesoMesh& meso, std::span<const LayerSpot> spots);
  LayerMask(LayerMask&&) = default;
  LayerMask(const LayerMask&) = delete;
  LayerMask& operator=(const LayerMask&) = delete;
  LayerMask& operator=(LayerMask&&) = delete;

  /// 0..1 at a point of the surface with this normal.
  float at(const Vec3& position, const Vec3& normal) const;

 private:
  std::vector<LayerSpot> spots_;
  std::vector<Vec3> centres_, normals_;
  float reach_ = 0;
  PointGrid grid_;
};

/// What of a place each layer shows, the patch below all of them first: numbers that add up to 1. `out` has
/// masks.size() + 1 entries.
void layerWeights(std::span<const LayerMask> masks, const Vec3& position, const Vec3& normal,
                  std::span<float> out);

/// The same for all vertices, [M, masks.size() + 1]; empty without masks.
std::vector<float> vertexLayerWeights(const MesoMesh& meso, std::span<const LayerMask> masks, Job& job);

/// Writes the weights of the texels into the id map, empty ones left out.
void addLayers(IdMap& map, const TexelSurface& texels, std::span<const LayerMask> masks, Job& job);

}  // namespace prt
