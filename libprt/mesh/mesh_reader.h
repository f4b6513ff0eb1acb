#pragma once
// Mesh files in: OBJ, PLY (ascii, both binary orders), OFF and its relatives, STL (ascii, binary), glTF and
// GLB. Readers check everything a file claims against the bytes it holds: a hostile or broken file ends in
// a FileError that says where, or in a soup whose defects repair() reports - never in a crash, a hang or an
// allocation beyond a fixed multiple of the file's size.

#include "libprt/core/job.h"
#include "libprt/mesh/soup.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace prt {

/// Reads a mesh file; the extension names the format, the first bytes must not belong to another one.
/// Throws FileError.
PolygonSoup readMesh(const std::filesystem::path& path, Job& job);

/// Extensions that readMesh knows, lower case with their dot.
std::vector<std::string> meshExtensions();

/// Where the bytes given to a parser came from.
struct MeshSource {
  std::string name;  ///< for messages
  std::filesystem::path
      folder;  ///< files that a model names are read from here or below; empty = from nowhere
};

// The parsers behind it, over bytes in memory. Each throws FileError.
PolygonSoup parseObj(std::string_view bytes, const MeshSource& source, Job& job);
PolygonSoup parsePly(std::string_view bytes, const MeshSource& source, Job& job);
PolygonSoup parseOff(std::string_view bytes, const MeshSource& source, Job& job);
PolygonSoup parseStl(std::string_view bytes, const MeshSource& source, Job& job);
PolygonSoup parseGltf(std::string_view bytes, const MeshSource& source, Job& job);  ///< JSON or GLB

}  // namespace prt
