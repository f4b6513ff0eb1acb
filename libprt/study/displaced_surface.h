#pragma once
// The surface that a bi-scale picture stands for: the heights of the patch on the macro mesh as triangles.
// Path traced, it is the truth that both scales together are measured against.

#include "libprt/meso/height_field.h"
#include "libprt/shade/biscale_view.h"

namespace prt {

struct DisplacedOptions {
  double patchWidth = 1;  ///< in the scene's unit
  int cuts = 8;           ///< parts that every edge of the mesh is cut into, 1..1024
};

/// Every triangle cut into cuts^2, every vertex moved along the shading normal there by the height of the
/// patch against the plane midway in depth, which is the one that radiance transfer textures refer to. Closed
/// where the mesh is: vertices on edges are shared. Over an id map, which jumps from texel to texel, heights
/// are smoothed by about one texel first; places that it leaves empty are not moved. Throws ValueError,
/// Cancelled.
TriMesh displacedSurface(const BiscaleSurface& surface, const HeightGrid& heights,
                         const DisplacedOptions& options, Job& job);

}  // namespace prt
