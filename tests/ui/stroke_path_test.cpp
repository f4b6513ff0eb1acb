// Lines drawn on surfaces, from what lies under the pointer.

#include "ui/model/stroke_path.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "ui/model/field_look.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

std::shared_ptr<const PaintSurface> surfaceOf(std::vector<TriMesh> meshes) {
  std::vector<SceneObject> objects;
  for (TriMesh& mesh : meshes) {
    SceneObject& object = objects.emplace_back();
    object.name = "object", object.mesh = std::make_shared<TriMesh>(std::move(mesh));
  }
  Job job;
  return std::make_shared<PaintSurface>(std::make_shared<Scene>(flattenScene(objects)), job);
}

/// What is seen of it from above at (x, z), or from below.
std::optional<SurfaceHit> lookDown(const PaintSurface& on, float x, float z, bool fromBelow = false) {
  Camera camera;
  camera.orthographic = true;
  camera.eye = {x, fromBelow ? -5.0f : 5.0f, z}, camera.target = {x, 0, z}, camera.up = {0, 0, -1};
  return pickSurface(*on.scene, camera, 0.5f, 0.5f, 1, 1);
}

TEST(StrokePath, FewPointsStayOfAStraightLineAndEnoughOfABentOne) {
  std::vector<Vec3> straight, bent;
  for (int i = 0; i <= 100; ++i) {
    straight.push_back(Vec3(0.01f * float(i), 0, 0));
    bent.push_back(Vec3(0.01f * float(i), 0.2f * std::sin(0.1f * float(i)), 0));
  }
  EXPECT_EQ(simplified(straight, 1e-3f).size(), 2u);
  const std::vector<Vec3> few = simplified(bent, 2e-3f);
  EXPECT_EQ(few.front(), bent.front());
  EXPECT_EQ(few.back(), bent.back());
  EXPECT_GT(few.size(), 6u);
  EXPECT_LT(few.size(), 40u);
  for (const Vec3& p : bent) {
    float nearest = 1;
    for (std::size_t i = 1; i < few.size(); ++i) {
      const Vec3 along = few[i] - few[i - 1];
      const float t = std::clamp(dot(p - few[i - 1], along) / dot(along, along), 0.0f, 1.0f);
      nearest = std::min(nearest, distance(p, few[i - 1] + t * along));
    }
    EXPECT_LE(nearest, 2.01e-3f);
  }
}

TEST(StrokePath, StaysOnItsSheetAndOnItsFront) {
  // A small plate above a large one: what the small one hides is no part of a stroke on the large one.
  TriMesh small = makePlane({.width = 0.4f, .depth = 0.4f, .columns = 4, .rows = 4});
  for (Vec3& p : small.positions) p.y += 0.5f;
  const auto on = surfaceOf({makePlane({.width = 2, .depth = 2, .columns = 8, .rows = 8}), small});
  StrokePath path(on);
  int taken = 0, left = 0;
  for (int i = 0; i <= 40; ++i) {
    const auto hit = lookDown(*on, -0.9f + 0.045f * float(i), 0.03f);
    ASSERT_TRUE(hit);
    ++(path.add(*hit) ? taken : left);
  }
  EXPECT_GT(left, 6);
  EXPECT_GT(taken, 25);
  for (const Vec3& p : path.points()) EXPECT_NEAR(p.y, 0, 1e-6f);
  EXPECT_EQ(path.stroke().points.size(), 2u) << "a straight line";
  const auto behind = lookDown(*on, 0.9f, 0.9f, true);
  ASSERT_TRUE(behind && behind->back);
  EXPECT_FALSE(path.add(*behind));
}

TEST(StrokePath, OneTooShortHasNoDirection) {
  const auto on = surfaceOf({makePlane()});
  StrokePath path(on);
  ASSERT_TRUE(path.add(*lookDown(*on, 0.1f, 0.1f)));
  EXPECT_FALSE(path.add(*lookDown(*on, 0.1f, 0.1f))) << "the same place again";
  EXPECT_TRUE(path.stroke().points.empty());
  ASSERT_TRUE(path.add(*lookDown(*on, 0.1005f, 0.1f)));
  EXPECT_TRUE(path.stroke().points.empty());
  ASSERT_TRUE(path.add(*lookDown(*on, 0.2f, 0.1f)));
  EXPECT_EQ(path.stroke().points.size(), 2u);
}

TEST(FieldLook, LinesRunAlongTheFieldAndLieOnTheSurface) {
  const auto on = surfaceOf({makeIcosphere({.subdivisions = 3})});
  for (const int symmetry : {1, 2, 4}) {
    Job job;
    const OrientationField field =
        makeOrientationField(on->scene->mesh, on->surface, {.symmetry = symmetry}, job);
    const SurfaceMarks lines = fieldLines(*on, field);
    const std::size_t each = symmetry == 1 ? 3 : symmetry == 2 ? 1 : 2, count = on->spread.points.size();
    EXPECT_GT(count, 1500u);
    ASSERT_EQ(lines.edges.size(), 2 * each * count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 a = lines.edges[2 * each * i], b = lines.edges[2 * each * i + 1];
      const SurfacePoint& point = on->spread.points[i];
      const Vec3 tangent = tangentAt(field.frames, point.triangle, point.barycentric, on->normalAt(point));
      EXPECT_GT(dot(normalize(b - a), tangent), 0.98f);
      EXPECT_NEAR(length(a), 1, 0.02f);
    }
    int sum = 0;
    for (const FieldKnot& knot : fieldKnots(on->surface, field)) {
      sum += knot.index;
      EXPECT_NEAR(length(knot.position), 1, 0.02f);
    }
    EXPECT_EQ(sum, 2 * symmetry);
  }
}

}  // namespace
}  // namespace prt::ui
