// Bakes a rock once, then shows it under two lights: the whole of libprt in one page.
//   relight_example OUT.png

#include "libprt/core/image_io.h"
#include "libprt/core/job.h"
#include "libprt/light/light_rig.h"
#include "libprt/mesh/generate.h"
#include "libprt/shade/render.h"
#include "libprt/shade/tonemap.h"
#include "libprt/transport/transfer_bake.h"

#include <cstdio>
#include <memory>

using namespace prt;

namespace {

/// One large light from `direction`, with a little light from everywhere.
LightRig lightFrom(const Vec3& direction) {
  LightRig rig;
  rig.circles = {{normalize(direction), float(radians(25)), Rgb(6.0f, 5.6f, 5.0f)}};
  rig.constant = Rgb(0.25f, 0.3f, 0.4f);
  return rig;
}

void relight(const char* file) {
  Job job(
      [](const Progress& p) { std::fprintf(stderr, "\r%s %3.0f %%", p.phase.c_str(), 100 * p.fraction()); });

  // A scene: meshes with transforms and materials, flattened into one.
  Material clay;
  clay.albedo = {0.7f, 0.5f, 0.4f};
  const SceneObject rock{"rock", std::make_shared<TriMesh>(makeRock()), Mat4(1.0f), clay};
  const auto scene = std::make_shared<Scene>(flattenScene({&rock, 1}));

  // The bake: how light from any direction reaches every vertex, with shadows and three bounces.
  const auto rays = std::make_shared<RayScene>(*scene, job);
  const auto samples = std::make_shared<SampleSet>(samplesAtVertices(*scene));
  TransferSettings settings;
  settings.rays = 256;
  const Transfer transfer = bakeTransfer(scene, rays, samples, settings, job);

  // Relighting: project the light to 25 numbers a channel, then one dot product per vertex.
  const Camera camera = frameBox(scene->mesh.bounds());
  const int size = 360;
  Image sheet(2 * size, size, 4);
  const Vec3 directions[] = {{1, 1, 0.5f}, {-1, 0.4f, 0.6f}};
  for (int i = 0; i < 2; ++i) {
    const ShRgb light = projectLights(lightFrom(directions[i]), settings.bands);
    const Image picture = render({*scene, *samples, transfer, light}, camera, size, size, 4, job);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) std::copy_n(picture.pixel(x, y), 4, sheet.pixel(i * size + x, y));
  }
  writeImage(file, sheet);
  std::fprintf(stderr, "\rbaked %zu vertices, wrote %s\n", samples->size(), file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: relight_example OUT.png\n");
    return 2;
  }
  try {
    relight(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
