// Lights and pictures as EXR, shapes with baked colours as glTF.

#include "libprt/core/image_io.h"
#include "libprt/light/projection.h"
#include "libprt/mesh/mesh_writer.h"
#include "libprt/project/export.h"
#include "libprt/project/export_atlas.h"
#include "libprt/project/export_manifest.h"
#include "libprt/project/lights.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

/// A light as a lat-long map: each pixel the radiance at its centre.
Image latLong(const LightRig& lights, int width, int height) {
  Image image(width, height, 3);
  const MapGeometry map(EnvironmentMapping::LatLong, width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb value = radiance(lights, Vec3(map.center(x, y)));
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = value[c];
    }
  return image;
}

/// Only letters, digits, - and _ survive in a file's name.
std::string fileName(std::string name) {
  for (char& c : name)
    if (!std::isalnum((unsigned char)c) && c != '-') c = '_';
  return name;
}

/// Values of texels between them, at each vertex in its first triangle.
std::vector<Rgb> atVertices(const TriMesh& mesh, const SampleSet& samples, const std::vector<Rgb>& values) {
  std::vector<Rgb> out(mesh.vertexCount(), Rgb(0));
  constexpr Vec2 kCorners[] = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  for (std::uint32_t t = std::uint32_t(mesh.triangleCount()); t-- > 0;)
    for (int k = 0; k < 3; ++k) {
      SamplePlace place;
      samples.at(mesh, t, kCorners[k], false, place);
      Rgb& sum = out[mesh.triangles[t][k]] = Rgb(0);
      for (std::size_t i = 0; i < 4; ++i) sum += place.weight[int(i)] * values[place.sample[i]];
    }
  return out;
}

/// Diffuse exit radiance at each vertex.
std::vector<Rgb> vertexColors(const ExportInput& input, double exposure, Job& job) {
  const Scene& scene = *input.baked.geometry->scene;
  const Transfer& transfer = input.baked.transfer->transfer;
  const ShRgb light = sceneLight(input.baked, input.recipe, input.lights, job).light;
  const SampleSet& samples = *input.baked.samples->samples;
  std::vector<Rgb> colors = irradiance(transfer, light, samples.shadingNormal);
  if (samples.texels)
    colors = atVertices(scene.mesh, samples, colors);
  else
    colors.resize(scene.mesh.vertexCount());
  const float scale = float(std::exp2(exposure)) / kPiF;
  for (std::size_t v = 0; v < colors.size(); ++v)
    colors[v] = clamp(colors[v] * input.recipe.objects[scene.vertexObject[v]].material.albedo * scale, Rgb(0),
                      Rgb(1));
  return colors;
}

}  // namespace

ExportedFiles exportExr(const ExportInput& input, const std::filesystem::path& folder, Job& job) {
  ExportManifest manifest(folder, "exr");
  const int bands = input.baked.transfer->transfer.bands;
  LightRig map = input.lights;
  map.circles.clear();
  map.directionals.clear();
  writeImage(folder / "environment.exr", latLong(map, 1024, 512));
  manifest.addFile("environment.exr",
                   "the environment as it is turned, lat-long, top row +Y, centre column -Z");
  Recipe seen = input.recipe;
  std::string& window = seen.method.window = windowOfPictures(seen.method.window);
  writeImage(folder / "light_bands.exr",
             bandLimitedMap(sceneLight(input.baked, seen, input.lights, job).light, 512, 256).pixels());
  manifest.addFile("light_bands.exr",
                   "all lights in " + std::to_string(bands) + " bands through the window " + window);
  std::vector<CameraRecipe> cameras = input.recipe.cameras;
  PictureOptions options{960, 540};
  for (const CameraRecipe& camera : cameras) {
    const std::string file = "picture_" + fileName(camera.name) + ".exr";
    writeImage(folder / file,
               relight(input.baked, input.recipe, input.lights, camera.camera(), options, job));
    manifest.addFile(file, "relit picture of camera " + camera.name + ", linear radiance, alpha = coverage");
  }
  return manifest.finish();
}

ExportedFiles exportGltf(const ExportInput& input, const std::filesystem::path& folder, double exposure,
                         Job& job) {
  ExportManifest manifest(folder, "gltf");
  const std::vector<Rgb> colors = vertexColors(input, exposure, job);
  MeshWriteOptions options;
  options.colors = colors;
  options.name = "scene";
  options.unlit = true;
  options.vertexNumbers = true;
  const TriMesh& bare = input.baked.geometry->scene->mesh;
  const TriMesh mesh = input.atlas ? withAtlas(bare, *input.atlas) : bare;
  writeMesh(folder / "scene.glb", mesh, options, job);
  if (input.atlas) {
    writeMesh(folder / "scene.obj", mesh, {.name = "scene"}, job);
    manifest.addFile("scene.obj", "the same shape with the atlas's texture coordinates");
  }
  manifest.set("exposure", exposure);
  manifest.setCameras(input.recipe, input.baked.geometry->scene->mesh.bounds());
  manifest.addFile("scene.glb",
                   "all objects as one mesh; COLOR_0 = diffuse exit radiance under the current lights, 0..1; "
                   "_VERTEX = row of the arrays that --npy writes");
  return manifest.finish();
}

}  // namespace prt
