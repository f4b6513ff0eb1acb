#include "ui/model/preset_pictures.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/basis/sh_window.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/projection.h"
#include "libprt/material/glossy_response.h"
#include "libprt/shade/tonemap.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace prt::ui {

namespace {

constexpr int kBands = 10;
constexpr float kExposure = -1.3f;  // white plaster is not yet white

Image sphere(const Material& material, const ShRgb& light, int pixels) {
  std::optional<GlossyResponse> glossy;
  if (material.glossy()) glossy.emplace(material.exponent, kBands);
  Image image(pixels, pixels, 4);
  const float radius = 0.5f * float(pixels) - 0.5f;
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x) {
      const Vec2 p = (Vec2(float(x), float(y)) + 0.5f - 0.5f * float(pixels)) / radius;
      const float out = length(p);
      const float coverage = std::clamp((1 - out) * radius + 0.5f, 0.0f, 1.0f);
      if (coverage <= 0) continue;
      const Vec2 inside = out > 0.999f ? p * (0.999f / out) : p;
      const Vec3 normal(inside.x, -inside.y, std::sqrt(1 - dot(inside, inside)));
      const Rgb radiance = exitRadiance(material, glossy ? &*glossy : nullptr, normal, {0, 0, 1}, light.c);
      const Rgb c = toDisplay(radiance, {.exposure = kExposure, .curve = ToneCurve::Filmic});
      float* pixel = image.pixel(x, y);
      std::copy_n(&c.x, 3, pixel);
      pixel[3] = coverage;
    }
  return image;
}

}  // namespace

std::vector<Image> materialPictures(const std::vector<Material>& materials, int pixels, Job& job) {
  const ShRgb light = dering(projectEnvironment(softboxStudio(256, 128), kBands, job)).light;
  job.begin("pictures of materials", double(materials.size()), "materials");
  std::vector<Image> pictures;
  for (const Material& material : materials) {
    job.checkCancelled();
    pictures.push_back(sphere(material, light, pixels));
    job.advance(1);
  }
  return pictures;
}

}  // namespace prt::ui
