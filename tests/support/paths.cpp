#include "tests/support/paths.h"

namespace prt::test {

std::filesystem::path sourceFolder() {
  return PRT_SOURCE_DIR;
}

std::filesystem::path sharedDataFolder() {
  return PRT_SHARED_DATA;
}

}  // namespace prt::test
