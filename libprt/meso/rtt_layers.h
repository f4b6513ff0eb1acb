#pragma once
// Radiance transfer textures of several patches as one table, for surfaces that show them side by side.

#include "libprt/meso/rtt.h"

#include <memory>
#include <span>

namespace prt {

/// The tables one after the other (Rtt::layers). One channel where all have one and the same colour, else
/// three with their colours multiplied in. Throws ValueError when they differ in texels, views or bands.
Rtt stackedRtt(std::span<const std::shared_ptr<const Rtt>> tables);

}  // namespace prt
