#include "libprt/shade/surroundings.h"

#include "libprt/shade/render.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

/// Looks from `place` at one face of a cube.
Camera faceCamera(const Vec3& place, const CubeGrid::Face& face) {
  // The target is on the axis whatever the size of the coordinates.
  const float step = std::exp2(
      std::ceil(std::log2(1 + std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}))));
  return {place, place + step * face.axis, face.up, 0.5f * kPiF};
}

/// Whether a box may be seen through a face: not all of its corners are beyond one of the face's sides.
bool maySee(const Camera& camera, const Box3& box) {
  const Frame f = camera.axes();
  bool beyond[5] = {true, true, true, true, true};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                 corner & 4 ? box.high.z : box.low.z);
    const Vec3 local = f.toLocal(p - camera.eye);
    const float ahead = -local.z;
    const bool outside[5] = {ahead <= 0, local.x > ahead, -local.x > ahead, local.y > ahead,
                             -local.y > ahead};
    for (int side = 0; side < 5; ++side) beyond[side] = beyond[side] && outside[side];
  }
  return std::find(std::begin(beyond), std::end(beyond), true) == std::end(beyond);
}

std::shared_ptr<const CubeGrid> usualGrid() {
  static const auto grid = std::make_shared<const CubeGrid>(CubeView::kSide);
  return grid;
}

}  // namespace

std::shared_ptr<const SampleSet> bareSamples(const Scene& scene) {
  auto samples = std::make_shared<SampleSet>();
  samples->vertices = scene.mesh.vertexCount();
  if (std::none_of(scene.materials.begin(), scene.materials.end(),
                   [](const Material& m) { return m.twoSided; }))
    return samples;
  for (std::uint32_t v = 0; v < scene.mesh.vertexCount(); ++v)
    samples->back.push_back(scene.materials[scene.vertexObject[v]].twoSided ? v : kNone);
  return samples;
}

Occluder occluderOf(const Surroundings* surroundings) {
  return {surroundings && !surroundings->empty() ? &surroundings->scene->mesh : nullptr, false};
}

Image shadeSurroundings(const Surroundings& surroundings, const FragmentImage& view, const Camera& camera,
                        Job& job) {
  Transfer unshadowed;
  unshadowed.bands = surroundings.light.bands;
  RenderInput input{*surroundings.scene, *surroundings.samples, unshadowed, surroundings.light};
  input.emission = surroundings.emission;
  return shade(input, view, camera, job);
}

void addSurroundings(const Surroundings* surroundings, const TriMesh& model, const Camera& camera, int grid,
                     Image& image, Job& job) {
  if (!surroundings || surroundings->empty()) return;
  const FragmentImage view =
      rasterize(surroundings->scene->mesh, camera, image.width, image.height, grid, job, {&model, true});
  const Image seen = shadeSurroundings(*surroundings, view, camera, job);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] += seen.data[i];
}

CubeView::CubeView(const TriMesh& mesh, const Vec3& place, Job& job) : grid_(usualGrid()) {
  const Box3 bounds = mesh.bounds();
  for (int face = 0; face < 6; ++face) {
    Camera& camera = cameras_[std::size_t(face)] = faceCamera(place, grid_->face(face));
    if (maySee(camera, bounds)) faces_[std::size_t(face)] = rasterize(mesh, camera, kSide, kSide, kGrid, job);
  }
}

CapturedCube CubeView::capture(const Surroundings& surroundings, Job& job) const {
  CapturedCube cube{grid_, Image(6 * kSide, kSide, 4)};
  for (std::size_t face = 0; face < 6; ++face) {
    if (faces_[face].tiles.empty()) continue;
    const Image picture = shadeSurroundings(surroundings, faces_[face], cameras_[face], job);
    for (int y = 0; y < kSide; ++y) {
      const float* row = picture.pixel(0, y);
      std::copy_n(row, 4 * kSide, cube.image.pixel(int(face) * kSide, y));
      for (int x = 0; x < kSide; ++x) cube.seen[face] = cube.seen[face] || row[4 * x + 3] > 0;
    }
  }
  return cube;
}

}  // namespace prt
