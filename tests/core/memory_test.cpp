#include "libprt/core/memory.h"
#include "libprt/core/cpu.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <string>

namespace prt {
namespace {

TEST(Memory, SomeIsAvailableButNotEverything) {
  EXPECT_GT(availableMemory(), std::size_t(1) << 20);
  EXPECT_LT(availableMemory(), std::size_t(1) << 50);
  EXPECT_NO_THROW(requireMemory(1 << 20, "A small thing"));
}

TEST(Memory, ErrorsGiveBothNumbers) {
  try {
    requireMemory(std::size_t(3) << 60, "The transfer of 9 samples", "use fewer bands");
    FAIL();
  } catch (const ResourceError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("The transfer of 9 samples needs 3458764513.8 GB of memory, ")) << text;
    EXPECT_NE(text.find("B are available (use fewer bands)"), std::string::npos) << text;
  }
}

TEST(Cpu, ThisOneRunsTheBuild) {
  EXPECT_EQ(cpuProblem(), nullptr);
}

}  // namespace
}  // namespace prt
