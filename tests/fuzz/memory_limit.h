#pragma once
// Counts what operator new has handed out in this program.

#include <cstddef>

namespace prt::fuzz {

/// From now on, holding more than `bytes` on top of what is held now ends the process with a message.
void limitMemory(std::size_t bytes);
/// Most bytes held at a time since limitMemory, on top of what was held then.
std::size_t peakMemory();

}  // namespace prt::fuzz
