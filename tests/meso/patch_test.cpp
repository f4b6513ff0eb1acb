#include "libprt/meso/patch.h"

#include "libprt/core/error.h"
#include "tests/meso/meso_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using namespace test;

TEST(Patch, BordersAreOne) {
  const Patch patch = heightField(bumps(16, 0.1f), Rgb(0.5f));
  ASSERT_EQ(patch.mesh.vertexCount(), 17u * 17u);
  for (int i = 0; i <= 16; ++i) {
    EXPECT_EQ(patch.twin[std::size_t(i * 17 + 16)], patch.twin[std::size_t(i * 17)]);
    EXPECT_EQ(patch.twin[std::size_t(16 * 17 + i)], patch.twin[std::size_t(i)]);
    EXPECT_EQ(patch.mesh.normals[std::size_t(i * 17 + 16)], patch.mesh.normals[std::size_t(i * 17)]);
  }
  std::set<std::uint32_t> points(patch.twin.begin(), patch.twin.end());
  EXPECT_EQ(points.size(), 256u);
}

TEST(Patch, SharpEdgesStayApart) {
  const Patch groove = vGroove(kPi / 2, 4, Rgb(0.5f));
  EXPECT_NEAR(groove.depth(), 0.5, 1e-6);
  std::set<std::uint32_t> points(groove.twin.begin(), groove.twin.end());
  EXPECT_EQ(points.size(), 2u * 5u * 2u);  // both walls, every strip's edges, two rows
}

TEST(Patch, SamplesHaveAllTheirFacesAround) {
  // Moving the seam over the surface must not change what a point of it looks like.
  const Patch patch = heightField(bumps(16, 0.2f), Rgb(0.5f));
  const PatchScene here = sceneOf(patch), moved = sceneOf(shifted(patch, Vec2(0.25f, 0.5f)));
  ASSERT_EQ(here.samples->size(), moved.samples->size());
  for (std::size_t v = 0; v < patch.mesh.vertexCount(); ++v) {
    const std::uint32_t s = here.sampleOf[v];
    const Vec3 wanted = here.samples->origin[s] + Vec3(0.25f, 0.5f, 0);
    float nearest = 1;
    std::size_t found = 0;
    for (std::size_t t = 0; t < moved.samples->size(); ++t) {
      Vec3 d = moved.samples->origin[t] - wanted;
      d -= Vec3(std::round(d.x), std::round(d.y), 0);
      if (length(d) < nearest) nearest = length(d), found = t;
    }
    EXPECT_LT(nearest, 2e-6);
    EXPECT_GT(dot(moved.samples->geometricNormal[found], here.samples->geometricNormal[s]), 0.99999);
  }
}

TEST(Patch, TurnsAndShiftsComeBack) {
  Patch patch = heightField(bumps(12, 0.2f), Rgb(0.5f));
  auto image = std::make_shared<Image>(4, 8, 3);
  for (std::size_t i = 0; i < image->data.size(); ++i) image->data[i] = float(i % 7) / 7;
  patch.albedoTexture = image;
  Patch turned = patch;
  for (int i = 0; i < 4; ++i) turned = quarterTurned(turned);
  for (std::size_t v = 0; v < patch.mesh.vertexCount(); ++v)
    EXPECT_NEAR(length(turned.mesh.positions[v] - patch.mesh.positions[v]), 0, 1e-6);
  EXPECT_EQ(turned.albedoTexture->data, image->data);
  const Patch once = quarterTurned(patch);
  for (const Vec2 uv : {Vec2(0.1f, 0.7f), Vec2(0.55f, 0.2f)})
    EXPECT_NEAR(length(lookUp(once.albedoTexture, Vec2(1 - uv.y, uv.x)) - lookUp(patch.albedoTexture, uv)), 0,
                1e-5);
  const Patch moved = shifted(patch, Vec2(0.25f, 0.375f));
  for (const Vec2 uv : {Vec2(0.1f, 0.7f), Vec2(0.55f, 0.2f)})
    EXPECT_NEAR(
        length(lookUp(moved.albedoTexture, uv + Vec2(0.25f, 0.375f)) - lookUp(patch.albedoTexture, uv)), 0,
        1e-5);
}

TEST(Patch, TexturesRepeat) {
  auto image = std::make_shared<Image>(2, 2, 1);
  image->data = {0, 1, 2, 3};  // the top row is v = 1
  EXPECT_FLOAT_EQ(lookUp(image, {0.25f, 0.75f}).x, 0);
  EXPECT_FLOAT_EQ(lookUp(image, {0.75f, 0.25f}).x, 3);
  EXPECT_FLOAT_EQ(lookUp(image, {0, 0.75f}).x, 0.5f);  // between the last column and the first
  EXPECT_FLOAT_EQ(lookUp(image, {-3, 5.75f}).x, 0.5f);
  EXPECT_EQ(lookUp(nullptr, {0, 0}), Rgb(1));
}

TEST(Patch, WarnsWhereItIsThick) {
  EXPECT_EQ(thinPatchWarning(flatPatch(Rgb(1)), 8), "");
  EXPECT_EQ(thinPatchWarning(heightField(bumps(16, 0.1f), Rgb(1)), 8), "");
  const std::string warning = thinPatchWarning(heightField(bumps(16, 0.8f), Rgb(1)), 8);
  EXPECT_NE(warning.find("too thick for 8 x 8 views"), std::string::npos) << warning;
  EXPECT_EQ(thinPatchWarning(heightField(bumps(16, 0.3f), Rgb(1)), 32), "");
}

TEST(Patch, RefusesWhatIsNoPatch) {
  EXPECT_THROW(makePatch(TriMesh{}, {Rgb(1)}), GeometryError);
  TriMesh wide = flatPatch(Rgb(1)).mesh;
  for (Vec3& p : wide.positions) p.x *= 2;
  EXPECT_THROW(makePatch(wide, {Rgb(1)}), GeometryError);
  TriMesh broken = flatPatch(Rgb(1)).mesh;
  broken.positions[0].z = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(makePatch(broken, {Rgb(1)}), GeometryError);
}

TEST(HeightField, ComesFromAnImage) {
  Image image(4, 4, 1);
  image.data = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0};  // bottom left is bright
  const HeightGrid grid = heightsFromImage(image, 0.3f);
  EXPECT_FLOAT_EQ(grid.at(0, 0), 0.3f);
  EXPECT_FLOAT_EQ(grid.at(1, 0), 0);
  EXPECT_FLOAT_EQ(grid.at(4, -4), 0.3f);  // repeats
  const HeightGrid half = heightsFromImage(image, 0.3f, 2);
  EXPECT_EQ(half.columns, 2);
  EXPECT_FLOAT_EQ(half.at(0, 0), 0.3f);
  image.data.assign(16, 0.5f);
  EXPECT_THROW(heightsFromImage(image, 0.3f), ValueError);
  image.data[3] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(heightsFromImage(image, 0.3f), ValueError);
  EXPECT_THROW(heightsFromImage(Image(), 0.3f), ValueError);
}

}  // namespace
}  // namespace prt
