#pragma once
// glTF 2.0 out, behind mesh_writer.h.

#include "libprt/mesh/mesh_writer.h"

namespace prt {

/// One mesh of one primitive in one node, as GLB or as JSON with its buffer inside.
std::string gltfBytes(const TriMesh& mesh, const MeshWriteOptions& options, bool binary, Job& job);

}  // namespace prt
