#include "libprt/meso/patch.h"

#include "libprt/basis/view_square.h"
#include "libprt/core/error.h"
#include "libprt/meso/torus_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace prt {
namespace {

constexpr float kMostOverhang = 0.5f;

void checkMesh(const TriMesh& mesh) {
  if (mesh.triangles.empty()) throw GeometryError("has no triangles", "patch", "choose another patch");
  for (const Vec3& p : mesh.positions)
    if (!isFinite(p) || std::abs(p.z) > 100)
      throw GeometryError("a height is not finite or beyond 100 widths", "patch", "make it flatter");
  const Box3 box = mesh.bounds();
  const Vec3 extent = box.high - box.low;
  if (std::max(extent.x, extent.y) > 1 + kMostOverhang)
    throw GeometryError("sticks out of its cell by more than half a period", "patch",
                        "cut its triangles or set a larger period");
}

Image turned(const Image& image) {
  Image out(image.height, image.width, image.channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(image.pixel(x, y), image.channels, out.pixel(y, image.width - 1 - x));
  return out;
}

/// The texture moved over the torus, by whole pixels where that is what `by` is.
Image moved(const PatchTexture& texture, const Vec2& by) {
  Image out(texture->width, texture->height, 3);
  const Vec2 size(float(out.width), float(out.height));
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const Vec2 uv((float(x) + 0.5f) / size.x, 1 - (float(y) + 0.5f) / size.y);
      const Rgb c = lookUp(texture, uv - by);
      std::copy_n(&c.x, 3, out.pixel(x, y));
    }
  return out;
}

template <class Make>
PatchTexture remade(const PatchTexture& texture, const Make& make) {
  return texture ? std::make_shared<const Image>(make(texture)) : nullptr;
}

}  // namespace

Rgb lookUp(const PatchTexture& texture, const Vec2& uv) {
  if (!texture) return Rgb(1);
  const int w = texture->width, h = texture->height;
  const float x = (uv.x - std::floor(uv.x)) * float(w) - 0.5f;
  const float y = (1 - (uv.y - std::floor(uv.y))) * float(h) - 0.5f;
  const float x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
  const auto at = [&](int i, int j) { return texture->rgb((i % w + w) % w, (j % h + h) % h); };
  const int i = int(x0), j = int(y0);
  return (1 - fy) * ((1 - fx) * at(i, j) + fx * at(i + 1, j)) +
         fy * ((1 - fx) * at(i, j + 1) + fx * at(i + 1, j + 1));
}

Vec3 Patch::positionAt(std::uint32_t triangle, const Vec2& b) const {
  const UVec3& t = mesh.triangles[triangle];
  return (1 - b.x - b.y) * mesh.positions[t.x] + b.x * mesh.positions[t.y] + b.y * mesh.positions[t.z];
}

Rgb Patch::albedoAt(std::uint32_t triangle, const Vec2& b) const {
  const UVec3& t = mesh.triangles[triangle];
  const Rgb colour = (1 - b.x - b.y) * albedo[t.x] + b.x * albedo[t.y] + b.y * albedo[t.z];
  return albedoTexture ? colour * lookUp(albedoTexture, Vec2(positionAt(triangle, b))) : colour;
}

Patch makePatch(TriMesh mesh, std::vector<Rgb> albedo, Job* job) {
  checkMesh(mesh);
  Patch patch;
  if (albedo.size() == 1) albedo.resize(mesh.vertexCount(), albedo.front());
  if (albedo.size() != mesh.vertexCount())
    throw ValueError("there are not as many colours as vertices", "patch", "give one, or one per vertex");
  patch.albedo = std::move(albedo);
  const std::vector<std::uint32_t> places = torusPlaces(mesh.positions, job);
  if (mesh.normals.empty()) mesh.normals = torusNormals(mesh, places);
  patch.twin = torusTwins(mesh.normals, places);
  patch.mesh = std::move(mesh);
  const Box3 box = patch.mesh.bounds();
  patch.low = box.low.z, patch.high = box.high.z;
  return patch;
}

void addBacking(Patch& patch, float gap, int cells, const Rgb& albedo) {
  TriMesh& mesh = patch.mesh;
  const auto first = std::uint32_t(mesh.vertexCount());
  const float z = patch.low - gap;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      mesh.positions.emplace_back(float(i) / float(cells), float(j) / float(cells), z);
      mesh.normals.emplace_back(0, 0, 1);
      patch.albedo.push_back(albedo);
      patch.twin.push_back(first + std::uint32_t(j % cells * (cells + 1) + i % cells));
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const std::uint32_t a = first + std::uint32_t(j * (cells + 1) + i), b = a + std::uint32_t(cells + 1);
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  patch.backed = true;
}

std::string thinPatchWarning(const Patch& patch, int viewsPerSide) {
  // Mean angle between neighbouring views: the hemisphere's solid angle over their number.
  const double step = std::sqrt(2 * kPi) / viewsPerSide, parallax = patch.depth() * 2 * step;
  if (parallax <= 0.125) return {};
  char text[256];
  std::snprintf(
      text, sizeof text,
      "the patch is %.2f of its width deep, too thick for %d x %d views: between neighbouring views "
      "its surface moves by up to %.0f %% of the width; make it flatter or use more views",
      double(patch.depth()), viewsPerSide, viewsPerSide, 100 * parallax);
  return text;
}

Patch shifted(const Patch& patch, const Vec2& by) {
  Patch out = patch;
  // Every triangle goes back to the unit cell by whole periods and takes its vertices with it.
  const TriMesh& from = patch.mesh;
  TriMesh mesh;
  std::vector<Rgb> albedo;
  TorusVertexMap vertices;
  for (const UVec3& t : from.triangles) {
    const Vec3 centre = (from.positions[t.x] + from.positions[t.y] + from.positions[t.z]) / 3.0f;
    const Vec2 periods = floor(Vec2(centre) + by);
    UVec3 made;
    for (int k = 0; k < 3; ++k)
      made[k] = vertices.at(t[k], int(-periods.x), int(-periods.y), [&] {
        mesh.positions.push_back(from.positions[t[k]] + Vec3(by - periods, 0));
        mesh.normals.push_back(from.normals[t[k]]);
        albedo.push_back(patch.albedo[t[k]]);
        return std::uint32_t(mesh.positions.size() - 1);
      });
    mesh.triangles.push_back(made);
  }
  out.albedo = std::move(albedo);
  out.twin = torusTwins(mesh.normals, torusPlaces(mesh.positions));
  out.mesh = std::move(mesh);
  const auto move = [&](const PatchTexture& t) { return moved(t, by); };
  out.albedoTexture = remade(patch.albedoTexture, move);
  out.glossTexture = remade(patch.glossTexture, move);
  return out;
}

Patch quarterTurned(const Patch& patch) {
  Patch out = patch;
  for (Vec3& p : out.mesh.positions) p = {1 - p.y, p.x, p.z};
  for (Vec3& n : out.mesh.normals) n = {-n.y, n.x, n.z};
  const auto turn = [](const PatchTexture& t) { return turned(*t); };
  out.albedoTexture = remade(patch.albedoTexture, turn);
  out.glossTexture = remade(patch.glossTexture, turn);
  return out;
}

}  // namespace prt
