#pragma once
// The outer shell of glTF files: the GLB container, the JSON cut down to what a mesh needs, and the bytes of
// the buffers. What tinygltf is given afterwards names no file and holds nothing nested deeply.

#include "libprt/core/job.h"
#include "libprt/mesh/mesh_reader.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace prt {

struct GltfContainer {
  std::string json;                       ///< without buffers, images, animations, extras, extensions
  std::vector<std::string_view> buffers;  ///< into the file's bytes or into `loaded`
  std::vector<std::unique_ptr<std::string>> loaded;
};

/// Throws FileError when the container or the JSON is broken, a buffer is missing or shorter than it
/// says, or the file needs an extension without which its geometry cannot be read.
GltfContainer openGltf(std::string_view bytes, const MeshSource& source, Job& job);

/// Bytes of a base64 text; empty when it is none.
std::string decodeBase64(std::string_view text);
std::string encodeBase64(std::string_view bytes);

}  // namespace prt
