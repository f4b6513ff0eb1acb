#pragma once
// What a fuzz harness tells the driver about itself. A harness is one source file that defines
//
//   extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
//   const prt::fuzz::Target prt::fuzz::target{...};
//
// The first is libFuzzer's entry point: with Clang and -DPRT_LIBFUZZER=ON the harness links to libFuzzer;
// otherwise, and in the tests, to our own driver, which mutates the seeds below in an order fixed by its
// seed. An input may end in a prt::Error, which the harness catches; anything else is a failure.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace prt::fuzz {

struct Target {
  const char* name;
  /// Small valid inputs, made in the harness.
  std::function<std::vector<std::string>()> seeds;
  /// Words worth inserting: keywords, extreme numbers of the format.
  std::vector<std::string> words;
  std::size_t runs = 8000;  ///< in the tests, a few seconds; fifty times that with PRT_FULL set
  /// Most memory that one input may hold at a time.
  std::size_t memoryBase = std::size_t{24} << 20;
  std::size_t memoryPerByte = 4096;
};

extern const Target target;

/// What must hold for every input: a failure of the run.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace prt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
