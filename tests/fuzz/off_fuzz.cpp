#include "tests/fuzz/mesh_harness.h"
#include "tests/fuzz/written.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return prt::fuzz::fuzzMesh(prt::parseOff, data, size);
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "off",
    .seeds =
        [] {
          return joined(writtenSeeds(".off"), {"STCNOFF # all\n3 1 3\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 "
                                               "1 1 1 1 0\n0 1 0 0 0 1 1 1 1 1 0 1\n3 0 1 2 255 0 0\n",
                                               "OFF 4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n2 0 1\n"});
        },
    .words = {"OFF\n", "COFF\n", "NOFF ", "ST", "BINARY", "#", "\n", "3 0 1 2\n", "0\n", "4 0 1 2 3\n"},
    .runs = 60000};
