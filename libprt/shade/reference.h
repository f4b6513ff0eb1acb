#pragma once
// Path-traced pictures: the ground truth for the renderers in render.h, with the same camera, pixel
// filter (a box, one pixel wide) and output.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/shade/camera.h"
#include "libprt/transport/path_tracer.h"

#include <vector>

namespace prt {

/// A picture that gains samples for as long as somebody adds them. Sample k of pixel p depends on
/// (seed, p, k) alone: 64 samples at once or in any portions give the same bits.
class ReferenceImage {
 public:
  /// Keeps a reference to `tracer`. Throws ValueError when the size is not 1..65536 a side.
  ReferenceImage(const PathTracer& tracer, const Camera& camera, int width, int height,
                 const PathOptions& options);

  /// Adds samples to every pixel. Cancelled: whole passes (of up to 16 samples) made so far are kept.
  void add(int samplesPerPixel, Job& job);
  int samples() const { return samples_; }

  /// Mean radiance, RGBA: premultiplied by alpha = coverage, black outside. With `background` the light
  /// behind the scene is seen where it is not covered, alpha is 1.
  Image radiance(bool background = false) const;
  /// Standard error of radiance(), RGB, as if samples were independent: an upper estimate, because
  /// they are well spread. Zero before the second sample.
  Image standardError(bool background = false) const;

 private:
  struct Sum {
    DVec3 surface{0}, sky{0};  // light from the scene, and from behind it
    DVec3 surfaceSquares{0}, allSquares{0};
    double covered = 0;
  };
  void addPass(int count, Job& job);
  void tracePixel(int x, int y, int count, Sum& sum) const;

  const PathTracer& tracer_;
  Camera camera_;
  CameraRays rays_;
  float behind_ = 0;  // distance from the camera's plane back to where rays begin
  PathOptions options_;
  int width_, height_, samples_ = 0;
  std::vector<Sum> sums_;
};

}  // namespace prt
