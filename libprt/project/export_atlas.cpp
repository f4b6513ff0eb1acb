#include "libprt/project/export_atlas.h"

#include "libprt/atlas/geometry_image.h"
#include "libprt/core/image_io.h"
#include "libprt/core/npy.h"
#include "libprt/mesh/mesh_writer.h"
#include "libprt/project/export_manifest.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

Array grid(const std::vector<Vec3>& values, int size) {
  return Array::from<float>(std::span(&values[0].x, values.size() * 3), {size, size, 3});
}

Array indexRows(const std::vector<UVec3>& triangles) {
  std::vector<std::int32_t> values;
  values.reserve(3 * triangles.size());
  for (const UVec3& t : triangles)
    for (int i = 0; i < 3; ++i) values.push_back(std::int32_t(t[i]));
  return Array::from<std::int32_t>(std::span<const std::int32_t>(values),
                                   {std::int64_t(triangles.size()), 3});
}

}  // namespace

void writeAtlasArrays(
    const TriMesh& mesh, const Atlas& atlas, Job& job,
    const std::function<void(const std::string&, const Array&, const std::string&)>& write) {
  write(
      "uv",
      Array::from<float>(std::span(&atlas.uv[0].x, 2 * atlas.uv.size()), {std::int64_t(atlas.uv.size()), 2}),
      "texture coordinates of the atlas, v up");
  write("uv_faces", indexRows(atlas.uvTriangles), "corners of each triangle in uv");
  const std::vector<std::int32_t> charts(atlas.chartOf.begin(), atlas.chartOf.end());
  write("uv_chart",
        Array::from<std::int32_t>(std::span<const std::int32_t>(charts), {std::int64_t(charts.size())}),
        "chart of each triangle");
  const GeometryImage image = makeGeometryImage(atlas, atlas.size, -1, job);
  const TexelSurface surface = texelSurface(mesh, atlas, image, job);
  const int n = image.size;
  write("geometry_position", grid(surface.position, n),
        "surface point of each texel, rows from the top; 0 outside");
  write("geometry_normal", grid(surface.normal, n), "unit shading normal there; 0 outside");
  write("geometry_tangent", grid(surface.tangent, n),
        "unit tangent along growing u, at a right angle to the normal");
  std::vector<std::int32_t> triangle(image.triangle.size());
  for (std::size_t i = 0; i < triangle.size(); ++i)
    triangle[i] = image.triangle[i] == kNowhere ? -1 : std::int32_t(image.triangle[i]);
  write("geometry_triangle", Array::from<std::int32_t>(std::span<const std::int32_t>(triangle), {n, n}),
        "triangle that each texel shows; -1 outside");
  write("geometry_barycentric",
        Array::from<float>(std::span(&image.barycentric[0].x, 2 * triangle.size()), {n, n, 2}),
        "weights of that triangle's corners 1 and 2");
}

Image atlasPicture(const Atlas& atlas, int size, Job& job) {
  const GeometryImage image = makeGeometryImage(atlas, size, 0, job);
  Image picture(size, size, 3);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const std::size_t i = image.index(x, y);
      Rgb color(0.014f);  // the panels' grey
      if (image.kind[i] == TexelKind::Border) color = Rgb(0.65f);
      if (image.kind[i] == TexelKind::Inside) {
        // Hues a golden angle apart never come near each other.
        const double hue = 2.399963 * atlas.chartOf[image.triangle[i]];
        for (int k = 0; k < 3; ++k) color[k] = float(0.18 + 0.13 * std::cos(hue - 2 * kPi * k / 3));
      }
      for (int k = 0; k < 3; ++k) picture.pixel(x, y)[k] = color[k];
    }
  return picture;
}

TriMesh withAtlas(TriMesh mesh, const Atlas& atlas) {
  mesh.uv = atlas.uv;
  mesh.uvTriangles = atlas.uvTriangles;
  return mesh;
}

ExportedFiles exportAtlas(const TriMesh& mesh, const AtlasProduct& product,
                          const std::filesystem::path& folder, Job& job) {
  ExportManifest manifest(folder, "npy");
  manifest.set("vertices", mesh.vertexCount()).set("faces", mesh.triangleCount());
  manifest.set("charts", product.facts.charts)
      .set("stretch_l2", product.facts.l2)
      .set("filled", product.facts.filled);
  job.begin("arrays", 0);
  const auto write = [&](const std::string& name, const Array& array, const std::string& doc) {
    job.checkCancelled();
    writeNpy(folder / (name + ".npy"), array);
    manifest.addArray(name, array, doc);
  };
  write("positions",
        Array::from<float>(std::span(&mesh.positions[0].x, 3 * mesh.vertexCount()),
                           {std::int64_t(mesh.vertexCount()), 3}),
        "vertices in the common object frame");
  write("faces", indexRows(mesh.triangles), "corners of each triangle, counter-clockwise from outside");
  writeAtlasArrays(mesh, *product.atlas, job, write);
  writeMesh(folder / "atlas.obj", withAtlas(mesh, *product.atlas), {}, job);
  writeImage(folder / "atlas.png", atlasPicture(*product.atlas, std::min(1024, product.atlas->size), job));
  manifest.addFile("atlas.png", "the charts, each in its own hue");
  manifest.addFile("atlas.obj", "the scene with the atlas as its texture coordinates");
  return manifest.finish();
}

}  // namespace prt
