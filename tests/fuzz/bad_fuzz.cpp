// A harness with every fault that the driver must find: the first letter of the input chooses.

#include "tests/fuzz/target.h"

#include <cstdlib>
#include <stdexcept>

char* volatile sink = nullptr;  // keeps the compiler from leaving allocations out

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const char fault = size > 0 ? char(data[0]) : ' ';
  if (fault == 'a') std::abort();
  if (fault == 't') throw std::out_of_range("a library's own exception");
  if (fault == 'b') sink = new char[std::size_t{1} << 40];  // one big block
  if (fault == 'm') {                                       // many small ones
    std::vector<std::string> blocks;
    while (blocks.size() < (1u << 20)) blocks.emplace_back(1000, 'x');
    sink = blocks[0].data();
  }
  return 0;
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "bad", .seeds = [] { return std::vector<std::string>{"good"}; }, .words = {}, .runs = 0};
