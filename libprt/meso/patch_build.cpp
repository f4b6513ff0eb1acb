#include "libprt/meso/patch_build.h"

#include "libprt/core/error.h"
#include "libprt/meso/patch_generate.h"
#include "libprt/meso/patch_scene.h"
#include "libprt/meso/weave.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace prt {
namespace {

const std::string kBuiltin = "builtin:";

bool builtin(const std::string& path) {
  return path.starts_with(kBuiltin);
}

/// The picture that a path stands for: a built-in one or what was read.
PatchTexture textureOf(const std::string& path, const std::optional<Image>& read, const char* where) {
  if (path.empty()) return nullptr;
  Image image = builtin(path) ? generateTexture(path.substr(kBuiltin.size())) : read.value_or(Image());
  if (image.empty()) throw ValueError("has no pixels", where, "name an image or leave it empty");
  for (const float x : image.data)
    if (!std::isfinite(x) || x < 0)
      throw ValueError("has a pixel that is negative or not finite", where, "repair the image");
  for (float& x : image.data) x = std::min(x, 1.0f);
  return std::make_shared<const Image>(std::move(image));
}

Patch buildHeightField(const PatchOptions& o, const PatchSources& sources, Job& job) {
  if (builtin(o.heightmap)) {
    HeightOptions height;
    height.name = o.heightmap.substr(kBuiltin.size());
    height.depth = o.depth, height.count = o.count, height.grid = o.grid;
    height.seed = std::uint32_t(o.seed);
    return heightField(generateHeights(height), o.albedo, &job);
  }
  return heightField(heightsFromImage(sources.height.value_or(Image()), o.depth, o.grid), o.albedo, &job);
}

Patch buildWeave(const PatchOptions& o, Job& job) {
  WeaveOptions options;
  options.yarns = o.yarns, options.radius = o.radius, options.depth = o.depth,
  options.amplitude = o.amplitude;
  options.weft = options.backing = o.albedo;
  options.warp = o.albedo * o.warp;
  // Many thin yarns need fewer triangles each.
  if (o.yarns > 8) options.sides = 16, options.along = 10;
  return weave(options, &job);
}

/// Whether a ray straight down gets through somewhere.
bool hasGaps(const Patch& patch, Job& job) {
  constexpr int kRays = 64;
  const PatchScene scene = makePatchScene(std::make_shared<Patch>(patch), job);
  for (int i = 0; i < kRays * kRays; ++i) {
    const Vec2 uv = (Vec2(float(i % kRays), float(i / kRays)) + 0.5f) / float(kRays);
    if (!scene.rays->intersect(viewRay(patch, uv, {0, 0, 1})).valid()) return true;
  }
  return false;
}

void requireRange(const char* path, double value, double low, double high) {
  if (value >= low && value <= high) return;
  char text[64];
  std::snprintf(text, sizeof text, "use %g to %g", low, high);
  throw ValueError("is out of range", path, text);
}

}  // namespace

Patch patchFromMesh(const TriMesh& mesh, float period, const Rgb& albedo, Job& job) {
  const Box3 box = mesh.bounds();
  const Vec3 extent = box.high - box.low;
  const float width = period > 0 ? period : std::max(extent.x, extent.z);
  if (mesh.triangles.empty() || !(width > 0))
    throw GeometryError("has no extent along x and z to repeat", "patch.mesh",
                        "use a mesh that lies flat, +Y up");
  TriMesh patch;
  patch.triangles = mesh.triangles;
  for (const Vec3& p : mesh.positions)
    patch.positions.push_back(Vec3(p.x - box.low.x, box.high.z - p.z, p.y - box.low.y) / width);
  for (const Vec3& n : mesh.normals) patch.normals.emplace_back(n.x, -n.z, n.y);
  Patch out = makePatch(std::move(patch), {albedo}, &job);
  if (hasGaps(out, job)) addBacking(out, std::max(0.02f * out.depth(), 1e-3f), 64, albedo);
  return out;
}

Patch buildPatch(const PatchOptions& o, const PatchSources& sources, Job& job) {
  requireRange("patch.exponent", double(o.exponent), 1, 10000);
  for (int c = 0; c < 3; ++c) {
    requireRange("patch.albedo", double(o.albedo[c]), 0, 1);
    requireRange("patch.specular", double(o.specular[c]), 0, 1);
  }
  Patch patch;
  switch (o.model) {
    case PatchModel::Flat:
      patch = flatPatch(o.albedo);
      break;
    case PatchModel::HeightField:
      patch = buildHeightField(o, sources, job);
      break;
    case PatchModel::Weave:
      patch = buildWeave(o, job);
      break;
    case PatchModel::Mesh:
      if (!sources.mesh) throw ValueError("is not set", "patch.mesh", "name the mesh of one period");
      patch = patchFromMesh(*sources.mesh, o.period, o.albedo, job);
      break;
    default:
      throw std::logic_error("a patch without a surface cannot be built");
  }
  patch.albedoTexture = textureOf(o.texture, sources.texture, "patch.texture");
  patch.glossTexture = textureOf(o.gloss, sources.gloss, "patch.gloss");
  patch.specular = o.specular;
  patch.exponent = o.exponent;
  return patch;
}

}  // namespace prt
