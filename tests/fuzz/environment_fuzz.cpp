// Images of every format that is read, as environment maps.

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/light/environment_io.h"
#include "libprt/light/projection.h"
#include "tests/fuzz/image_limits.h"
#include "tests/fuzz/target.h"
#include "tests/light/light_test_support.h"
#include "tests/support/temporary_folder.h"

#include <cstring>

using namespace prt;
using fuzz::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::span<const std::byte> file(reinterpret_cast<const std::byte*>(data), size);
    const EnvironmentMap map = makeEnvironment(readImage(file, "fuzzed", fuzz::kImageLimits), "fuzzed");
    for (const float value : map.pixels().data) require(value >= 0 && value <= kMaxRadiance);
    require(std::strchr(map.report().warning().c_str(), '\n') == nullptr);
    if (map.pixels().pixels() > 10'000) return 0;
    for (const Rgb& c : projectEnvironment(map, 3).c) require(isFinite(c));
    require(isFinite(map.radiance({0.6f, 0, 0.8f})));
  } catch (const Error& error) {
    require(std::strchr(error.what(), '\n') == nullptr);
  }
  return 0;
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "environment",
    .seeds =
        [] {
          const test::TemporaryFolder folder;
          std::vector<std::string> seeds;
          for (const MapGeometry& g : {MapGeometry(EnvironmentMapping::LatLong, 16, 8),
                                       MapGeometry(EnvironmentMapping::VerticalCross, 12, 16),
                                       MapGeometry(EnvironmentMapping::AngularMap, 12, 12)})
            for (const std::string name : {"map.exr", "map.hdr", "map.png"}) {
              writeImage(folder / name, test::randomMap(g, 43, 10).pixels());
              const std::vector<std::byte> bytes = readFile(folder / name);
              seeds.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            }
          return seeds;
        },
    .words = {"-Y 8 +X 16\n", "-Y 2000000000 +X 2\n", "#?RADIANCE\n", "FORMAT=32-bit_rle_rgbe\n", "IHDR",
              "IDAT", "IEND", "channels", "chlist", "compression", "dataWindow", "box2i", "tiles", "tiledesc",
              std::string("\2\2\0\x10", 4)},
    .runs = 3000,
    .memoryBase = std::size_t{256} << 20,
    .memoryPerByte = 16 * 1024};
