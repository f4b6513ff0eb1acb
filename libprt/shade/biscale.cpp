#include "libprt/shade/biscale.h"

#include "libprt/basis/sh_kernel.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/background.h"
#include "libprt/shade/half_lanes.h"
#include "libprt/shade/sound.h"
#include "libprt/shade/surface_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prt {
namespace {

using sh_kernel::kLanes;
using sh_kernel::Lanes;
using sh_kernel::load;
using sh_kernel::sum;

constexpr std::size_t kMaxFunctions = 100;

/// Turns of eight frames side by side.
ShTurns<Lanes> turnsOf(const ShadingFrames& shading, std::span<const std::uint32_t> frames) {
  ShTurns<Lanes> out{};
  for (int lane = 0; lane < kLanes; ++lane) {
    const ShTurns<float>& t = shading.turns[frames[std::min(std::size_t(lane), frames.size() - 1)]];
    out.a.cosine[lane] = t.a.cosine, out.a.sine[lane] = t.a.sine;
    out.b.cosine[lane] = t.b.cosine, out.b.sine[lane] = t.b.sine;
    out.c.cosine[lane] = t.c.cosine, out.c.sine[lane] = t.c.sine;
  }
  return out;
}

/// The vertices that frames belong to, ascending, and each frame's place among them.
struct NeededVertices {
  std::vector<std::uint32_t> vertices, place;

  NeededVertices(const ShadingFrames& shading, std::span<const std::uint32_t> frames) {
    vertices.reserve(frames.size());
    for (const std::uint32_t f : frames) vertices.push_back(shading.vertex[f]);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t f : frames)
      place.push_back(std::uint32_t(std::lower_bound(vertices.begin(), vertices.end(), shading.vertex[f]) -
                                    vertices.begin()));
  }
};

void expectFit(const BiscaleSurface& surface, const SampleSet& samples, const Transfer& transfer) {
  const std::size_t vertices = surface.scene->mesh.vertexCount();
  if (transfer.form == TransferForm::None) return;
  if (transfer.form == TransferForm::Diffuse && !surface.matte)
    throw ValueError("diffuse transfer holds too little for a patch", "bi-scale renderer",
                     "bake with transfer.kind=visibility or matrix");
  if (samples.vertices < vertices || transfer.samples != samples.size())
    throw ValueError("transfer was not baked at the vertices of this scene", "bi-scale renderer",
                     "bake the scene again");
}

}  // namespace

BiscaleLight::BiscaleLight(const BiscaleSurface& surface, std::span<const std::uint32_t> frames,
                           const SampleSet& samples, const Transfer& transfer, const ShRgb& light, Job& job)
    : padded_(surface.responses->padded()), records_(frames.size() * 3 * padded_, 0.0f) {
  expectFit(surface, samples, transfer);
  if (frames.empty()) return;
  const NeededVertices needed(surface.shading, frames);
  const SurfaceLight arriving = surfaceLight(transfer, light, samples, needed.vertices);
  if (arriving.form == TransferForm::Diffuse) {
    takeIrradiance(needed.place, arriving.irradiance);
    return;
  }
  const bool everywhere = transfer.form == TransferForm::None;
  const int bands = std::min(arriving.bands, surface.responses->bands());
  const auto functions = std::size_t(shCount(bands)), stride = std::size_t(shCount(arriving.bands));
  parallelFor(job, 0, frames.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::array<Lanes, kMaxFunctions> c, scratch;
    for (std::size_t first = begin; first < end; first += kLanes) {
      const std::size_t lanes = std::min(std::size_t(kLanes), end - first);
      const ShTurns<Lanes> turns = turnsOf(surface.shading, frames.subspan(first, lanes));
      for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t lane = 0; lane < std::size_t(kLanes); ++lane) {
          const std::size_t place = needed.place[first + std::min(lane, lanes - 1)];
          const Rgb* from = arriving.radiance.data() + (everywhere ? 0 : place * stride);
          for (std::size_t k = 0; k < functions; ++k) c[k][int(lane)] = from[k][channel];
        }
        turnSh(bands, turns, c.data(), scratch.data());
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          float* to = records_.data() + ((first + lane) * 3 + std::size_t(channel)) * padded_;
          for (std::size_t k = 0; k < functions; ++k) to[k] = c[k][int(lane)];
        }
      }
    }
  });
}

