#include "libprt/shade/surface_overlay.h"

#include "libprt/core/error.h"
#include "libprt/shade/color_map.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

/// A unit square in z = 0 that faces the camera, which sees 2 units over 200 pixels.
TriMesh square() {
  return test::grid({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
}

OverlayPicture picture() {
  OverlayPicture p;
  p.camera.eye = {0, 0, 10};
  p.camera.verticalFov = 2 * std::atan(0.1f);
  p.width = p.height = 200;
  return p;
}

Vec4 at(const Image& image, int x, int y) {
  const float* p = image.pixel(x, y);
  return {p[0], p[1], p[2], p[3]};
}

Image drawn(const std::vector<float>& values, const SurfaceMarks& marks, const TriMesh& mesh = square()) {
  Job job;
  return drawSurfaceOverlay(mesh, values, marks, picture(), job);
}

TEST(SurfaceOverlay, ColoursTheSurfaceByItsValues) {
  const Image image = drawn({0, 1, 0, 1}, {});
  EXPECT_EQ(at(image, 10, 100), Vec4(0)) << "beside the surface nothing is laid over";
  for (const auto& [x, value] : {std::pair(52, 0.02f), std::pair(100, 0.5f), std::pair(147, 0.98f)}) {
    const Vec4 pixel = at(image, x, 100);
    EXPECT_NEAR(pixel.w, 1, 1e-5);
    EXPECT_LT(length(Vec3(pixel) - magnitudeColor(value)), 0.03f) << x;
  }
}

TEST(SurfaceOverlay, UnknownValuesAreGrey) {
  const Image image = drawn({-1, 0.5f, 0.5f, 0.5f}, {});
  EXPECT_LT(length(Vec3(at(image, 70, 120)) - kUnknownColor), 0.02f);
}

TEST(SurfaceOverlay, PaintColoursTrianglesAndDarkensSquares) {
  const TriMesh mesh = square();
  SurfacePaint paint;
  paint.colors = {Rgb(1, 0, 0), Rgb(0, 1, 0)};
  Job job;
  const Image plain = drawSurfaceOverlay(mesh, {}, paint, {}, picture(), job);
  // Both colours, each over half of the square, and nothing between them.
  int red = 0, green = 0;
  for (int y = 55; y < 145; ++y)
    for (int x = 55; x < 145; ++x) red += at(plain, x, y).x > 0.9f, green += at(plain, x, y).y > 0.9f;
  EXPECT_NEAR(red, 4050, 120);
  EXPECT_NEAR(green, 4050, 120);
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) paint.uv.push_back(Vec2(mesh.positions[t[k]]) + Vec2(0.5f));
  paint.squares = 2;
  const Image squares = drawSurfaceOverlay(mesh, {}, paint, {}, picture(), job);
  const auto brightness = [&](int x, int y) { return std::max(at(squares, x, y).x, at(squares, x, y).y); };
  EXPECT_NEAR(brightness(70, 60), kDarkSquare, 0.02f);
  EXPECT_NEAR(brightness(130, 70), 1, 0.02f);
  EXPECT_NEAR(brightness(70, 140), 1, 0.02f);
  paint.colors.pop_back();
  EXPECT_THROW(drawSurfaceOverlay(mesh, {}, paint, {}, picture(), job), ValueError);
}

TEST(SurfaceOverlay, APictureIsLaidOverItsCoordinates) {
  const TriMesh mesh = square();
  SurfacePaint paint;
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) paint.uv.push_back(Vec2(mesh.positions[t[k]]) + Vec2(0.5f));
  Image picture4(2, 2, 3);
  picture4.pixel(0, 0)[0] = 1, picture4.pixel(1, 0)[1] = 1,
                    picture4.pixel(0, 1)[2] = 1;  // red, green / blue, black
  paint.picture = std::make_shared<const Image>(std::move(picture4));
  EXPECT_FALSE(paint.empty());
  Job job;
  const Image drawn = drawSurfaceOverlay(mesh, {}, paint, {}, picture(), job);
  EXPECT_NEAR(at(drawn, 75, 75).x, 1, 0.02f) << "v = 1 is at the top";
  EXPECT_NEAR(at(drawn, 125, 75).y, 1, 0.02f);
  EXPECT_NEAR(at(drawn, 75, 125).z, 1, 0.02f);
  EXPECT_EQ(at(drawn, 125, 125), Vec4(0, 0, 0, 1)) << "black, and covers";
  paint.uv.pop_back();
  EXPECT_THROW(drawSurfaceOverlay(mesh, {}, paint, {}, picture(), job), ValueError);
}

