#pragma once
// Made-up surfaces that carry a patch: nothing in them is alike, so that whoever mixes anything up is seen.

#include "libprt/core/sampling.h"
#include "libprt/material/glossy_response.h"
#include "libprt/shade/biscale.h"
#include "tests/support/scenes.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace prt::test {

inline constexpr int kBands = 5;
inline constexpr std::size_t kFunctions = 25;

inline float noise(std::uint64_t seed, std::uint64_t index) {
  return 2 * hashUniform(seed, index) - 1;
}

inline ShRgb variedLight() {
  ShRgb light(kBands);
  light.c[0] = Rgb(3.5f);
  for (std::size_t k = 1; k < kFunctions; ++k)
    light.c[k] = 0.4f * Rgb(noise(5, 3 * k), noise(5, 3 * k + 1), noise(5, 3 * k + 2));
  return light;
}

/// Bright enough that sums stay above zero.
inline Rtt variedRtt(int texels, int views, int channels) {
  Rtt rtt(texels, views, kBands, channels);
  for (std::size_t i = 0; i < rtt.values.size(); ++i) rtt.values[i] = 0.1f * noise(7, i);
  for (std::size_t i = 0; i < rtt.values.size(); i += rtt.blockSize())
    for (int c = 0; c < channels; ++c) rtt.values[i + std::size_t(c)] += 0.6f;
  rtt.colour = Rgb(0.9f, 0.5f, 0.7f);
  return rtt;
}

inline Rtt lambertRtt(float albedo) {
  Rtt rtt(2, 4, kBands, 1);
  for (std::size_t i = 0; i < rtt.values.size(); i += kFunctions)
    lambertResponse(kBands, Vec3(0, 0, 1), std::span(rtt.values).subspan(i, kFunctions));
  rtt.colour = Rgb(albedo);
  return rtt;
}

inline Transfer matrices(std::size_t samples, int channels) {
  const std::size_t c = std::size_t(channels);
  std::vector<float> v(samples * kFunctions * kFunctions * c);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = 0.02f * noise(11, i) + (i / c % (kFunctions * kFunctions) % (kFunctions + 1) == 0 ? 0.8f : 0.0f);
  Transfer t;
  t.form = TransferForm::Matrix, t.bands = kBands, t.samples = samples, t.channels = channels;
  t.values = packedMatrices(v, samples, channels, kBands, DType::f32);
  return t;
}

/// A scene with every triangle in a place of its own of a made-up id map.
struct PatchedWorld {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const TangentFrames> frames;
  std::shared_ptr<const PatchCover> cover;
  Rtt rtt;
  SampleSet samples;
  std::shared_ptr<const PlainObjects> plain = {};

  PatchedWorld(Scene made, Rtt table, bool turnSome = false)
      : scene(std::make_shared<Scene>(std::move(made))), rtt(std::move(table)) {
    Job job;
    TangentFrames tangents = makeTangentFrames(scene->mesh, {}, job);
    if (turnSome)  // a seam through the field: a quarter turn in every third triangle
      for (std::size_t t = 0; t < scene->mesh.triangles.size(); t += 3)
        for (int c = 0; c < 3; ++c)
          tangents.tangents[3 * t + std::size_t(c)] = tangents.at(scene->mesh, t, c).bitangent;
    frames = std::make_shared<TangentFrames>(std::move(tangents));
    auto atlas = std::make_shared<Atlas>();
    auto map = std::make_shared<IdMap>();
    map->size = 64;
    for (int i = 0; i < 64 * 64; ++i) {
      const bool empty = i % 97 == 0;
      for (int c = 0; c < 2; ++c)
        map->ids.push_back(empty ? IdMap::kEmpty
                                 : std::uint16_t(65534 * hashUniform(3, std::uint64_t(2 * i + c))));
    }
    for (std::uint32_t t = 0; t < scene->mesh.triangles.size(); ++t) {
      const Vec2 at(hashUniform(4, 2 * t) * 0.7f, hashUniform(4, 2 * t + 1) * 0.7f);
      const auto first = std::uint32_t(atlas->uv.size());
      atlas->uv.insert(atlas->uv.end(), {at, at + Vec2(0.3f, 0), at + Vec2(0, 0.3f)});
      atlas->uvTriangles.push_back({first, first + 1, first + 2});
    }
    cover = std::make_shared<PatchCover>(atlas, map, scene->mesh.triangles.size());
    samples = samplesAtVertices(*scene);
  }

  BiscaleSurface surface() const {
    BiscaleSurface made{scene, frames, cover, std::make_shared<ResponseTable>(rtt)};
    made.plain = plain;
    return made;
  }
  /// One of the tables.
  Rtt table(std::uint32_t layer) const {
    Rtt out = rtt;
    const std::size_t each = rtt.values.size() / std::size_t(rtt.layers);
    out.layers = 1;
    out.values.assign(rtt.values.begin() + std::ptrdiff_t(each * layer),
                      rtt.values.begin() + std::ptrdiff_t(each * (layer + 1)));
    return out;
  }
  /// With `layers` more tables, whose weights differ from texel to texel of the map.
  void layer(int layers) {
    auto map = std::make_shared<IdMap>(*cover->map());
    map->layers = layers;
    for (std::uint64_t i = 0; i < map->ids.size() / 2; ++i) {
      const bool alone = hashUniform(21, i) < 0.3f;  // some show one only
      for (int k = 0; k < layers; ++k)
        map->weights.push_back(
            alone ? (k == int(i % std::uint64_t(layers + 1)) ? 255 : 0)
                  : std::uint8_t(float(255 / layers) * hashUniform(22, i, std::uint32_t(k))));
    }
    cover = std::make_shared<PatchCover>(std::shared_ptr<const Atlas>(cover, cover->atlas()), map,
                                         scene->mesh.triangles.size());
    const std::vector<float> first = rtt.values;
    for (int k = 1; k <= layers; ++k)
      for (std::size_t i = 0; i < first.size(); ++i)
        rtt.values.push_back(first[(i + rtt.blockSize() * std::size_t(k)) % first.size()] *
                             (k == 1 ? 0.4f : 1.3f));
    rtt.layers = layers + 1;
  }
  /// With the objects that carry the patch; the others show the scene's materials.
  void carry(const std::vector<bool>& carries) {
    plain = std::make_shared<PlainObjects>(*scene, carries, scene->materials, rtt.bands);
  }
  Image picture(const Transfer& transfer, const ShRgb& light, const Camera& camera, int width, int height,
                bool viewDependent = true) const {
    Job job;
    const BiscaleSurface made = surface();
    return renderBiscale({made, samples, transfer, light, nullptr, viewDependent}, camera, width, height, 2,
                         job);
  }
};

}  // namespace prt::test