// Constant light that a matte plane reflects as much of.
void BiscaleLight::takeIrradiance(std::span<const std::uint32_t> place, std::span<const Rgb> irradiance) {
  const float scale = std::sqrt(4 * kPiF) / kPiF;
  for (std::size_t i = 0; i < place.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      records_[(3 * i + c) * padded_] = scale * irradiance[place[i]][int(c)];
}

namespace {

/// Light at a fragment met with the response that of(k) gives for functions k ..: of each channel, or of all
/// three alike.
template <class Response>
Rgb shadeWith(const BiscaleFragment& f, const BiscaleLight& light, const ResponseTable& responses,
              const Response& of) {
  const std::size_t padded = responses.padded();
  const bool coloured = responses.channels() == 3;
  const float* x[3];
  for (std::size_t i = 0; i < 3; ++i) x[i] = light.radiance(f.corner[i]);
  Lanes dots[3]{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < padded; k += kLanes) {
      const std::size_t at = c * padded + k;
      dots[c] += of(coloured ? at : k) *
                 (f.weight.x * load(x[0] + at) + f.weight.y * load(x[1] + at) + f.weight.z * load(x[2] + at));
    }
  return sound(responses.colour() * Rgb(sum(dots[0]), sum(dots[1]), sum(dots[2])));
}

}  // namespace

Rgb shadeBiscale(const BiscaleTile& tile, const BiscaleFragment& f, const BiscaleLight& light,
                 const BiscaleSurface& surface) {
  const ResponseTable& responses = f.plain ? surface.plain->responses() : *surface.responses;
  if (f.filtered) {
    const std::uint16_t* made = tile.responses.data() + std::size_t(f.texel) * responses.blockSize();
    return shadeWith(f, light, responses, [made](std::size_t k) { return loadHalfs(made + k); });
  }
  const std::uint16_t* b[4];
  for (std::size_t i = 0; i < 4; ++i) b[i] = responses.block(f.texel, f.view[i]);
  return shadeWith(f, light, responses, [&](std::size_t k) {
    return f.viewWeight.x * loadHalfs(b[0] + k) + f.viewWeight.y * loadHalfs(b[1] + k) +
           f.viewWeight.z * loadHalfs(b[2] + k) + f.viewWeight.w * loadHalfs(b[3] + k);
  });
}

Image renderBiscale(const BiscaleInput& input, const Camera& camera, int width, int height, int grid,
                    Job& job) {
  job.begin("rendering", double(width) * height, "pixels");
  const BiscaleView view = makeBiscaleView(input.surface, camera, width, height,
                                           {grid, input.viewDependent, occluderOf(input.surroundings)}, job);
  const BiscaleLight light(input.surface, view.frames, input.samples, input.transfer, input.light, job);
  Image image(width, height, 4);
  parallelFor(job, 0, view.tiles.size(), 1, [&](std::size_t t, std::size_t) {
    job.checkCancelled();
    const BiscaleTile& tile = view.tiles[t];
    for (std::size_t p = 0; p < tile.open.size(); ++p)
      image.pixel(tile.x + int(p) % tile.width, tile.y + int(p) / tile.width)[3] = 1 - tile.open[p];
    for (const BiscaleFragment& f : tile.fragments) {
      const Rgb c = f.share * shadeBiscale(tile, f, light, input.surface);
      float* to = image.pixel(tile.x + int(f.pixel) % tile.width, tile.y + int(f.pixel) / tile.width);
      to[0] += c.x, to[1] += c.y, to[2] += c.z;
    }
  });
  addSurroundings(input.surroundings, input.surface.scene->mesh, camera, grid, image, job);
  if (input.background) addBackground(*input.background, camera, grid, image, job);
  job.advance(double(width) * height);
  return image;
}

}  // namespace prt
