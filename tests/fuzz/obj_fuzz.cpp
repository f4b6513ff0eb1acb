#include "tests/fuzz/mesh_harness.h"
#include "tests/fuzz/written.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return prt::fuzz::fuzzMesh(prt::parseObj, data, size);
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "obj",
    .seeds =
        [] {
          return joined(writtenSeeds(".obj"), {"mtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0 \\\n\nv 1 1 0\nv 0 1 "
                                               "0\nvt 0 0\nvn 0 0 1\nusemtl red\ng a b\n"
                                               "f -4 -3/1 -2//1 -1/1/1\np 1\nl 1 2\ns off\n",
                                               std::string("v\0 \0001\0 \0002\0 \0003\0\n\0", 16)});
        },
    .words = {"v ",
              "vt ",
              "vn ",
              "f ",
              "g ",
              "o ",
              "usemtl ",
              "mtllib ",
              "\\\n",
              "/",
              "//",
              "\n",
              "\r",
              "\r\n",
              "#",
              std::string(1, '\0'),
              "\xff\xfe",
              "\xef\xbb\xbf",
              "f 1 2 3 4 5 6 7 8\n",
              "v 1 2 3\n"},
    .runs = 40000};
