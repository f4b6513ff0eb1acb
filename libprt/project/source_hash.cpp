#include "libprt/project/source_hash.h"

#include "libprt/core/error.h"
#include "libprt/core/hash.h"
#include "libprt/meso/btf_import.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <vector>

namespace prt {
namespace {

namespace fs = std::filesystem;

struct Seen {
  std::uintmax_t bytes;
  fs::file_time_type changed;
  Hash128 hash;
};

Hash128 hashOnce(const fs::path& file) {
  static std::mutex mutex;
  static std::map<std::string, Seen> seen;
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  const auto changed = error ? fs::file_time_type{} : fs::last_write_time(file, error);
  if (error) throw FileError("cannot be read: " + error.message(), file.string(), "check the path");
  {
    std::lock_guard lock(mutex);
    const auto found = seen.find(file.string());
    if (found != seen.end() && found->second.bytes == bytes && found->second.changed == changed)
      return found->second.hash;
  }
  const Hash128 hash = hashFile(file);
  std::lock_guard lock(mutex);
  seen[file.string()] = {bytes, changed, hash};
  return hash;
}

std::string lowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Files beside a .gltf that hold its buffers. What cannot be understood is left to the mesh reader.
std::vector<fs::path> buffersOf(const fs::path& gltf) {
  std::ifstream stream(gltf, std::ios::binary);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  std::vector<fs::path> files;
  if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) return files;
  for (const auto& buffer : json["buffers"]) {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
    const std::string uri = buffer["uri"];
    const fs::path file = gltf.parent_path() / uri;
    std::error_code error;
    if (!uri.starts_with("data:") && fs::is_regular_file(file, error)) files.push_back(file);
  }
  return files;
}

/// Images of a BTF's manifest. What cannot be understood is left to the import.
std::vector<fs::path> imagesOf(const fs::path& manifest) {
  std::vector<fs::path> files;
  try {
    for (const BtfEntry& entry : openBtf(manifest).images) {
      const fs::path file = manifest.parent_path() / entry.file;
      std::error_code error;
      if (fs::is_regular_file(file, error)) files.push_back(file);
    }
  } catch (const FileError&) {
    files.clear();
  }
  return files;
}

}  // namespace

std::vector<fs::path> filesBeside(const fs::path& file) {
  const std::string extension = lowerExtension(file);
  if (extension == ".gltf") return buffersOf(file);
  return extension == ".json" ? imagesOf(file) : std::vector<fs::path>{};
}

std::string hashSource(const fs::path& file) {
  const std::string extension = lowerExtension(file);
  Hasher hasher;
  hasher.add(extension).add(hashOnce(file));
  for (const fs::path& part : filesBeside(file)) hasher.add(hashOnce(part));
  return hasher.result().hex();
}

}  // namespace prt
