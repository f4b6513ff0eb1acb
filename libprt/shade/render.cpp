#include "libprt/shade/render.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/material/glossy_response.h"
#include "libprt/shade/background.h"
#include "libprt/shade/sound.h"
#include "libprt/shade/surface_light.h"
#include "libprt/shade/surroundings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace prt {
namespace {

constexpr int kMaxFunctions = kMaxResponseBands * kMaxResponseBands;

/// What a fragment shows: samples with weights, its place in the triangle, and the side that is seen.
struct Surface {
  SamplePlace place;
  int around = 3;  // samples that weigh something
  Vec3 weight{0};  // of the triangle's corners
  UVec3 vertex{0};
  float side = 1;
  const Material* material = nullptr;  // null: nothing is reflected from here
};

Surface surfaceOf(const RenderInput& input, const Fragment& f) {
  Surface s;
  const Material& material = input.scene.materialOf(f.triangle);
  if (f.back && !material.twoSided) return s;
  s.vertex = input.scene.mesh.triangles[f.triangle];
  s.weight = {1 - f.barycentric.x - f.barycentric.y, f.barycentric.x, f.barycentric.y};
  s.side = f.back ? -1.0f : 1.0f;
  s.around = input.samples.around();
  if (!input.samples.at(input.scene.mesh, f.triangle, f.barycentric, f.back, s.place)) return s;
  s.material = &material;
  return s;
}

Vec3 interpolate(const Surface& s, const std::vector<Vec3>& values) {
  return s.weight.x * values[s.vertex.x] + s.weight.y * values[s.vertex.y] + s.weight.z * values[s.vertex.z];
}

/// Shading normal on the side that is seen.
Vec3 normalOf(const RenderInput& input, const Fragment& f, const Surface& s) {
  const Vec3 smooth = interpolate(s, input.scene.mesh.normals);
  const float size = length(smooth);
  if (size > 1e-6f) return s.side / size * smooth;
  const Vec3 face = input.scene.mesh.areaNormal(f.triangle);
  return s.side * (length(face) > 0 ? normalize(face) : Vec3(0, 0, 1));
}

/// The samples that visible triangles use, and where each one's results are.
struct Needed {
  std::vector<std::uint32_t> samples;  // ascending
  std::vector<std::uint32_t> slot;     // [S] index into `samples`
};

Needed neededSamples(const RenderInput& input, const FragmentImage& view, Job& job) {
  if (input.irradiance.empty() && input.transfer.form == TransferForm::None) return {};
  std::vector<std::uint8_t> used(input.samples.size(), 0);
  parallelFor(job, 0, view.tiles.size(), 1, [&](std::size_t tile, std::size_t) {
    for (const Fragment& f : view.tiles[tile].fragments) {
      const Surface s = surfaceOf(input, f);
      if (!s.material) continue;
      for (const std::uint32_t sample : s.place.sample)
        std::atomic_ref(used[sample]).store(1, std::memory_order_relaxed);
    }
  });
  Needed needed;
  needed.slot.resize(used.size(), 0);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    needed.slot[i] = std::uint32_t(needed.samples.size());
    needed.samples.push_back(std::uint32_t(i));
  }
  return needed;
}

/// Interpolates irradiance of the samples.
struct SampleIrradiance {
  const RenderInput& input;
  const Needed& needed;
  std::vector<Rgb> irradiance;  // by slot

  Rgb operator()(const Fragment&, const Surface& s) const {
    Rgb e(0);
    for (int i = 0; i < s.around; ++i)
      e += s.place.weight[i] * irradiance[needed.slot[s.place.sample[std::size_t(i)]]];
    return s.material->albedo * e * (1 / kPiF);
  }
};

/// Interpolates transferred radiance and lets the material respond at the pixel.
struct PixelResponse {
  const RenderInput& input;
  const Needed& needed;
  const Camera& camera;
  bool glossy;
  int bands;
  SurfaceLight arriving;                               // by slot
  std::vector<std::optional<GlossyResponse>> glosses;  // [objects], where glossy

  std::span<const Rgb> incident(const Surface& s, std::array<Rgb, kMaxFunctions>& buffer) const {
    if (input.transfer.form == TransferForm::None) return arriving.radiance;
    const std::size_t n = std::size_t(shCount(bands));
    const Rgb* x[4];
    for (std::size_t i = 0; i < 4; ++i) x[i] = arriving.radiance.data() + n * needed.slot[s.place.sample[i]];
    const Vec4& w = s.place.weight;
    for (std::size_t k = 0; k < n; ++k) buffer[k] = w.x * x[0][k] + w.y * x[1][k] + w.z * x[2][k];
    for (std::size_t k = 0; k < n && s.around == 4; ++k) buffer[k] += w.w * x[3][k];
    return {buffer.data(), n};
  }

  /// See SurfaceLight::beyond: exact at the samples.
  Rgb beyond(const Surface& s) const {
    Rgb sum(0);
    for (int i = 0; i < s.around && !arriving.beyond.empty(); ++i)
      sum += s.place.weight[i] * arriving.beyond[needed.slot[s.place.sample[std::size_t(i)]]];
    return sum;
  }

  Rgb operator()(const Fragment& f, const Surface& s) const {
    std::array<Rgb, kMaxFunctions> buffer;
    const std::span<const Rgb> light = incident(s, buffer);
    const Vec3 normal = normalOf(input, f, s);
    const Rgb rest = s.material->albedo * beyond(s);
    const std::uint32_t object = input.scene.triangleObject[f.triangle];
    if (glossy && glosses[object]) {
      const Vec3 view = camera.towardsViewer(interpolate(s, input.scene.mesh.positions));
      return rest + exitRadiance(*s.material, &*glosses[object], normal, view, light);
    }
    return rest + s.material->albedo * lambertRadiance(bands, normal, light);
  }
};

