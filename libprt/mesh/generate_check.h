#pragma once
// Range checks shared by the generators.

#include "libprt/core/error.h"

#include <cmath>
#include <string>

namespace prt {

/// Throws ValueError unless low <= value <= high (which no NaN is).
template <class T>
void requireRange(const char* name, T value, T low, T high) {
  if (value >= low && value <= high) return;
  throw ValueError(std::string(name) + " is " + std::to_string(value), "shape options",
                   "give a value from " + std::to_string(low) + " to " + std::to_string(high));
}

/// A length: positive, finite, and of a size whose square is still a float.
inline void requireLength(const char* name, float value) {
  requireRange(name, value, 1e-12f, 1e12f);
}

}  // namespace prt
