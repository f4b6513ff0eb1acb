#include "libprt/shade/live_shading.h"

#include "libprt/basis/sh_kernel.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/sound.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

using sh_kernel::Lanes;
using sh_kernel::load;
using sh_kernel::store;
using sh_kernel::sum;
static_assert(kLiveLanes == sh_kernel::kLanes);

constexpr int kMaxBands = 10;
constexpr std::size_t kMaxPadded = 104;  // functions of ten bands and zeros up to a multiple of the lanes

constexpr std::size_t paddedCount(int bands) {
  return (std::size_t(shCount(bands)) + kLiveLanes - 1) / kLiveLanes * kLiveLanes;
}

/// View angle of a table's row.
float rowAngle(int row) {
  const float away = 1 - float(row) / float(LiveMaterials::kRows - 1);
  return 0.5f * kPiF * (1 - away * away);
}

/// Turns values by function, a vector over fragments each, into values by fragment.
void byFragment(const Lanes* values, std::size_t padded, float (*out)[kMaxPadded]) {
  for (std::size_t k = 0; k < padded; k += kLiveLanes) {
    std::array<Lanes, kLiveLanes> block;
    std::copy_n(values + k, kLiveLanes, block.begin());
    sh_kernel::transpose(block);
    for (std::size_t lane = 0; lane < kLiveLanes; ++lane) store(block[lane], out[lane] + k);
  }
}

const std::array<float, kMaxBands>& cosineFactors() {
  static const std::array<float, kMaxBands> factors = [] {
    std::array<float, kMaxBands> all{};
    // As lambertResponse(): read off the zonal functions along the normal.
    std::array<float, kMaxBands * kMaxBands> response, y;
    lambertResponse(kMaxBands, Vec3(0, 0, 1), response);
    shEvaluate(kMaxBands, Vec3(0, 0, 1), y);
    for (int l = 0; l < kMaxBands; ++l)
      all[std::size_t(l)] = response[std::size_t(shIndex(l, 0))] / y[std::size_t(shIndex(l, 0))];
    return all;
  }();
  return factors;
}

template <int Bands>
void lambert(const LiveTile& tile, std::size_t first, float (*out)[kMaxPadded]) {
  constexpr std::size_t padded = paddedCount(Bands);
  std::array<Lanes, padded> y{};
  sh_kernel::evaluateFixed<Bands, float>(load(&tile.normal[0][first]), load(&tile.normal[1][first]),
                                         load(&tile.normal[2][first]), Lanes{} + 1.0f,
                                         [&](int k, Lanes value) { y[std::size_t(k)] = value; });
  const auto& factors = cosineFactors();
  for (int l = 0; l < Bands; ++l)
    for (int k = l * l; k < (l + 1) * (l + 1); ++k) y[std::size_t(k)] *= factors[std::size_t(l)];
  byFragment(y.data(), padded, out);
}

/// Weights of the lobes at each fragment's view angle, between two rows of its table: [lane][function].
void lobeWeights(const std::array<const float*, kLiveLanes>& table,
                 const std::array<float, kLiveLanes>& angle, std::size_t padded, Lanes* weights) {
  float rows[kLiveLanes][kMaxPadded];
  for (std::size_t lane = 0; lane < kLiveLanes; ++lane) {
    const float position =
        float(LiveMaterials::kRows - 1) * (1 - std::sqrt(std::max(0.0f, 1 - angle[lane] * (2 / kPiF))));
    const int row = std::clamp(int(position), 0, LiveMaterials::kRows - 2);
    const float between = position - float(row);
    const float* a = table[lane] + std::size_t(row) * padded;
    for (std::size_t k = 0; k < padded; k += kLiveLanes) {
      const Lanes low = load(a + k), high = load(a + padded + k);
      store(low + between * (high - low), rows[lane] + k);
    }
  }
  for (std::size_t k = 0; k < padded; k += kLiveLanes) {
    std::array<Lanes, kLiveLanes> block;
    for (std::size_t lane = 0; lane < kLiveLanes; ++lane) block[lane] = load(rows[lane] + k);
    sh_kernel::transpose(block);
    std::copy(block.begin(), block.end(), weights + k);
  }
}

