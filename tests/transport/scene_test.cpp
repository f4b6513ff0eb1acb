#include "libprt/transport/scene.h"

#include "libprt/core/error.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace prt {
namespace {

using test::box;
using test::grid;
using test::sceneOf;

SceneObject object(TriMesh mesh, Mat4 transform = Mat4(1)) {
  return {"thing", std::make_shared<TriMesh>(std::move(mesh)), transform, Material{}};
}

/// Volume enclosed by the triangles; negative when they face inside.
double volume(const TriMesh& mesh) {
  double sum = 0;
  for (const UVec3& t : mesh.triangles)
    sum += dot(DVec3(mesh.positions[t.x]), cross(DVec3(mesh.positions[t.y]), DVec3(mesh.positions[t.z]))) / 6;
  return sum;
}

void expectNormalsFaceOut(const TriMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_GT(dot(normalize(mesh.areaNormal(t)), mesh.normals[mesh.triangles[t][k]]), 0.99f);
}

TEST(Scene, ObjectsFollowEachOtherWithTheirMaterials) {
  std::vector<SceneObject> objects{object(box(Vec3(0), Vec3(1))),
                                   object(grid(Vec3(0), {1, 0, 0}, {0, 1, 0}, 2, 2))};
  objects[1].material.albedo = Rgb(0.25f);
  const Scene scene = flattenScene(objects);
  EXPECT_EQ(scene.mesh.vertexCount(), 24u + 9u);
  EXPECT_EQ(scene.mesh.triangleCount(), 12u + 8u);
  EXPECT_EQ(scene.triangleObject[11], 0u);
  EXPECT_EQ(scene.triangleObject[12], 1u);
  EXPECT_EQ(scene.vertexObject[24], 1u);
  EXPECT_EQ(scene.materialOf(15).albedo, Rgb(0.25f));
  EXPECT_GE(scene.mesh.triangles[12].x, 24u);
  EXPECT_TRUE(scene.mesh.uv.empty());
}

TEST(Scene, TransformsKeepTheOutsideOutside) {
  const Mat4 stretched = glm::scale(glm::rotate(Mat4(1), 0.7f, Vec3(1, 2, 3)), Vec3(2, 0.5f, 3));
  const Mat4 mirrored = glm::scale(stretched, Vec3(-1, 1, 1));
  for (const Mat4& transform : {stretched, mirrored}) {
    const SceneObject one = object(box(Vec3(-1), Vec3(1)), transform);
    const Scene scene = flattenScene({&one, 1});
    EXPECT_NEAR(volume(scene.mesh), 8 * 3, 1e-4);
    expectNormalsFaceOut(scene.mesh);
  }
}

TEST(Scene, TextureCoordinatesOfMixedObjectsStayAligned) {
  TriMesh mapped = grid(Vec3(0), {1, 0, 0}, {0, 1, 0}, 1, 1);
  mapped.uv = {{0, 0}, {1, 0}, {1, 1}};
  mapped.uvTriangles = {{0, 1, 2}, {0, 2, 1}};
  const std::vector<SceneObject> objects{object(box(Vec3(0), Vec3(1))), object(mapped)};
  const Scene scene = flattenScene(objects);
  ASSERT_EQ(scene.mesh.uvTriangles.size(), scene.mesh.triangleCount());
  EXPECT_EQ(scene.mesh.uv[scene.mesh.uvTriangles[12].y], Vec2(1, 0));
  EXPECT_EQ(scene.mesh.uv[scene.mesh.uvTriangles[13].y], Vec2(1, 1));
  EXPECT_EQ(scene.mesh.uv[scene.mesh.uvTriangles[0].x], Vec2(0, 0));
}

TEST(Scene, RefusesWhatCannotBeTraced) {
  EXPECT_THROW(flattenScene({}), GeometryError);
  const auto refused = [](const SceneObject& o) { EXPECT_THROW(flattenScene({&o, 1}), GeometryError); };
  refused(object(TriMesh{}));
  refused(object(box(Vec3(0), Vec3(1)), glm::scale(Mat4(1), Vec3(1, 0, 1))));
  refused(object(box(Vec3(0), Vec3(1)), Mat4(std::numeric_limits<float>::quiet_NaN())));
  refused(object(box(Vec3(0), Vec3(1)), glm::perspective(1.0f, 1.0f, 0.1f, 10.0f)));
  refused({"nothing", nullptr, Mat4(1), Material{}});
  TriMesh broken = box(Vec3(0), Vec3(1));
  broken.triangles[3].y = 24;
  refused(object(broken));
  TriMesh endless = box(Vec3(0), Vec3(1));
  endless.positions[5].z = std::numeric_limits<float>::infinity();
  refused(object(endless));
  refused(object(box(Vec3(0), Vec3(1e30f)), glm::scale(Mat4(1), Vec3(1e30f))));
}

TEST(Scene, RefusesMoreThanIndicesCanNumber) {
  const auto mesh = std::make_shared<TriMesh>(grid(Vec3(0), {1, 0, 0}, {0, 1, 0}, 512, 512));
  const std::vector<SceneObject> objects(10000, {"tile", mesh, Mat4(1), Material{}});
  EXPECT_THROW(flattenScene(objects), GeometryError);
}

}  // namespace
}  // namespace prt
