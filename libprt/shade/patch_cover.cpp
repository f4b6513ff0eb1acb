#include "libprt/shade/patch_cover.h"

#include "libprt/core/error.h"
#include "libprt/synthesis/surface_point.h"

#include <algorithm>

namespace prt {

LayerShares layerShares(const IdMap& map, std::size_t texel) {
  LayerShares out;
  int left = 255;
  out.count = 1;  // the place of the lowest, which takes what the others leave
  for (std::size_t k = 0; k < std::size_t(map.layers); ++k) {
    const int part = map.weights[texel * std::size_t(map.layers) + k];
    if (part == 0) continue;
    left -= part;
    out.layer[out.count] = std::uint32_t(k + 1), out.weight[out.count++] = float(part) / 255.0f;
  }
  out.weight[0] = float(left) / 255.0f;
  if (left > 0 || out.count == 1) return out;
  std::copy(out.layer.begin() + 1, out.layer.end(), out.layer.begin());
  std::copy(out.weight.begin() + 1, out.weight.end(), out.weight.begin());
  --out.count;
  return out;
}

PatchCover::PatchCover(std::shared_ptr<const Atlas> atlas, std::shared_ptr<const IdMap> map,
                       std::size_t triangles)
    : atlas_(std::move(atlas)), map_(std::move(map)) {
  if (atlas_->uvTriangles.size() != triangles)
    throw ValueError("the atlas was made for another mesh", "patch on the surface", "bake idmap again");
  corners_ = cornerCoordinates();
}

PatchCover::PatchCover(std::shared_ptr<const TriMesh> mesh, const PatchRepeat& repeat)
    : mesh_(std::move(mesh)), repeat_(repeat) {
  if (mesh_->uv.empty())
    throw ValueError("the mesh has no texture coordinates", "patch on the surface",
                     "set synthesis.mapping=synthesis");
}

Vec2 PatchCover::at(std::uint32_t triangle, const Vec2& barycentric) const {
  if (mesh_) return directPatchCoordinates(*mesh_, repeat_, triangle, barycentric);
  return map_->at(mapTexel(triangle, barycentric));
}

LayerShares PatchCover::sharesAt(std::uint32_t triangle, const Vec2& barycentric) const {
  if (layers() > 1) return layerShares(*map_, mapTexel(triangle, barycentric));
  LayerShares only;
  only.weight[0] = 1, only.count = 1;
  return only;
}

std::size_t PatchCover::mapTexel(std::uint32_t triangle, const Vec2& barycentric) const {
  const Vec2* corner = &corners_[3 * std::size_t(triangle)];
  const Vec2 uv = interpolated(corner[0], corner[1], corner[2], barycentric);
  const int last = map_->size - 1;
  const int x = std::clamp(int(uv.x * float(map_->size)), 0, last),
            y = std::clamp(int((1 - uv.y) * float(map_->size)), 0, last);
  return std::size_t(y) * std::size_t(map_->size) + std::size_t(x);
}

std::vector<Vec2> PatchCover::cornerCoordinates() const {
  const std::vector<Vec2>& uv = mesh_ ? mesh_->uv : atlas_->uv;
  const Vec2 scale = mesh_ ? Vec2(float(repeat_.u), float(repeat_.v)) : Vec2(1);
  std::vector<Vec2> out;
  for (const UVec3& t : mesh_ ? mesh_->uvTriangles : atlas_->uvTriangles)
    for (int c = 0; c < 3; ++c) out.push_back(scale * uv[t[c]]);
  return out;
}

}  // namespace prt