/// Response of the lobe, see GlossyResponse::evaluate().
template <int Bands>
void gloss(const LiveTile& tile, std::size_t first, const std::array<const float*, kLiveLanes>& table,
           const std::vector<Vec2>& lobes, float (*out)[kMaxPadded]) {
  constexpr std::size_t padded = paddedCount(Bands);
  Lanes normal[3], tangent[3];
  std::array<float, kLiveLanes> angle;
  for (std::size_t i = 0; i < 3; ++i) normal[i] = load(&tile.normal[i][first]);
  for (std::size_t lane = 0; lane < kLiveLanes; ++lane) {
    const Vec3 n(tile.normal[0][first + lane], tile.normal[1][first + lane], tile.normal[2][first + lane]);
    const Vec3 v(tile.view[0][first + lane], tile.view[1][first + lane], tile.view[2][first + lane]);
    const Vec3 flat = v - dot(n, v) * n;
    const float sine = length(flat);
    const Vec3 along = sine > 1e-6f ? flat / sine : frameFromNormal(n).tangent;
    angle[lane] = std::atan2(sine, std::clamp(dot(n, v), 0.0f, 1.0f));
    for (int i = 0; i < 3; ++i) tangent[i][int(lane)] = along[i];
  }
  std::array<Lanes, padded> weights, response{};
  lobeWeights(table, angle, padded, weights.data());
  for (int j = 0; j < Bands; ++j) {
    const Vec2& lobe = lobes[std::size_t(j)];
    std::array<Lanes, std::size_t(shCount(Bands))> y;
    sh_kernel::evaluateFixed<Bands, float>(lobe.x * tangent[0] + lobe.y * normal[0],
                                           lobe.x * tangent[1] + lobe.y * normal[1],
                                           lobe.x * tangent[2] + lobe.y * normal[2], Lanes{} + 1.0f,
                                           [&](int k, Lanes value) { y[std::size_t(k)] = value; });
    for (int l = 0; l < Bands; ++l)
      for (int k = l * l; k < (l + 1) * (l + 1); ++k)
        response[std::size_t(k)] += weights[std::size_t(l * Bands + j)] * y[std::size_t(k)];
  }
  byFragment(response.data(), padded, out);
}

/// What the surface reflects apart from its radiance, between the samples around a fragment.
Rgb reflectedAt(const LiveTile& tile, std::size_t fragment, int around, const LiveLight& light) {
  const auto& slot = tile.slot[fragment];
  const Vec4& w = tile.weight[fragment];
  Rgb sum = w.x * light.reflected(slot[0]) + w.y * light.reflected(slot[1]) + w.z * light.reflected(slot[2]);
  if (around == 4) sum += w.w * light.reflected(slot[3]);
  return sum;
}

template <int Bands>
void shadeBands(const LiveTile& tile, int around, std::size_t first, const LiveLight& light,
                const LiveMaterials& materials, std::array<Rgb, kLiveLanes>& radiance) {
  constexpr std::size_t padded = paddedCount(Bands);
  float diffuse[kLiveLanes][kMaxPadded], glossy[kLiveLanes][kMaxPadded];
  lambert<Bands>(tile, first, diffuse);
  std::array<const float*, kLiveLanes> table{};
  const float* anyTable = nullptr;
  for (std::size_t lane = 0; lane < kLiveLanes; ++lane) {
    table[lane] = materials[tile.object[first + lane]].table;
    if (table[lane]) anyTable = table[lane];
  }
  if (anyTable) {
    auto filled = table;
    for (const float*& each : filled)
      if (!each) each = anyTable;
    gloss<Bands>(tile, first, filled, materials.lobes(), glossy);
  }
  for (std::size_t lane = 0; lane < kLiveLanes; ++lane) {
    const auto& slot = tile.slot[first + lane];
    const Vec4& w = tile.weight[first + lane];
    const float *x0 = light.radiance(slot[0]), *x1 = light.radiance(slot[1]), *x2 = light.radiance(slot[2]),
                *x3 = light.radiance(slot[3]);
    const LiveMaterials::Row& material = materials[tile.object[first + lane]];
    Lanes dots[3]{}, shine[3]{};
    for (std::size_t k = 0; k < padded; k += kLiveLanes) {
      const Lanes r = load(diffuse[lane] + k), g = table[lane] ? load(glossy[lane] + k) : Lanes{};
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = c * padded + k;
        Lanes x = w.x * load(x0 + at) + w.y * load(x1 + at) + w.z * load(x2 + at);
        if (around == 4) x += w.w * load(x3 + at);
        dots[c] += r * x;
        shine[c] += g * x;
      }
    }
    const Rgb beyond = reflectedAt(tile, first + lane, around, light);
    for (int c = 0; c < 3; ++c)
      radiance[lane][c] = sound(material.emission[c] + material.albedo[c] * beyond[c] +
                                sum(material.albedo[c] * dots[c] + material.specular[c] * shine[c]));
  }
}

