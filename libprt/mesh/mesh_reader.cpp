#include "libprt/mesh/mesh_reader.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/mesh/text_scanner.h"

namespace prt {
namespace {

constexpr std::size_t kLargestFile = (std::size_t{1} << 32) - 1;  // counts in it fit 32 bits

using Parser = PolygonSoup (*)(std::string_view, const MeshSource&, Job&);

struct Format {
  const char* extension;
  const char* name;
  Parser parse;
};

constexpr Format kFormats[] = {{".obj", "OBJ", parseObj},    {".ply", "PLY", parsePly},
                               {".off", "OFF", parseOff},    {".stl", "STL", parseStl},
                               {".gltf", "glTF", parseGltf}, {".glb", "glTF", parseGltf}};

/// The format that a file's first bytes can belong to alone; empty when they do not tell.
std::string formatByMagic(std::string_view bytes) {
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return "PLY";
  if (bytes.starts_with("glTF")) return "glTF";
  const std::string start(bytes.substr(0, 256));
  const std::string_view first = TextScanner(start, {}, '#').word();
  if (first == "OFF" || first == "COFF" || first == "NOFF" || first == "STOFF" || first == "CNOFF")
    return "OFF";
  if (first.starts_with("{") && start.find('"') != std::string::npos) return "glTF";
  return {};
}

}  // namespace

std::vector<std::string> meshExtensions() {
  std::vector<std::string> extensions;
  for (const Format& format : kFormats) extensions.emplace_back(format.extension);
  return extensions;
}

PolygonSoup readMesh(const std::filesystem::path& path, Job& job) {
  const std::string extension = lowerCase(path.extension().string());
  const Format* format = nullptr;
  std::string known;
  for (const Format& candidate : kFormats) {
    if (extension == candidate.extension) format = &candidate;
    known.append(known.empty() ? "" : " ").append(candidate.extension);
  }
  if (!format)
    throw FileError(inQuotes(extension) + " is not the extension of a mesh format", path.string(),
                    "known are " + known);

  job.begin("read", 0, "bytes");
  const std::vector<std::byte> contents = readFile(path, kLargestFile, &job);
  const std::string_view bytes(reinterpret_cast<const char*>(contents.data()), contents.size());
  if (bytes.empty()) throw FileError("is empty", path.string(), "export the file again");
  const std::string magic = formatByMagic(bytes);
  if (!magic.empty() && magic != format->name)
    throw FileError("is called " + extension + " but holds " + magic, path.string(), "rename it");
  job.begin("parse", double(bytes.size()), "bytes");
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  return format->parse(bytes, {path.string(), folder}, job);
}

}  // namespace prt
