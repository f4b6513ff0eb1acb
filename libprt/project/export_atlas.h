#pragma once
// The arrays of an atlas among those of an export. Internal to project/.

#include "libprt/core/array.h"
#include "libprt/core/image.h"
#include "libprt/project/atlas_stages.h"

#include <functional>
#include <string>

namespace prt {

/// Calls write(name, array, what it is) for uv, uv_faces, uv_chart and geometry_*.
void writeAtlasArrays(const TriMesh& mesh, const Atlas& atlas, Job& job,
                      const std::function<void(const std::string&, const Array&, const std::string&)>& write);

/// The atlas as a picture: charts in calm hues of their own, their rims bright, v up.
Image atlasPicture(const Atlas& atlas, int size, Job& job);

/// The mesh with the atlas as its texture coordinates.
TriMesh withAtlas(TriMesh mesh, const Atlas& atlas);

}  // namespace prt
