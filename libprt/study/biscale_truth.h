#pragma once
// How true bi-scale pictures are: the same view of the displaced surface, path traced, against the picture
// with both scales, with each alone, and with neither. Internal to study.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/recipe.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/metrics.h"
#include "libprt/study/displaced_surface.h"
#include "libprt/transport/path_tracer.h"

#include <memory>
#include <string>
#include <vector>

namespace prt {

/// What is compared. Everything bi-scale is baked for `recipe`: a height field on a mesh.
struct TruthCase {
  Recipe recipe;
  ShRgb light;  ///< in the world, nowhere negative: what transfer and path tracer both see
  Camera camera;
  int width = 512, height = 512;
  int grid = 2;     ///< samples a side per pixel of the bi-scale pictures
  int paths = 256;  ///< per pixel of each of the two references
  int cuts = 8;     ///< of the mesh's edges, in the displaced surface
};

/// Which of the two scales takes part; without the meso scale the surface is matte and of the patch's colour.
struct TruthPicture {
  std::string name;
  bool macro = false, meso = false;
  Image picture{};
  NoiseFreeError error{};  ///< over the pixels that both surfaces cover
};

class BiscaleTruth {
 public:
  /// Bakes, displaces, traces. Throws ValueError for patches that are no height field, Cancelled.
  BiscaleTruth(const TruthCase& of, Job& job);

  const std::vector<TruthPicture>& pictures() const { return pictures_; }  ///< both, macro, meso, neither
  const TruthPicture& both() const { return pictures_.front(); }
  Image reference() const;  ///< mean of the two
  const Products& products() const { return products_; }
  std::size_t triangles() const { return displaced_->mesh.triangleCount(); }

  /// Mean square of the noise of one path per pixel, and seconds that a pixel's path takes, one after the
  /// other on all threads: what a path-traced picture of some error costs.
  double noiseOfOnePath() const { return noise_; }
  double secondsPerPath() const { return secondsPerPath_; }

 private:
  void displace(Job& job);
  void trace(Job& job);
  void draw(Job& job);

  TruthCase case_;
  Products products_;
  std::shared_ptr<const BiscaleSurface> surface_;
  std::shared_ptr<const Scene> displaced_;
  Image references_[2];
  double noise_ = 0, secondsPerPath_ = 0;
  std::vector<TruthPicture> pictures_;
};

}  // namespace prt
