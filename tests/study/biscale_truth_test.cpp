#include "libprt/study/biscale_truth.h"

#include "libprt/basis/view_square.h"
#include "libprt/core/error.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/projection.h"
#include "libprt/mesh/edges.h"
#include "libprt/mesh/generate.h"
#include "libprt/meso/patch_generate.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

/// Stucco on the unit square, eight patches a side, laid by its own coordinates.
TruthCase stuccoSquare() {
  TruthCase c;
  Recipe& recipe = c.recipe;
  recipe.objects[0].mesh.path = "builtin:plane";
  recipe.objects[0].material.albedo = Rgb(0.5f);
  recipe.patch.model = PatchModel::HeightField;
  recipe.patch.depth = 0.1f;
  recipe.synthesis.mapping = PatchMapping::Uv;
  recipe.synthesis.repeat = 8;
  recipe.rtt.texels = 32;
  recipe.rtt.rays = 512;
  recipe.transfer.rays = 64;
  recipe.transfer.bounces = 2;
  recipe.method.name = "biscale";
  c.light = nonNegativeLight(projectEnvironment(clearSky(), 5));
  c.width = c.height = 24;
  c.grid = 16;
  c.paths = 128;
  c.cuts = 64;  // as fine as the patch itself
  return c;
}

/// Parallel rays along a direction of the patch's frame; two patches of the square's middle are seen.
Camera along(const Vec3& view) {
  constexpr float kDistance = 5, kHeight = 0.25f;
  Camera camera;
  camera.orthographic = true;
  camera.target = Vec3(0);
  // The plane's tangent is +X, its bitangent -Z, its normal +Y.
  camera.eye = kDistance * Vec3(view.x, view.z, -view.y);
  camera.up = Vec3(0, 0, -1);
  camera.verticalFov = 2 * std::atan(0.5f * kHeight / kDistance);
  return camera;
}

TEST(BiscaleTruthTest, AFlatSquareIsAsItsDisplacedMeshWhereTheTextureHasAView) {
  TruthCase c = stuccoSquare();
  const ViewSquare views(8);
  Job job;
  for (const int view : {27, 13}) {
    c.camera = along(views.centre(view));
    const BiscaleTruth truth(c, job);
    EXPECT_LT(truth.both().error.relativeHigh(), 0.03) << view;
    // What is measured tells the scales apart: without the patch's own structure the error is much larger.
    EXPECT_GT(truth.pictures()[1].error.relative(), 2 * truth.both().error.relative()) << view;
  }
}

TEST(BiscaleTruthTest, OtherPatchesAreRefused) {
  TruthCase c = stuccoSquare();
  c.recipe.patch.model = PatchModel::Flat;
  Job job;
  EXPECT_THROW(BiscaleTruth(c, job), ValueError);
}

/// A surface laid by its own coordinates; what answers there does not matter.
BiscaleSurface laidByCoordinates(TriMesh mesh) {
  auto scene = std::make_shared<Scene>(test::sceneOf(std::move(mesh)));
  Job job;
  auto frames = std::make_shared<TangentFrames>(makeTangentFrames(scene->mesh, {}, job));
  auto cover =
      std::make_shared<PatchCover>(std::shared_ptr<const TriMesh>(scene, &scene->mesh), PatchRepeat{3, 2});
  return {scene, frames, cover, std::make_shared<ResponseTable>(Rtt(1, 1, 1, 1))};
}

TEST(DisplacedSurfaceTest, VerticesMoveAlongTheNormalByTheHeightAgainstTheMiddle) {
  Job job;
  const BiscaleSurface surface = laidByCoordinates(makePlane({.columns = 2, .rows = 2}));
  const HeightGrid heights =
      sampleHeights(64, [](const Vec2& uv) { return 0.1f + 0.05f * std::sin(2 * kPiF * uv.x); });
  const TriMesh made = displacedSurface(surface, heights, {.patchWidth = 0.5, .cuts = 24}, job);
  EXPECT_EQ(made.triangleCount(), 8u * 24 * 24);
  for (const Vec3& p : made.positions)
    EXPECT_NEAR(p.y, 0.5f * 0.05f * std::sin(2 * kPiF * 3 * (p.x + 0.5f)), 2e-4f);
  for (std::size_t f = 0; f < made.triangleCount(); ++f) EXPECT_GT(made.areaNormal(f).y, 0);
}

TEST(DisplacedSurfaceTest, AClosedMeshStaysClosed) {
  Job job;
  const BiscaleSurface surface = laidByCoordinates(makeTorus());
  const HeightGrid heights = generateHeights({.depth = 0.1f});
  const TriMesh made = displacedSurface(surface, heights, {.patchWidth = 0.1, .cuts = 3}, job);
  EXPECT_EQ(made.triangleCount(), 9 * surface.scene->mesh.triangleCount());
  const MeshEdges before(surface.scene->mesh.triangles, job), edges(made.triangles, job);
  const auto open = [](const MeshEdges& all) {
    std::size_t count = 0;
    for (std::size_t e = 0; e < all.size(); ++e) count += all[e].faceCount() != 2;
    return count;
  };
  EXPECT_EQ(open(edges), 3 * open(before));
}

}  // namespace
}  // namespace prt
