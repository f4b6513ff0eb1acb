#pragma once
// Asking before taking: a bake that does not fit says so at once.

#include <cstddef>
#include <string>

namespace prt {

/// Throws ResourceError, naming `what` is to be made and the `fix`, when `bytes` is more than this machine
/// can give now.
void requireMemory(std::size_t bytes, const std::string& what, const std::string& fix);

}  // namespace prt