TEST(SurfaceOverlay, MarksAreInFrontOrShineThrough) {
  SurfaceMarks marks;
  marks.color = Rgb(1, 0, 0);
  marks.points = {{0, 0, 0}, {0.3f, 0, -1}, {0.8f, 0, -1}};
  const Image image = drawn({}, marks);
  EXPECT_NEAR(at(image, 100, 100).w, 1, 1e-3) << "on the surface";
  EXPECT_NEAR(at(image, 100, 100).x, 1, 1e-3);
  const int behind = 100 + int(100 * 0.3f * 10 / 11);
  EXPECT_NEAR(at(image, behind, 100).w, SurfaceMarks{}.hidden, 1e-3) << "a unit behind it";
  EXPECT_NEAR(at(image, 100 + int(100 * 0.8f * 10 / 11), 100).w, 1, 1e-3) << "as far away, beside it";
  EXPECT_EQ(at(image, 100, 80), Vec4(0));
}

TEST(SurfaceOverlay, EdgesAndTrianglesCoverWhatTheyAreOn) {
  SurfaceMarks edge, face;
  edge.edges = {{-0.4f, 0, 0}, {0.4f, 0, 0}};
  face.triangles = {{-0.4f, -0.4f, 0}, {0.4f, -0.4f, 0}, {0, 0.4f, 0}};
  const Image line = drawn({}, edge), filled = drawn({}, face);
  for (int x = 65; x < 136; x += 10) EXPECT_NEAR(at(line, x, 100).w, 1, 0.3f);
  EXPECT_EQ(at(line, 100, 110).w, 0);
  EXPECT_NEAR(at(filled, 100, 100).w, SurfaceMarks{}.fill, 1e-3);
  EXPECT_EQ(at(filled, 70, 70).w, 0);
}

TEST(SurfaceOverlay, MarksThatLieOverEachOtherDoNotAddUp) {
  SurfaceMarks marks;
  marks.triangles = {{-0.4f, -0.4f, 0}, {0.4f, -0.4f, 0}, {0, 0.4f, 0}};
  const Vec4 once = at(drawn({}, marks), 100, 100);
  marks.triangles.insert(marks.triangles.end(), marks.triangles.begin(), marks.triangles.begin() + 3);
  EXPECT_EQ(at(drawn({}, marks), 100, 100), once);
}

TEST(SurfaceOverlay, LayersLieOverEachOtherWithTheirOwnFillAndSize) {
  std::vector<SurfaceMarks> layers(2);
  layers[0].triangles = {{-0.4f, -0.4f, 0}, {0.4f, -0.4f, 0}, {0, 0.4f, 0}};
  layers[0].color = Rgb(0, 0, 1), layers[0].fill = 0.25f;
  layers[1].points = {Vec3(0)};
  layers[1].color = Rgb(1, 0, 0);
  Job job;
  const auto draw = [&] { return drawSurfaceOverlay(square(), {}, {}, layers, picture(), job); };
  EXPECT_NEAR(at(draw(), 100, 112).w, 0.25f, 1e-3) << "below the point";
  EXPECT_NEAR(at(draw(), 100, 100).x, 1, 1e-3) << "the later layer is on top";
  layers[1].size = 4;
  EXPECT_NEAR(at(draw(), 100, 112).x, 1, 1e-3) << "and reaches further now";
}

TEST(SurfaceOverlay, WhatIsBehindTheCameraIsLeftOut) {
  SurfaceMarks marks;
  marks.points = {{0, 0, 20}};
  marks.edges = {{0, 0, 20}, {0, 0, 0}};
  marks.triangles = {{0, 0, 20}, {0, 1, 0}, {1, 0, 0}};
  const Image image = drawn({}, marks);
  for (const float v : image.data) EXPECT_EQ(v, 0);
}

TEST(SurfaceOverlay, ValuesMustFit) {
  EXPECT_THROW(drawn({1, 2, 3}, {}), ValueError);
}

TEST(SurfaceOverlay, BoundsHoldAllMarks) {
  SurfaceMarks marks;
  EXPECT_TRUE(marks.bounds().empty());
  marks.points = {{0, 0, 0}};
  marks.edges = {{1, 0, 0}, {0, 2, 0}};
  marks.triangles = {{0, 0, 3}, {0, 0, 0}, {0, 0, -1}};
  EXPECT_EQ(marks.bounds().low, Vec3(0, 0, -1));
  EXPECT_EQ(marks.bounds().high, Vec3(1, 2, 3));
}

}  // namespace
}  // namespace prt
