#pragma once
// Objects that stand around a baked model: not baked themselves, they are lit by the distant light alone,
// without shadows, shine with light of their own, and are seen in front of the model and behind it. What the
// model's middle sees of them becomes part of its light (light/captured.h): they light it, and block the
// distant light behind them, as if they were far away.

#include "libprt/basis/sh.h"
#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/light/captured.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/raster.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"

#include <array>
#include <memory>
#include <vector>

namespace prt {

struct Surroundings {
  std::shared_ptr<const Scene> scene;  ///< in the frame of the model's scene; null: nothing stands around it
  std::shared_ptr<const SampleSet> samples = {};  ///< see bareSamples()
  std::vector<Rgb> emission = {};                 ///< [objects] radiance that their reflecting sides send
  ShRgb light = {};                               ///< that falls on them, at most 10 bands

  bool empty() const { return !scene; }
};

/// Vertices without light of their own: all that surfaces under the form None need.
std::shared_ptr<const SampleSet> bareSamples(const Scene& scene);

/// Surroundings as what hides parts of the model; none for null and empty ones.
Occluder occluderOf(const Surroundings* surroundings);

/// Their light: what `view` sees of the surroundings' mesh. As shade() in render.h.
Image shadeSurroundings(const Surroundings& surroundings, const FragmentImage& view, const Camera& camera,
                        Job& job);

/// Adds what is seen of them, beside and in front of `model`, to a picture of it that they were the occluder
/// of. Nothing for null and empty ones.
void addSurroundings(const Surroundings* surroundings, const TriMesh& model, const Camera& camera, int grid,
                     Image& image, Job& job);

/// What is seen from a place, all around. Reusable while objects and place stay, whatever the light does.
class CubeView {
 public:
  static constexpr int kSide = 32;  ///< texels
  static constexpr int kGrid = 4;   ///< samples a side of a texel

  CubeView(const TriMesh& mesh, const Vec3& place, Job& job);
  /// `surroundings` of that mesh.
  CapturedCube capture(const Surroundings& surroundings, Job& job) const;

 private:
  std::shared_ptr<const CubeGrid> grid_;
  std::array<Camera, 6> cameras_;
  std::array<FragmentImage, 6> faces_;  // without tiles where nothing is seen
};

}  // namespace prt
