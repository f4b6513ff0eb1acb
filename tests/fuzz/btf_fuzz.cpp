// Manifests of BTFs.

#include "libprt/core/error.h"
#include "libprt/meso/btf_import.h"
#include "tests/fuzz/target.h"

#include <cstring>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace prt;
  using fuzz::require;
  try {
    const BtfSet set = parseBtfManifest({reinterpret_cast<const char*>(data), size}, "fuzzed");
    for (const BtfEntry& entry : set.images) {
      require(!entry.file.empty() && std::filesystem::path(entry.file).is_relative());
      require(std::abs(length(entry.light) - 1) < 1e-4f && entry.light.z > 0);
      require(std::abs(length(entry.view) - 1) < 1e-4f && entry.view.z > 0);
    }
    require(set.scale > 0);
  } catch (const Error& error) {
    require(std::strchr(error.what(), '\n') == nullptr);
  }
  return 0;
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "btf",
    .seeds =
        [] {
          return std::vector<std::string>{
              R"({"format":"prt-btf","encoding":"linear","images":[{"file":"a.exr","light":[0,0,1],"view":[0.1,0,1]}]})",
              R"({"format":"prt-btf","encoding":2.2,"scale":0.3,"images":[{"file":"b/a.png","light":{"theta":15,"phi":300},"view":{"theta":0,"phi":0}}]})"};
        },
    .words = {"\"file\":", "\"light\":", "\"view\":", "\"theta\":", "\"phi\":", "1e308", "-1", "null", "[]",
              "{}", "../", "\\u0000", "\"srgb\""},
    .runs = 40000};
