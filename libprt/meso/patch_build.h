#pragma once
// A patch from its parameters: what the recipe's section `patch` asks for. Everything that lies in files
// comes in from outside, so that previews need no disk.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/meso/patch.h"
#include "libprt/meso/patch_options.h"

#include <optional>
#include <string>

namespace prt {

/// What the options name, read; what they do not name stays empty.
struct PatchSources {
  std::optional<Image> height, texture, gloss;
  std::optional<TriMesh> mesh;
};

/// The generators' pictures and heights are made here; files come from `sources`. Throws ValueError, naming
/// the path of the recipe, when an option is out of range, GeometryError when the surface cannot be used.
/// None and Btf have no surface: std::logic_error.
Patch buildPatch(const PatchOptions& options, const PatchSources& sources, Job& job);

/// A patch from a mesh of one period: x and -z of the mesh become u and v, y becomes the height, divided by
/// the period (0 = the larger of its extents along x and z) and moved so that the least corner is at (0, 0).
/// Keeps the mesh's normals. Where one can look through it from above it gets a backing plane.
Patch patchFromMesh(const TriMesh& mesh, float period, const Rgb& albedo, Job& job);

}  // namespace prt
