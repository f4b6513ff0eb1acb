#include "libprt/mesh/gltf_container.h"

#include "libprt/core/error.h"
#include "libprt/mesh/side_file.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstring>
#include <set>

namespace prt {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 32;
constexpr std::size_t kLargestBuffer = (std::size_t{1} << 32) - 1;

[[noreturn]] void fail(const MeshSource& source, const std::string& problem) {
  throw FileError(problem, source.name, "export the file again");
}

struct Chunks {
  std::string_view json, binary;
};

/// GLB: magic, version, length, then chunks of (length, type, bytes).
Chunks splitGlb(std::string_view bytes, const MeshSource& source) {
  const auto word = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  if (bytes.size() < 20) fail(source, "is too short for a GLB file");
  if (word(4) != 2) fail(source, "is GLB version " + std::to_string(word(4)) + ", only 2 is read");
  if (word(8) > bytes.size())
    fail(source, "is cut off: its header promises " + std::to_string(word(8)) + " bytes");
  Chunks chunks;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t length = word(at);
    const std::uint32_t type = word(at + 4);
    if (length > bytes.size() - at - 8) fail(source, "holds a chunk that is longer than the file");
    const std::string_view chunk = bytes.substr(at + 8, length);
    if (type == 0x4e4f534au && chunks.json.empty()) chunks.json = chunk;
    if (type == 0x004e4942u && chunks.binary.empty()) chunks.binary = chunk;
    at += 8 + length;
  }
  if (chunks.json.empty()) fail(source, "holds no JSON chunk");
  return chunks;
}

/// Parses JSON, leaving out what no mesh needs; refuses deep nesting, on which recursive code would run
/// out of stack.
Json prunedJson(std::string_view text, const MeshSource& source) {
  static const std::set<std::string, std::less<>> wanted{
      "accessors", "asset", "buffers", "bufferViews", "materials",
      "meshes",    "nodes", "scene",   "scenes",      "extensionsRequired"};
  static const std::set<std::string, std::less<>> unwanted{"extras", "extensions", "min", "max", "targets"};
  const auto keep = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kDeepest) fail(source, "its JSON is nested too deeply");
    if (event != Json::parse_event_t::key) return true;
    const auto& key = parsed.get_ref<const std::string&>();
    return depth == 1 ? wanted.contains(key) : !unwanted.contains(key);
  };
  try {
    return Json::parse(text.begin(), text.end(), keep);
  } catch (const Json::exception& error) {
    fail(source, "its JSON is broken: " + std::string(error.what()).substr(0, 200));
  }
}

void checkExtensions(const Json& root, const MeshSource& source) {
  static const std::set<std::string> harmless{"KHR_mesh_quantization",
                                              "KHR_texture_transform",
                                              "KHR_materials_unlit",
                                              "KHR_lights_punctual",
                                              "KHR_materials_pbrSpecularGlossiness",
                                              "KHR_texture_basisu",
                                              "EXT_texture_webp"};
  const auto required = root.find("extensionsRequired");
  if (required == root.end() || !required->is_array()) return;
  for (const Json& name : *required) {
    const std::string text = name.is_string() ? name.get<std::string>() : "?";
    if (harmless.contains(text) || text.starts_with("KHR_materials_")) continue;
    throw FileError("needs the extension " + text.substr(0, 80) + ", which is not read", source.name,
                    "export without compression");
  }
}

std::string percentDecoded(const std::string& text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape =
        text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
    out += escape ? char(digit(text[i + 1]) * 16 + digit(text[i + 2])) : text[i];
    if (escape) i += 2;
  }
  return out;
}

/// The bytes of one buffer: a data URI, a file in the model's folder, or the GLB's binary chunk.
std::string_view bufferBytes(const Json& buffer, std::size_t index, const Chunks& chunks,
                             const MeshSource& source, GltfContainer& container) {
  const std::string name = "buffer " + std::to_string(index);
  const auto length = buffer.is_object() ? buffer.find("byteLength") : buffer.end();
  if (!buffer.is_object() || length == buffer.end() || !length->is_number_unsigned())
    fail(source, name + " has no length");
  const auto uri = buffer.find("uri");
  std::string_view bytes;
  if (uri == buffer.end()) {
    bytes = chunks.binary;
  } else {
    if (!uri->is_string()) fail(source, name + " has no proper URI");
    const auto& text = uri->get_ref<const std::string&>();
    std::string loaded;
    if (text.starts_with("data:")) {
      const std::size_t comma = text.find(',');
      if (comma == std::string::npos || comma < 7 || text.compare(comma - 7, 7, ";base64") != 0)
        fail(source, name + " is a data URI that is not base64");
      loaded = decodeBase64(std::string_view(text).substr(comma + 1));
    } else {
      auto file = readSideFile(source.folder, percentDecoded(text), kLargestBuffer);
      if (!file)
        throw FileError("its buffer '" + text.substr(0, 200) + "' is not in the model's folder", source.name,
                        "put the file beside the model, or export as .glb");
      loaded = std::move(*file);
    }
    container.loaded.push_back(std::make_unique<std::string>(std::move(loaded)));
    bytes = *container.loaded.back();
  }
  const auto promised = length->get<std::uint64_t>();
  if (promised > bytes.size())
    fail(source,
         name + " holds " + std::to_string(bytes.size()) + " of " + std::to_string(promised) + " bytes");
  return bytes.substr(0, promised);
}

constexpr char kBase64[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string decodeBase64(std::string_view text) {
  static const std::array<signed char, 256> values = [] {
    std::array<signed char, 256> table;
    table.fill(-1);
    for (int i = 0; i < 64; ++i) table[std::uint8_t(kBase64[i])] = static_cast<signed char>(i);
    return table;
  }();
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (char c : text) {
    if (c == '=') break;
    const int value = values[std::uint8_t(c)];
    if (value < 0) return {};
    bits = bits << 6 | std::uint32_t(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += char(bits >> count & 0xff);
    }
  }
  return bytes;
}

std::string encodeBase64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? std::uint8_t(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kBase64[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

GltfContainer openGltf(std::string_view bytes, const MeshSource& source, Job& job) {
  job.checkCancelled();
  const Chunks chunks = bytes.starts_with("glTF") ? splitGlb(bytes, source) : Chunks{bytes, {}};
  Json root = prunedJson(chunks.json, source);
  if (!root.is_object()) fail(source, "its JSON is not an object");
  checkExtensions(root, source);

  GltfContainer container;
  const auto buffers = root.find("buffers");
  if (buffers != root.end() && buffers->is_array())
    for (std::size_t i = 0; i < buffers->size(); ++i) {
      job.checkCancelled();
      container.buffers.push_back(bufferBytes((*buffers)[i], i, chunks, source, container));
    }
  root.erase("buffers");
  container.json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  return container;
}

}  // namespace prt
