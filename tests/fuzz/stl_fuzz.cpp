#include "tests/fuzz/mesh_harness.h"
#include "tests/fuzz/written.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return prt::fuzz::fuzzMesh(prt::parseStl, data, size);
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "stl",
    .seeds =
        [] {
          return joined(writtenSeeds(".stl"),
                        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                         "0\nendloop\nendfacet\n"
                         "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nvertex 0 "
                         "2 0\nendloop\nendfacet\nendsolid a\n"});
        },
    .words = {"solid", "facet normal 0 0 1\n", "outer loop\n", "vertex ", "endloop\n", "endfacet\n",
              "endsolid\n", "\n"},
    .runs = 40000};
