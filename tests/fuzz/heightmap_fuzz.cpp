// Images of every format that is read, as height maps and colours of patches.

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/meso/patch_build.h"
#include "tests/fuzz/image_limits.h"
#include "tests/fuzz/target.h"
#include "tests/support/temporary_folder.h"

#include <cstring>

using namespace prt;
using fuzz::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::span<const std::byte> file(reinterpret_cast<const std::byte*>(data), size);
    PatchSources sources;
    sources.height = sources.texture = readImage(file, "fuzzed", fuzz::kImageLimits);
    PatchOptions options;
    options.model = PatchModel::HeightField;
    options.heightmap = options.texture = "fuzzed";
    options.grid = 16;
    Job job;
    const Patch patch = buildPatch(options, sources, job);
    for (const Vec3& p : patch.mesh.positions) require(isFinite(p) && p.z >= 0 && p.z <= 0.13f);
    for (const Vec3& n : patch.mesh.normals) require(std::abs(length(n) - 1) < 1e-3f);
    require(isFinite(patch.albedoAt(0, Vec2(0.3f))));
  } catch (const Error& error) {
    require(std::strchr(error.what(), '\n') == nullptr);
  }
  return 0;
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "heightmap",
    .seeds =
        [] {
          const test::TemporaryFolder folder;
          std::vector<std::string> seeds;
          for (const int channels : {1, 3})
            for (const std::string name : {"map.exr", "map.hdr", "map.png"}) {
              if (channels == 1 && name == "map.hdr") continue;
              Image image(6, 5, channels);
              for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i % 11) / 11;
              writeImage(folder / name, image);
              const std::vector<std::byte> bytes = readFile(folder / name);
              seeds.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            }
          return seeds;
        },
    .words = {"-Y 5 +X 6\n", "IHDR", "IDAT", "IEND", "channels", "chlist", "dataWindow", "box2i",
              std::string("\0\0\x80\x7f", 4), std::string("\0\0\xc0\x7f", 4)},
    .runs = 3000,
    .memoryBase = std::size_t{256} << 20,
    .memoryPerByte = 16 * 1024};
