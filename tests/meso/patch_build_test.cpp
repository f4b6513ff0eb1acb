#include "libprt/meso/patch_build.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "tests/meso/meso_support.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

using namespace test;

Patch build(PatchModel model, const std::function<void(PatchOptions&)>& change = {},
            const PatchSources& sources = {}) {
  PatchOptions options;
  options.model = model;
  if (change) change(options);
  Job job;
  return buildPatch(options, sources, job);
}

TEST(PatchBuild, EveryModelHasItsDefaults) {
  EXPECT_EQ(build(PatchModel::Flat).depth(), 0);
  EXPECT_NEAR(build(PatchModel::HeightField).depth(), 0.12f, 1e-6);
  EXPECT_NEAR(build(PatchModel::Weave).depth(), 0.12f, 1e-5);
  for (const PatchModel model : {PatchModel::Flat, PatchModel::HeightField, PatchModel::Weave})
    EXPECT_EQ(thinPatchWarning(build(model), 8), "");
  EXPECT_THROW(build(PatchModel::Mesh), ValueError);  // names patch.mesh
}

TEST(PatchBuild, TexturesAndGlossLieOnIt) {
  const Patch patch = build(PatchModel::Flat, [](PatchOptions& o) {
    o.texture = "builtin:flower", o.albedo = Rgb(1), o.specular = Rgb(0.3f), o.exponent = 20;
  });
  ASSERT_TRUE(patch.albedoTexture);
  EXPECT_TRUE(patch.glossy());
  const Rtt rtt = baked(patch, small(16, 1));
  EXPECT_EQ(rtt.channels, 3);
  const Image flower = *patch.albedoTexture;
  // The heart of the flower is yellow, as its texture.
  const float* heart = rtt.block(8, 8, 0);
  EXPECT_GT(heart[0], 2 * heart[2]);
  EXPECT_THROW(build(PatchModel::Flat, [](PatchOptions& o) { o.texture = "builtin:rose"; }), ValueError);
  EXPECT_THROW(build(PatchModel::Flat, [](PatchOptions& o) { o.gloss = "a.png"; }), ValueError);  // not read
  PatchSources bad;
  bad.texture = Image(2, 2, 3);
  bad.texture->data[0] = -1;
  EXPECT_THROW(build(
                   PatchModel::Flat, [](PatchOptions& o) { o.texture = "a.png"; }, bad),
               ValueError);
}

TEST(PatchBuild, MeshesRepeatAndGapsAreBacked) {
  PatchSources sources;
  PlaneOptions plane;
  plane.width = plane.depth = 3;
  sources.mesh = makePlane(plane);
  const Patch flat = build(PatchModel::Mesh, {}, sources);
  EXPECT_FALSE(flat.backed);
  EXPECT_NEAR(flat.mesh.bounds().low.x, 0, 1e-6);
  EXPECT_NEAR(flat.mesh.bounds().high.y, 1, 1e-6);
  const Rtt rtt = baked(flat, small(4, 2));
  for (int view = 0; view < 4; ++view) EXPECT_NEAR(mean(underWhiteSky(rtt, view)), 0.5, 1e-5);
  sources.mesh = makeSphere({});
  const Patch balls = build(
      PatchModel::Mesh, [](PatchOptions& o) { o.period = 2.5f; }, sources);
  EXPECT_TRUE(balls.backed);
  EXPECT_NEAR(balls.depth(), 2 / 2.5, 1e-3);
  EXPECT_GT(thinPatchWarning(balls, 8).size(), 10u);
  // Too small a period: it sticks out too far.
  EXPECT_THROW(build(
                   PatchModel::Mesh, [](PatchOptions& o) { o.period = 1; }, sources),
               GeometryError);
}

TEST(PatchBuild, ComplaintsNameThePath) {
  const auto complaint = [](PatchModel model,
                            const std::function<void(PatchOptions&)>& change) -> std::string {
    try {
      build(model, change);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(complaint(PatchModel::HeightField, [](PatchOptions& o) { o.heightmap = "builtin:mud"; })
                .find("patch.heightmap"),
            std::string::npos);
  EXPECT_NE(complaint(PatchModel::HeightField, [](PatchOptions& o) { o.heightmap = "gone.png"; })
                .find("patch.heightmap"),
            std::string::npos);
  EXPECT_NE(complaint(PatchModel::Weave, [](PatchOptions& o) { o.yarns = 5; }).find("patch.yarns"),
            std::string::npos);
  EXPECT_NE(complaint(PatchModel::Flat, [](PatchOptions& o) { o.albedo = Rgb(2); }).find("patch.albedo"),
            std::string::npos);
  EXPECT_NE(complaint(PatchModel::Flat, [](PatchOptions& o) { o.exponent = 0; }).find("patch.exponent"),
            std::string::npos);
}

}  // namespace
}  // namespace prt
