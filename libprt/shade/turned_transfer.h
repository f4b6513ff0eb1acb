#pragma once
// Transfer matrices in the frames of a surface: R_f M_v for every frame f and its vertex v, so that light
// reaches the patch by one product (Bi-Scale Radiance Transfer, 4.1). For graphics cards, which have the
// memory bandwidth for it; BiscaleLight multiplies by M_v and turns what comes out, which reads less.

#include "libprt/core/job.h"
#include "libprt/shade/biscale_view.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/transfer.h"

#include <cstdint>
#include <vector>

namespace prt {

struct TurnedTransfer {
  std::size_t frames = 0;
  int channels = 1;        ///< 1: the same for all three
  std::size_t lights = 0;  ///< functions of the light
  std::size_t padded =
      0;  ///< functions of the result: those of surface.responses, zeros up to a multiple of 8
  std::vector<std::uint16_t> halfs;  ///< [frames][channels][lights][padded]

  bool empty() const { return halfs.empty(); }
};

/// Of all frames. Empty for forms other than Matrix, and where more than `mostBytes` would be needed. Throws
/// ValueError when the transfer is not of this surface, Cancelled.
TurnedTransfer turnedTransfer(const BiscaleSurface& surface, const SampleSet& samples,
                              const Transfer& transfer, std::size_t mostBytes, Job& job);

}  // namespace prt
