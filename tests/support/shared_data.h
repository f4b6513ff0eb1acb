#pragma once
// Real meshes and probes live outside the project. Tests that need them skip, with a message, where
// they are absent - but fail in CI, where they must be there.

#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace prt::test {

inline std::filesystem::path sharedData(const std::string& relative) {
  return sharedDataFolder() / relative;
}

inline bool sharedDataAbsent() {
  return !std::filesystem::exists(sharedDataFolder());
}

}  // namespace prt::test

/// First line of a test that reads ../shared/data.
#define PRT_NEEDS_SHARED_DATA()                                                                   \
  if (prt::test::sharedDataAbsent()) {                                                            \
    if (std::getenv("CI")) FAIL() << "../shared/data must be present in CI";                      \
    GTEST_SKIP() << "needs ../shared/data, which is not here: " << prt::test::sharedDataFolder(); \
  }                                                                                               \
  static_assert(true)
