#include "tests/fuzz/mesh_harness.h"
#include "tests/fuzz/written.h"

#include <string>
#include <string_view>

using namespace std::string_view_literals;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return prt::fuzz::fuzzMesh(prt::parsePly, data, size);
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "ply",
    .seeds =
        [] {
          return joined(
              writtenSeeds(".ply"),
              {"ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty float "
               "z\n"
               "property list uchar int n\nelement face 2\nproperty list uchar int "
               "vertex_indices\nend_header\n"
               "0 0 0 1 5\n1 0 0 0\n1 1 0 0\n0 1 0 2 1 2\n4 0 1 2 3\n3 0 2 3\n",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
               "z\n"
               "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 "
               "0\n1 1 0\n"
               "6 0 1 2 3 -1 0\n",
               std::string(
                   "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty short x\nproperty char y\n"
                   "property double z\nend_header\n\0\1\2\0\0\0\0\0\0\0\0"sv)});
        },
    .words = {"element vertex ", "element face ", "property list uchar int vertex_indices\n",
              "property float x\n", "end_header\n", "format ascii 1.0\n", "format binary_little_endian 1.0\n",
              "format binary_big_endian 1.0\n", "double ", "list ", "uint ", "comment ", "\n"},
    .runs = 60000};
