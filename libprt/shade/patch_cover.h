#pragma once
// Which place of the patch each point of a surface shows: by the id map over the atlas, or by the mesh's own
// texture coordinates, repeated (Bi-Scale Radiance Transfer, section 5).

#include "libprt/atlas/atlas.h"
#include "libprt/mesh/mesh.h"
#include "libprt/synthesis/direct_mapping.h"
#include "libprt/synthesis/id_map.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace prt {

/// The patches that are shown at a place, the lowest first, and what each shows of it; adds up to 1.
struct LayerShares {
  static constexpr std::size_t kMost = 4;
  std::array<std::uint32_t, kMost> layer{};
  std::array<float, kMost> weight{};
  std::size_t count = 0;
};
/// Of a texel of the map.
LayerShares layerShares(const IdMap& map, std::size_t texel);

class PatchCover {
 public:
  /// Throws ValueError when the atlas is not of a mesh with so many triangles.
  PatchCover(std::shared_ptr<const Atlas> atlas, std::shared_ptr<const IdMap> map, std::size_t triangles);
  /// `mesh` has texture coordinates. Throws ValueError when not.
  PatchCover(std::shared_ptr<const TriMesh> mesh, const PatchRepeat& repeat);

  /// Patch coordinates in [0, 1), nearest texel of the id map; negative where it is empty.
  Vec2 at(std::uint32_t triangle, const Vec2& barycentric) const;

  LayerShares sharesAt(std::uint32_t triangle, const Vec2& barycentric) const;
  /// Patches one over the other.
  int layers() const { return map_ ? map_->layers + 1 : 1; }

  /// Both null where the mesh's own coordinates lay the patch.
  const IdMap* map() const { return map_.get(); }
  const Atlas* atlas() const { return atlas_.get(); }
  /// [3F] where the triangles' corners lie: in the atlas, or, without a map, in repeated patches.
  std::vector<Vec2> cornerCoordinates() const;

 private:
  std::size_t mapTexel(std::uint32_t triangle, const Vec2& barycentric) const;

  std::shared_ptr<const Atlas> atlas_;
  std::vector<Vec2> corners_;  // [3F] in the atlas: a triangle's together, for one look into memory
  std::shared_ptr<const IdMap> map_;
  std::shared_ptr<const TriMesh> mesh_;
  PatchRepeat repeat_;
};

}  // namespace prt
