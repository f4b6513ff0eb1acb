#include "libprt/shade/patch_cover.h"

#include "libprt/core/error.h"
#include "libprt/synthesis/surface_point.h"

#include <algorithm>

namespace prt {

PatchCover::PatchCover(std::shared_ptr<const Atlas> atlas, std::shared_ptr<const IdMap> map,
                       std::size_t triangles)
    : atlas_(std::move(atlas)), map_(std::move(map)) {
  if (atlas_->uvTriangles.size() != triangles)
    throw ValueError("the atlas was made for another mesh", "patch on the surface", "bake idmap again");
}

PatchCover::PatchCover(std::shared_ptr<const TriMesh> mesh, const PatchRepeat& repeat)
    : mesh_(std::move(mesh)), repeat_(repeat) {
  if (mesh_->uv.empty())
    throw ValueError("the mesh has no texture coordinates", "patch on the surface",
                     "set synthesis.mapping=synthesis");
}

Vec2 PatchCover::at(std::uint32_t triangle, const Vec2& barycentric) const {
  if (mesh_) return directPatchCoordinates(*mesh_, repeat_, triangle, barycentric);
  const UVec3& t = atlas_->uvTriangles[triangle];
  const Vec2 uv = interpolated(atlas_->uv[t.x], atlas_->uv[t.y], atlas_->uv[t.z], barycentric);
  const int last = map_->size - 1;
  const int x = std::clamp(int(uv.x * float(map_->size)), 0, last),
            y = std::clamp(int((1 - uv.y) * float(map_->size)), 0, last);
  return map_->at(std::size_t(y) * std::size_t(map_->size) + std::size_t(x));
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
