// Transfer as plain matrices and vectors, and everything as .npy files.

#include "libprt/core/npy.h"
#include "libprt/material/glossy_response.h"
#include "libprt/project/export.h"
#include "libprt/project/export_atlas.h"
#include "libprt/project/export_manifest.h"
#include "libprt/project/export_synthesis.h"
#include "libprt/project/lights.h"

#include <algorithm>
#include <functional>

namespace prt {
namespace {

template <class V>
Array rows(const std::vector<V>& vectors) {
  const float* first = vectors.empty() ? nullptr : &vectors[0][0];
  return Array::from<float>(std::span(first, vectors.size() * std::size_t(V::length())),
                            {std::int64_t(vectors.size()), V::length()});
}

Array indices(const std::vector<UVec3>& triangles) {
  std::vector<std::int32_t> flat;
  flat.reserve(3 * triangles.size());
  for (const UVec3& t : triangles)
    flat.insert(flat.end(), {std::int32_t(t.x), std::int32_t(t.y), std::int32_t(t.z)});
  return Array::from<std::int32_t>(std::span<const std::int32_t>(flat), {std::int64_t(triangles.size()), 3});
}

/// One tangent per vertex: the mean over its corners, or one of them where they cancel (at seams).
std::vector<Vec3> vertexTangents(const TriMesh& mesh, const TangentFrames& frames) {
  std::vector<Vec3> sums(mesh.vertexCount(), Vec3(0)), any(mesh.vertexCount(), Vec3(0));
  for (std::size_t c = 0; c < frames.tangents.size(); ++c) {
    const std::uint32_t v = mesh.triangles[c / 3][int(c % 3)];
    sums[v] += frames.tangents[c];
    any[v] = frames.tangents[c];
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const Vec3& n = mesh.normals[v];
    const Vec3 flat = sums[v] - n * dot(n, sums[v]);
    if (length(flat) > 0.1f)
      sums[v] = normalize(flat);
    else
      sums[v] = any[v] == Vec3(0) ? frameFromNormal(n).tangent : any[v];
  }
  return sums;
}

/// The first `count` rows of an array: vertices, or texels, come first among the samples.
Array firstRows(Array array, std::size_t count) {
  if (array.shape[0] > 0) array.bytes.resize(array.bytes.size() / std::size_t(array.shape[0]) * count);
  array.shape[0] = std::int64_t(count);
  return array;
}

/// Exit radiance of a white Lambert surface: irradiance over pi.
Array whiteLambert(const Transfer& transfer, std::span<const Vec3> normals) {
  const int k = transfer.functions();
  if (transfer.form == TransferForm::None) {
    std::vector<float> values(normals.size() * std::size_t(k));
    for (std::size_t s = 0; s < normals.size(); ++s)
      lambertResponse(transfer.bands, normals[s],
                      std::span(values).subspan(s * std::size_t(k), std::size_t(k)));
    return Array::from<float>(std::span<const float>(values), {std::int64_t(normals.size()), k});
  }
  Array vectors = diffuseVectors(transfer);
  auto* values = reinterpret_cast<float*>(vectors.bytes.data());
  for (std::size_t i = 0; i < vectors.size(); ++i) values[i] /= kPiF;
  return vectors;
}

constexpr int kResponseRows = 512;  // so fine that straight interpolation between rows does not show

/// [O,rows,lobes,bands] of every object, zeros where it is not glossy: how GlossyResponse answers, for
/// shaders.
Array glossyResponses(const std::vector<ObjectRecipe>& objects, int bands) {
  const std::size_t n = std::size_t(bands), rowSize = n * n;
  std::vector<float> all(objects.size() * kResponseRows * rowSize, 0.0f), weights(rowSize);
  float* to = all.data();
  for (const ObjectRecipe& object : objects) {
    if (!object.material.glossy()) {
      to += kResponseRows * rowSize;
      continue;
    }
    const GlossyResponse response(object.material.exponent, bands);
    for (int row = 0; row < kResponseRows; ++row, to += rowSize) {
      const float away = 1 - float(row) / float(kResponseRows - 1);
      response.weightsAt(0.5f * kPiF * (1 - away * away), weights);
      for (std::size_t lobe = 0; lobe < n; ++lobe)
        for (std::size_t l = 0; l < n; ++l) to[lobe * n + l] = weights[l * n + lobe];
    }
  }
  return Array::from<float>(std::span<const float>(all),
                            {std::int64_t(objects.size()), kResponseRows, bands, bands});
}

using Write = std::function<void(const std::string& name, const Array& array, const std::string& doc)>;

void writeRtt(const Rtt& rtt, const std::filesystem::path& folder, ExportManifest& manifest) {
  const Array array = rtt.array();
  writeNpy(folder / "rtt.npy", array);
  manifest.set("rtt_bands", rtt.bands).set("rtt_bounces", rtt.bounces);
  manifest.addArray(
      "rtt", array,
      "radiance transfer texture: v, u, view_y, view_x, function (, colour); v up, cell-centred, tangent = "
      "+u, views on the Shirley-Chiu square of the hemisphere about the patch's normal");
}

/// One period of the surface, with what lies on its vertices.
void writePatch(const Patch& patch, const std::filesystem::path& folder, ExportManifest& manifest) {
  std::vector<Vec3> albedo;
  for (std::size_t v = 0; v < patch.albedo.size(); ++v)
    albedo.push_back(patch.albedo[v] * lookUp(patch.albedoTexture, Vec2(patch.mesh.positions[v])));
  const auto write = [&](const std::string& name, const Array& array, const std::string& doc) {
    writeNpy(folder / (name + ".npy"), array);
    manifest.addArray(name, array, doc);
  };
  manifest.set("patch_middle", patch.middle()).set("patch_depth", patch.depth());
  write("patch_positions", rows(patch.mesh.positions),
        "u, v and height of the patch's vertices, in patch widths");
  write("patch_normals", rows(patch.mesh.normals), "their unit shading normals");
  write("patch_albedo", rows(albedo), "their diffuse reflectance, linear Rec.709");
  write("patch_faces", indices(patch.mesh.triangles),
        "corners of each triangle, counter-clockwise from outside");
}

/// What a Phong lobe needs beside the matrices.
void writeGloss(const ExportInput& input, const Write& write) {
  std::vector<Vec3> specular;
  for (const ObjectRecipe& object : input.recipe.objects)
    specular.push_back(object.material.glossy() ? Vec3(object.material.specular) : Vec3(0));
  write("specular", rows(specular), "specular colour of each object, linear Rec.709; 0 = not glossy");
  const Transfer& transfer = input.baked.transfer->transfer;
  const bool glossy =
      std::any_of(specular.begin(), specular.end(), [](const Vec3& c) { return c != Vec3(0); });
  if (!glossy || transfer.form == TransferForm::Diffuse || transfer.bands > kMaxResponseBands) return;
  write("response", glossyResponses(input.recipe.objects, transfer.bands),
        "per object: [view angle, lobe, band] weights of the Phong lobe's zonal lobes; row = "
        "(rows-1) (1 - sqrt(1 - angle / (pi/2))), lobe j stands pi j / bands from the normal towards the "
        "viewer");
}

/// The patch on the surface: what there is of it.
void writeLaidPatch(const SynthesisProduct* synthesis, const IdMapProduct* idmap, const Write& write,
                    ExportManifest& manifest) {
  if (synthesis && synthesis->meso) {
    writeMesoArrays(*synthesis, write);
    manifest.set("patch_width", synthesis->patchWidth).set("meso_edge", synthesis->meso->edge);
  }
  if (idmap && idmap->map) writeIdMapArray(*idmap->map, write);
}

/// Where transfer is when it is at texels, and how a point of the surface finds them.
void writeTexels(const TriMesh& mesh, const SampleSet& samples, const Write& write) {
  const TexelGrid& grid = *samples.texels;
  std::vector<Vec3> at, normal;
  for (std::size_t s = 0; s < grid.count; ++s) {
    const UVec3& t = mesh.triangles[samples.triangle[s]];
    const Vec2& b = samples.barycentric[s];
    at.push_back((1 - b.x - b.y) * mesh.positions[t.x] + b.x * mesh.positions[t.y] +
                 b.y * mesh.positions[t.z]);
    normal.push_back(samples.shadingNormal[s]);
  }
  std::vector<float> places;
  std::vector<std::int32_t> rectangles, numbers;
  for (const TexelTriangle& t : grid.triangles) {
    places.insert(places.end(), {t.corner.x, t.corner.y, t.edge1.x, t.edge1.y, t.edge2.x, t.edge2.y});
    rectangles.insert(rectangles.end(), {std::int32_t(t.first), std::int32_t(t.widthHeight & 0xffffu),
                                         std::int32_t(t.widthHeight >> 16)});
  }
  for (const std::uint32_t n : grid.texels) numbers.push_back(n & TexelGrid::kFar ? -1 : std::int32_t(n));
  const auto faces = std::int64_t(grid.triangles.size());
  write("texel_positions", rows(at), "points of the surface that the rows of transfer are of");
  write("texel_normals", rows(normal), "their unit shading normals");
  write("texel_places", Array::from<float>(std::span<const float>(places), {faces, 6}),
        "per triangle, in texels of its chart: u and v of corner 0, then what leads from there to corners 1 "
        "and 2; whole numbers are texels' centres");
  write(
      "texel_rectangles", Array::from<std::int32_t>(std::span<const std::int32_t>(rectangles), {faces, 3}),
      "per triangle: where the texels of its chart begin in texel_numbers, how many in a row, how many rows");
  write("texel_numbers",
        Array::from<std::int32_t>(std::span<const std::int32_t>(numbers), {std::int64_t(numbers.size())}),
        "row of transfer of each texel of each chart; -1 where no surface is near");
}

}  // namespace

ExportedFiles exportParts(const ExportParts& parts, const std::filesystem::path& folder, Job& job) {
  ExportManifest manifest(folder, "npy");
  manifest.set("vertices", parts.mesh.vertexCount()).set("faces", parts.mesh.triangleCount());
  job.begin("arrays", 0);
  const auto write = [&](const std::string& name, const Array& array, const std::string& doc) {
    job.checkCancelled();
    writeNpy(folder / (name + ".npy"), array);
    manifest.addArray(name, array, doc);
  };
  write("positions", rows(parts.mesh.positions), "vertices in the common object frame");
  write("normals", rows(parts.mesh.normals), "unit shading normals");
  write("tangents", rows(vertexTangents(parts.mesh, parts.frames)),
        "unit tangents, at a right angle to the normals");
  write("faces", indices(parts.mesh.triangles), "corners of each triangle, counter-clockwise from outside");
  if (parts.atlas) writeAtlasArrays(parts.mesh, *parts.atlas, job, write);
  if (parts.rtt) writeRtt(*parts.rtt, folder, manifest);
  if (parts.patch) writePatch(*parts.patch, folder, manifest);
  writeLaidPatch(parts.synthesis, parts.idmap, write, manifest);
  return manifest.finish();
}

ExportedFiles exportRtt(const Rtt& rtt, const Patch* patch, const std::filesystem::path& folder) {
  ExportManifest manifest(folder, "npy");
  manifest.set("bands", rtt.bands).set("functions", rtt.functions());
  writeRtt(rtt, folder, manifest);
  if (patch) writePatch(*patch, folder, manifest);
  return manifest.finish();
}

ExportedFiles exportNpy(const ExportInput& input, const std::filesystem::path& folder, Job& job) {
  const Scene& scene = *input.baked.geometry->scene;
  const SampleSet& samples = *input.baked.samples->samples;
  const Transfer& transfer = input.baked.transfer->transfer;
  const std::size_t vertices = scene.mesh.vertexCount();
  ExportManifest manifest(folder, "npy");
  manifest.set("vertices", vertices)
      .set("transfer_where", samples.texels ? "texel" : "vertex")
      .set("samples", samples.size())
      .set("faces", scene.mesh.triangleCount())
      .set("bands", transfer.bands)
      .set("functions", transfer.functions());
  manifest.set("final", input.baked.final())
      .set("rays_per_sample", transfer.raysPerSample)
      .set("bounces", transfer.bounces);
  manifest.setCameras(input.recipe, scene.mesh.bounds());
  job.begin("arrays", 0);
  const auto write = [&](const std::string& name, const Array& array, const std::string& doc) {
    job.checkCancelled();
    writeNpy(folder / (name + ".npy"), array);
    manifest.addArray(name, array, doc);
  };
  write("positions", rows(scene.mesh.positions), "vertices in the common object frame");
  write("normals", rows(scene.mesh.normals), "unit shading normals");
  write("tangents", rows(vertexTangents(scene.mesh, input.frames->frames)),
        "unit tangents, at a right angle to the normals");
  write("faces", indices(scene.mesh.triangles), "corners of each triangle, counter-clockwise from outside");
  if (input.atlas) {
    writeAtlasArrays(scene.mesh, *input.atlas, job, write);
  } else if (!scene.mesh.uv.empty()) {
    write("uv", rows(scene.mesh.uv), "texture coordinates, v up");
    write("uv_faces", indices(scene.mesh.uvTriangles), "corners of each triangle in uv");
  }
  std::vector<std::int32_t> object(scene.vertexObject.begin(), scene.vertexObject.end());
  write("object", Array::from<std::int32_t>(std::span<const std::int32_t>(object), {std::int64_t(vertices)}),
        "object of each vertex");
  std::vector<Vec3> albedo;
  for (const std::uint32_t o : scene.vertexObject) albedo.push_back(input.recipe.objects[o].material.albedo);
  write("albedo", rows(albedo), "diffuse reflectance, linear Rec.709");
  const ShRgb light = sceneLight(input.baked, input.recipe, input.lights, job).light;
  write("light", rows(light.c), "coefficients of the current lights, index l(l+1)+m");
  writeGloss(input, write);
  if (samples.texels) writeTexels(scene.mesh, samples, write);
  if (transfer.form != TransferForm::Diffuse)
    write("transfer", firstRows(expandedMatrices(transfer), samples.fronts()),
          "row = transferred incident radiance, column = light, both in the object frame");
  write("transfer_diffuse", firstRows(whiteLambert(transfer, samples.shadingNormal), samples.fronts()),
        "exit radiance of a white Lambert surface per unit light coefficient");
  if (input.rtt) writeRtt(*input.rtt, folder, manifest);
  if (input.patch) writePatch(*input.patch, folder, manifest);
  writeLaidPatch(input.synthesis.get(), input.idmap.get(), write, manifest);
  if (input.errors) {
    const DVec3& rms = input.errors->rms;
    manifest.set("error_rms", std::vector<double>{rms.x, rms.y, rms.z})
        .set("mean_irradiance", input.errors->meanIrradiance);
    write("error_estimate", rows(input.errors->vertices),
          "estimated error of irradiance under the current lights, relative to its root-mean-square: Monte "
          "Carlo, "
          "interpolation, truncation; -1 inside of something");
  }
  return manifest.finish();
}

}  // namespace prt