void shadeDiffuse(const LiveTile& tile, int around, std::size_t first, const LiveLight& light,
                  const LiveMaterials& materials, std::array<Rgb, kLiveLanes>& radiance) {
  for (std::size_t lane = 0; lane < kLiveLanes; ++lane) {
    const Rgb white = reflectedAt(tile, first + lane, around, light);
    const LiveMaterials::Row& material = materials[tile.object[first + lane]];
    const Rgb exit = material.emission + material.albedo * white;
    radiance[lane] = {sound(exit.x), sound(exit.y), sound(exit.z)};
  }
}

}  // namespace

LiveLight::LiveLight(const SurfaceLight& light, Job& job)
    : form_(light.form), bands_(light.bands), padded_(paddedCount(light.bands)), reflected_(light.beyond) {
  if (form_ == TransferForm::Diffuse) {
    reflected_ = light.irradiance;
    for (Rgb& each : reflected_) each *= 1 / kPiF;
    return;
  }
  const std::size_t functions = std::size_t(shCount(bands_)), count = light.radiance.size() / functions;
  records_.resize(count * stride());
  parallelFor(job, 0, count, 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const Rgb* from = light.radiance.data() + s * functions;
      float* to = records_.data() + s * stride();
      for (std::size_t k = 0; k < functions; ++k)
        for (std::size_t c = 0; c < 3; ++c) to[c * padded_ + k] = from[k][int(c)];
    }
  });
}

void LiveMaterials::set(const std::vector<Material>& materials, int bands, bool glossy,
                        const std::vector<Rgb>& emission) {
  rows_.clear();
  for (const Material& m : materials) {
    Row row{m.albedo, m.specular, emission.empty() ? Rgb(0) : emission[rows_.size()], nullptr};
    if (glossy && m.glossy()) row.table = tableOf(m.exponent, bands).values.data();
    rows_.push_back(row);
  }
  // Those of other exponents have had their time.
  std::erase_if(tables_, [&](const Table& t) {
    return std::none_of(rows_.begin(), rows_.end(),
                        [&](const Row& row) { return row.table == t.values.data(); });
  });
}

const LiveMaterials::Table& LiveMaterials::tableOf(float exponent, int bands) {
  for (const Table& table : tables_)
    if (table.exponent == exponent && table.bands == bands) return table;
  const GlossyResponse response(exponent, bands);
  lobes_.assign(response.lobes().begin(), response.lobes().end());
  Table table{exponent, bands, std::vector<float>(std::size_t(kRows) * paddedCount(bands), 0.0f)};
  for (int row = 0; row < kRows; ++row)
    response.weightsAt(
        rowAngle(row),
        std::span(table.values).subspan(std::size_t(row) * paddedCount(bands), std::size_t(shCount(bands))));
  return tables_.emplace_back(std::move(table));
}

void shadeLive(const LiveTile& tile, int around, std::size_t first, const LiveLight& light,
               const LiveMaterials& materials, std::array<Rgb, kLiveLanes>& radiance) {
  if (light.form() == TransferForm::Diffuse)
    return shadeDiffuse(tile, around, first, light, materials, radiance);
  switch (light.bands()) {
    case 1:
      return shadeBands<1>(tile, around, first, light, materials, radiance);
    case 2:
      return shadeBands<2>(tile, around, first, light, materials, radiance);
    case 3:
      return shadeBands<3>(tile, around, first, light, materials, radiance);
    case 4:
      return shadeBands<4>(tile, around, first, light, materials, radiance);
    case 5:
      return shadeBands<5>(tile, around, first, light, materials, radiance);
    case 6:
      return shadeBands<6>(tile, around, first, light, materials, radiance);
    case 7:
      return shadeBands<7>(tile, around, first, light, materials, radiance);
    case 8:
      return shadeBands<8>(tile, around, first, light, materials, radiance);
    case 9:
      return shadeBands<9>(tile, around, first, light, materials, radiance);
    default:
      return shadeBands<10>(tile, around, first, light, materials, radiance);
  }
}

}  // namespace prt
