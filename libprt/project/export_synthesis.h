#pragma once
// The arrays and pictures of a synthesis among those of an export. Internal to project/.

#include "libprt/core/array.h"
#include "libprt/core/image.h"
#include "libprt/project/synthesis_stages.h"

#include <functional>
#include <string>

namespace prt {

using WriteArray = std::function<void(const std::string&, const Array&, const std::string&)>;

/// Calls write(name, array, what it is) for meso_positions, meso_normals and meso_patch.
void writeMesoArrays(const SynthesisProduct& synthesis, const WriteArray& write);
/// And for idmap.
void writeIdMapArray(const IdMap& map, const WriteArray& write);

/// The id map as a picture: u in red, v in green, black where there is none (figure 2c of the bi-scale
/// paper). Display-encoded: the numbers themselves. `side` pixels, each one texel of the map; 0: as many as
/// it has.
Image idMapPicture(const IdMap& map, int side = 0);

}  // namespace prt
