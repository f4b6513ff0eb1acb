#pragma once
// In which order to eliminate the unknowns of a sparse symmetric system, so that little fills in.

#include "libprt/core/job.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace prt {

/// The node at each place of the order; `edges` are pairs of nodes, each once. Approximate minimum degree
/// (Eigen's), which cannot be stopped and takes a second per million nodes: graphs beyond `most` nodes are
/// taken apart first, by the narrowest level set near the middle of a search in breadth, which comes last
/// (nested dissection, George 1973). Throws Cancelled.
std::vector<std::uint32_t> eliminationOrder(std::size_t nodes,
                                            std::span<const std::pair<std::uint32_t, std::uint32_t>> edges,
                                            Job& job, std::size_t most = 16384);

}  // namespace prt
