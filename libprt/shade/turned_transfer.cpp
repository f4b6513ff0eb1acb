#include "libprt/shade/turned_transfer.h"

#include "libprt/basis/sh_kernel.h"
#include "libprt/core/error.h"
#include "libprt/core/half.h"
#include "libprt/core/parallel.h"

#include <algorithm>
#include <array>
#include <vector>

namespace prt {
namespace {

using sh_kernel::kLanes;
using sh_kernel::Lanes;

constexpr std::size_t kMaxFunctions = 100;

ShTurns<Lanes> broadcast(const ShTurns<float>& t) {
  ShTurns<Lanes> out{};
  out.a.cosine += t.a.cosine, out.a.sine += t.a.sine;
  out.b.cosine += t.b.cosine, out.b.sine += t.b.sine;
  out.c.cosine += t.c.cosine, out.c.sine += t.c.sine;
  return out;
}

}  // namespace

TurnedTransfer turnedTransfer(const BiscaleSurface& surface, const SampleSet& samples,
                              const Transfer& transfer, std::size_t mostBytes, Job& job) {
  TurnedTransfer out;
  if (transfer.form != TransferForm::Matrix) return out;
  if (samples.vertices < surface.scene->mesh.vertexCount() || transfer.samples != samples.size())
    throw ValueError("transfer was not baked at the vertices of this scene", "bi-scale renderer",
                     "bake the scene again");
  out.frames = surface.shading.size();
  out.channels = transfer.channels;
  out.lights = std::size_t(transfer.functions());
  out.padded = surface.responses->padded();
  const std::size_t each = std::size_t(out.channels) * out.lights * out.padded;
  if (surface.shading.size() * each * sizeof(std::uint16_t) > mostBytes) return out;
  out.halfs.assign(surface.shading.size() * each, 0);
  const int bands = std::min(transfer.bands, surface.responses->bands());
  const auto kept = std::size_t(shCount(bands));
  job.begin("transfer in the frames of the surface", double(surface.shading.size()), "frames");
  parallelFor(job, 0, surface.shading.size(), 64, [&](std::size_t begin, std::size_t end) {
    std::array<Lanes, kMaxFunctions> c, scratch;
    std::vector<float> matrix(std::size_t(out.channels) * out.lights * out.lights);
    for (std::size_t f = begin; f < end; ++f) {
      matrixOf(transfer, surface.shading.vertex[f], matrix);
      const ShTurns<Lanes> turns = broadcast(surface.shading.turns[f]);
      for (std::size_t channel = 0; channel < std::size_t(out.channels); ++channel)
        for (std::size_t first = 0; first < out.lights; first += kLanes) {  // eight columns side by side
          const std::size_t lanes = std::min(std::size_t(kLanes), out.lights - first);
          for (std::size_t lane = 0; lane < std::size_t(kLanes); ++lane)
            for (std::size_t k = 0; k < kept; ++k)
              c[k][int(lane)] =
                  matrix[(channel * out.lights + first + std::min(lane, lanes - 1)) * out.lights + k];
          turnSh(bands, turns, c.data(), scratch.data());
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            std::uint16_t* to =
                out.halfs.data() +
                ((f * std::size_t(out.channels) + channel) * out.lights + first + lane) * out.padded;
            for (std::size_t k = 0; k < kept; ++k)
              to[k] = toHalf(std::clamp(c[k][int(lane)], -kLargestHalf, kLargestHalf));
          }
        }
    }
  });
  return out;
}

}  // namespace prt