Rgb emissionOf(const RenderInput& input, const Fragment& f) {
  return input.emission.empty() ? Rgb(0) : input.emission[input.scene.triangleObject[f.triangle]];
}

template <class Shader>
Image shadeTiles(const RenderInput& input, const FragmentImage& view, const Camera& camera,
                 const Shader& shader, Job& job) {
  Image image(view.width, view.height, 4);
  const float part = 1.0f / float(view.grid * view.grid);
  parallelFor(job, 0, view.tiles.size(), 1, [&](std::size_t t, std::size_t) {
    const FragmentTile& tile = view.tiles[t];
    for (int y = 0; y < tile.height; ++y) {
      job.checkCancelled();
      for (int x = 0; x < tile.width; ++x) {
        Rgb sum(0);
        float alpha = 0;
        for (const Fragment& f : tile.pixel(std::size_t(y) * std::size_t(tile.width) + std::size_t(x))) {
          const Surface s = surfaceOf(input, f);
          const float weight = float(f.samples) * part;
          if (s.material) sum += weight * sound(shader(f, s) + emissionOf(input, f));
          alpha += weight;
        }
        float* to = image.pixel(tile.x + x, tile.y + y);
        to[0] = sum.x, to[1] = sum.y, to[2] = sum.z, to[3] = alpha;
      }
    }
  });
  if (input.background) addBackground(*input.background, camera, view.grid, image, job);
  return image;
}

void expectSamples(const RenderInput& input) {
  const auto refuse = [](const std::string& what) {
    throw ValueError(what, "renderer", "bake the scene again");
  };
  const std::size_t samples = input.samples.size();
  if (input.samples.texels) {
    if (input.samples.texels->triangles.size() != input.scene.mesh.triangleCount() ||
        samples < input.samples.texels->count)
      refuse("the texels are of another scene");
  } else if (samples < input.scene.mesh.vertexCount()) {
    refuse("the sample set has fewer samples than the scene has vertices");
  }
  if (!input.irradiance.empty()) {
    if (input.irradiance.size() != samples) refuse("irradiance is not given at every sample");
  } else if (input.transfer.samples != samples) {
    refuse("transfer was baked for " + std::to_string(input.transfer.samples) + " samples, the scene has " +
           std::to_string(samples));
  }
}

void expectFit(const RenderInput& input) {
  if (!input.emission.empty() && input.emission.size() != input.scene.materials.size())
    throw ValueError("emission is not given for every object", "renderer", "give one for each");
  if (!input.irradiance.empty() || input.transfer.form != TransferForm::None) expectSamples(input);
  if (input.irradiance.empty() && input.transfer.bands > kMaxResponseBands &&
      input.transfer.form != TransferForm::Diffuse)
    throw ValueError("transfer has more than " + std::to_string(kMaxResponseBands) + " bands", "renderer",
                     "bake the scene again");
}

PixelResponse pixelResponse(const RenderInput& input, const Needed& needed, const Camera& camera,
                            bool glossy) {
  PixelResponse shader{input, needed, camera, glossy, input.transfer.bands, {}, {}};
  shader.arriving = surfaceLight(input.transfer, input.light, input.samples, needed.samples);
  shader.glosses.resize(input.scene.materials.size());
  for (std::size_t i = 0; glossy && i < shader.glosses.size(); ++i)
    if (input.scene.materials[i].glossy())
      shader.glosses[i].emplace(input.scene.materials[i].exponent, shader.bands);
  return shader;
}

}  // namespace

ShadeMethod resolveMethod(const RenderInput& input) {
  const bool canGloss = input.irradiance.empty() && input.transfer.form != TransferForm::Diffuse;
  if (input.method == ShadeMethod::Glossy && !canGloss)
    throw ValueError("diffuse transfer cannot show a glossy material", "renderer",
                     "bake with transfer.kind=visibility or matrix, or use the diffuse method");
  if (input.method != ShadeMethod::Auto) return input.method;
  const auto& materials = input.scene.materials;
  const bool glossy =
      std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.glossy(); });
  return glossy && canGloss ? ShadeMethod::Glossy : ShadeMethod::Diffuse;
}

Image shade(const RenderInput& input, const FragmentImage& view, const Camera& camera, Job& job) {
  expectFit(input);
  const ShadeMethod method = resolveMethod(input);
  const Needed needed = neededSamples(input, view, job);
  job.checkCancelled();
  if (!input.irradiance.empty() || input.transfer.form == TransferForm::Diffuse) {
    SampleIrradiance shader{input, needed, {}};
    if (input.irradiance.empty())
      shader.irradiance =
          irradiance(input.transfer, input.light, input.samples.shadingNormal, needed.samples);
    else
      for (const std::uint32_t sample : needed.samples) shader.irradiance.push_back(input.irradiance[sample]);
    return shadeTiles(input, view, camera, shader, job);
  }
  return shadeTiles(input, view, camera, pixelResponse(input, needed, camera, method == ShadeMethod::Glossy),
                    job);
}

Image render(const RenderInput& input, const Camera& camera, int width, int height, int grid, Job& job) {
  job.begin("rendering", double(width) * height, "pixels");
  const FragmentImage view =
      rasterize(input.scene.mesh, camera, width, height, grid, job, occluderOf(input.surroundings));
  RenderInput alone = input;
  alone.background = nullptr;
  Image image = shade(alone, view, camera, job);
  addSurroundings(input.surroundings, input.scene.mesh, camera, grid, image, job);
  if (input.background) addBackground(*input.background, camera, grid, image, job);
  job.advance(double(width) * height);
  return image;
}

}  // namespace prt
