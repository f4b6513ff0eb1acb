#include "libprt/shade/background.h"

#include "libprt/core/parallel.h"
#include "libprt/shade/sound.h"

namespace prt {
namespace {

Rgb behind(const LightRig& rig, const CameraRays& rays, int x, int y, int grid) {
  Rgb sum(0);
  for (int sy = 0; sy < grid; ++sy)
    for (int sx = 0; sx < grid; ++sx)
      sum += radiance(rig, normalize(rays.background(float(x) + (float(sx) + 0.5f) / float(grid),
                                                     float(y) + (float(sy) + 0.5f) / float(grid))));
  return sum / float(grid * grid);
}

}  // namespace

void addBackground(const LightRig& rig, const Camera& camera, int grid, Image& image, Job& job) {
  const CameraRays rays(camera, image.width, image.height);
  parallelFor(job, 0, std::size_t(image.height), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      job.checkCancelled();
      for (int x = 0; x < image.width; ++x) {
        float* to = image.pixel(x, int(y));
        if (!(to[3] < 1)) continue;
        const Rgb light = (1 - to[3]) * sound(behind(rig, rays, x, int(y), grid));
        for (int c = 0; c < 3; ++c) to[c] += light[c];
        to[3] = 1;
      }
    }
  });
}

}  // namespace prt
