#pragma once
// How much memory there is, so that what cannot fit is refused before it starts.

#include <cstddef>
#include <string>

namespace prt {

/// Bytes that this process can still take without swapping or running into its container's limit.
std::size_t availableMemory();

/// Throws ResourceError with both numbers unless `bytes` are available: "WHAT needs 3.2 GB of memory,
/// 1.1 GB are available (FIX)".
void requireMemory(std::size_t bytes, const std::string& what,
                   const std::string& fix = "close other programs or ask for less");

}  // namespace prt
