#pragma once
// Where this checkout lies. Compiled into one small file, so that the others build alike in every checkout.

#include <filesystem>

namespace prt::test {

/// The top of the source tree.
std::filesystem::path sourceFolder();

/// Test data that other people made: ../shared/data, which need not exist.
std::filesystem::path sharedDataFolder();

}  // namespace prt::test
