#include "libprt/synthesis/layer_masks.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prt {
namespace {

std::vector<Vec3> centresOf(std::span<const LayerSpot> spots) {
  std::vector<Vec3> out;
  for (const LayerSpot& spot : spots) out.push_back(spot.centre);
  return out;
}

float reachOf(std::span<const LayerSpot> spots) {
  float most = 0;
  for (const LayerSpot& spot : spots) most = std::max(most, spot.radius);
  return most;
}

/// 1 up to half the way, then smoothly to 0.
float falloff(float part) {
  const float x = std::clamp(2 * (1 - part), 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

void expectFew(std::size_t layers) {
  if (layers > std::size_t(kMostLayers))
    throw ValueError("there are " + std::to_string(layers) + " layers", "layers",
                     "keep at most " + std::to_string(kMostLayers));
}

}  // namespace

LayerMask::LayerMask(const MesoMesh& meso, std::span<const LayerSpot> spots)
    : spots_(spots.begin(), spots.end()),
      centres_(centresOf(spots)),
      reach_(reachOf(spots)),
      grid_(centres_, reach_ > 0 ? reach_ : 1.0f) {
  for (const Vec3& centre : centres_) {
    std::size_t nearest = 0;
    float least = 1e30f;
    for (std::size_t i = 0; i < meso.vertexCount(); ++i)
      if (const float d = distance(meso.positions[i], centre); d < least) least = d, nearest = i;
    normals_.push_back(meso.vertexCount() > 0 ? meso.normals[nearest] : Vec3(0));
  }
}

float LayerMask::at(const Vec3& position, const Vec3& normal) const {
  float mask = 0;
  grid_.near(position, reach_, [&](std::uint32_t i, float distance2) {
    const LayerSpot& spot = spots_[i];
    if (!(distance2 < spot.radius * spot.radius) || dot(normal, normals_[i]) < 0) return;
    mask = std::max(mask, spot.strength * falloff(std::sqrt(distance2) / spot.radius));
  });
  return mask;
}

void layerWeights(std::span<const LayerMask> masks, const Vec3& position, const Vec3& normal,
                  std::span<float> out) {
  out[0] = 1;
  for (std::size_t k = 0; k < masks.size(); ++k) {
    const float mask = masks[k].at(position, normal);
    for (std::size_t below = 0; below <= k; ++below) out[below] *= 1 - mask;
    out[k + 1] = mask;
  }
}

std::vector<float> vertexLayerWeights(const MesoMesh& meso, std::span<const LayerMask> masks, Job& job) {
  expectFew(masks.size());
  std::vector<float> out;
  if (masks.empty()) return out;
  const std::size_t each = masks.size() + 1;
  out.resize(meso.vertexCount() * each);
  parallelFor(job, 0, meso.vertexCount(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      layerWeights(masks, meso.positions[i], meso.normals[i], std::span(out).subspan(i * each, each));
  });
  return out;
}

void addLayers(IdMap& map, const TexelSurface& texels, std::span<const LayerMask> masks, Job& job) {
  expectFew(masks.size());
  map.layers = int(masks.size());
  const std::size_t count = map.ids.size() / 2, layers = masks.size();
  map.weights.assign(count * layers, 0);
  if (masks.empty()) return;
  parallelFor(job, 0, count, 16384, [&](std::size_t begin, std::size_t end) {
    std::array<float, kMostLayers + 1> weights{};
    for (std::size_t i = begin; i < end; ++i) {
      if (map.empty(i)) continue;
      layerWeights(masks, texels.position[i], texels.normal[i], std::span(weights).first(layers + 1));
      int left = 255;  // what rounding takes from one it must not give to two
      for (std::size_t k = layers; k-- > 0;) {
        const int part = std::min(left, int(std::lround(weights[k + 1] * 255)));
        map.weights[i * layers + k] = std::uint8_t(part);
        left -= part;
      }
    }
  });
}

}  // namespace prt
