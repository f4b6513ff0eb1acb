// Transfer as plain matrices and vectors, and everything as .npy files.

#include "libprt/core/npy.h"
#include "libprt/material/glossy_response.h"
#include "libprt/project/export.h"
#include "libprt/project/export_manifest.h"
#include "libprt/project/lights.h"

namespace prt {
namespace {

template <class V>
Array rows(const std::vector<V>& vectors) {
  const float* first = vectors.empty() ? nullptr : &vectors[0][0];
  return Array::from<float>(std::span(first, vectors.size() * std::size_t(V::length())), {std::int64_t(vectors.size()), V::length()});
}

Array indices(const std::vector<UVec3>& triangles) {
  std::vector<std::int32_t> flat;
  flat.reserve(3 * triangles.size());
  for (const UVec3& t : triangles) flat.insert(flat.end(), {std::int32_t(t.x), std::int32_t(t.y), std::int32_t(t.z)});
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
    if (length(flat) > 0.1f) sums[v] = normalize(flat);
    else sums[v] = any[v] == Vec3(0) ? frameFromNormal(n).tangent : any[v];
  }
  return sums;
}

/// The first `count` rows of an array: the vertices come first among the samples.
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
      lambertResponse(transfer.bands, normals[s], std::span(values).subspan(s * std::size_t(k), std::size_t(k)));
    return Array::from<float>(std::span<const float>(values), {std::int64_t(normals.size()), k});
  }
  Array vectors = diffuseVectors(transfer);
  auto* values = reinterpret_cast<float*>(vectors.bytes.data());
  for (std::size_t i = 0; i < vectors.size(); ++i) values[i] /= kPiF;
  return vectors;
}

}  // namespace

ExportedFiles exportNpy(const ExportInput& input, const std::filesystem::path& folder, Job& job) {
  const Scene& scene = *input.baked.geometry->scene;
  const SampleSet& samples = *input.baked.samples->samples;
  const Transfer& transfer = input.baked.transfer->transfer;
  const std::size_t vertices = scene.mesh.vertexCount();
  ExportManifest manifest(folder, "npy");
  manifest.set("vertices", vertices).set("samples", samples.size()).set("faces", scene.mesh.triangleCount()).set("bands", transfer.bands).set("functions", transfer.functions());
  manifest.set("final", input.baked.final()).set("rays_per_sample", transfer.raysPerSample).set("bounces", transfer.bounces);
  job.begin("arrays", 0);
  const auto write = [&](const std::string& name, const Array& array, const std::string& doc) {
    job.checkCancelled();
    writeNpy(folder / (name + ".npy"), array);
    manifest.addArray(name, array, doc);
  };
  write("positions", rows(scene.mesh.positions), "vertices in the common object frame");
  write("normals", rows(scene.mesh.normals), "unit shading normals");
  write("tangents", rows(vertexTangents(scene.mesh, input.frames->frames)), "unit tangents, at a right angle to the normals");
  write("faces", indices(scene.mesh.triangles), "corners of each triangle, counter-clockwise from outside");
  if (!scene.mesh.uv.empty()) {
    write("uv", rows(scene.mesh.uv), "texture coordinates, v up");
    write("uv_faces", indices(scene.mesh.uvTriangles), "corners of each triangle in uv");
  }
  std::vector<std::int32_t> object(scene.vertexObject.begin(), scene.vertexObject.end());
  write("object", Array::from<std::int32_t>(std::span<const std::int32_t>(object), {std::int64_t(vertices)}), "object of each vertex");
  std::vector<Vec3> albedo;
  for (const std::uint32_t o : scene.vertexObject) albedo.push_back(input.recipe.objects[o].material.albedo);
  write("albedo", rows(albedo), "diffuse reflectance, linear Rec.709");
  const ShRgb light = lightFor(input.lights, transfer.bands, input.recipe.method);
  write("light", rows(light.c), "coefficients of the current lights, index l(l+1)+m");
  if (transfer.form != TransferForm::Diffuse)
    write("transfer", firstRows(expandedMatrices(transfer), vertices),
          "row = transferred incident radiance, column = light, both in the object frame");
  write("transfer_diffuse", firstRows(whiteLambert(transfer, samples.shadingNormal), vertices),
        "exit radiance of a white Lambert surface per unit light coefficient");
  return manifest.finish();
}

}  // namespace prt
