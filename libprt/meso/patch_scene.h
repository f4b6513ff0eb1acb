#pragma once
// A patch made ready for rays: its surface repeated without end behind the one ray gateway, and a sample at
// every vertex, each point of the torus once.

#include "libprt/core/job.h"
#include "libprt/meso/patch.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/sample_set.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace prt {

struct PatchScene {
  std::shared_ptr<const Patch> patch;
  std::shared_ptr<const Scene> scene;        ///< the patch's mesh, one object
  std::shared_ptr<const RayScene> rays;      ///< periodic
  std::shared_ptr<const SampleSet> samples;  ///< [S] where light is gathered: one per point of the torus
  std::vector<std::uint32_t> sampleOf;       ///< [V] the sample of each vertex
};

/// Throws what RayScene throws, and Cancelled.
PatchScene makePatchScene(std::shared_ptr<const Patch> patch, Job& job);
/// The same without samples: enough for pictures, and sooner there.
PatchScene makePatchRays(std::shared_ptr<const Patch> patch, Job& job);

/// A ray of the picture of the patch in direction `view` (unit, z > 0) that crosses the middle plane at `uv`:
/// it starts above the surface and looks down along -view.
Ray viewRay(const Patch& patch, const Vec2& uv, const Vec3& view);

}  // namespace prt
