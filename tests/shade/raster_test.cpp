#include "libprt/shade/raster.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "tests/shade/test_meshes.h"

#include <gtest/gtest.h>

#include <map>

namespace prt {
namespace {

/// Every sample of an image, as the rasteriser sees it.
struct Samples {
  int width, height;
  std::vector<std::uint32_t> triangle;
  std::vector<float> nearness;
};

Samples drawAll(const TriMesh& mesh, const Camera& camera, int width, int height, int grid) {
  Job job;
  const Rasterizer rasterizer(mesh, camera, width, height, grid, job);
  Samples all{width * grid, height * grid, {}, {}};
  all.triangle.resize(std::size_t(all.width * all.height));
  all.nearness.resize(all.triangle.size());
  SampleTile tile;
  for (std::size_t t = 0; t < rasterizer.tileCount(); ++t) {
    rasterizer.drawSamples(t, tile);
    for (int y = 0; y < tile.height * grid; ++y)
      for (int x = 0; x < tile.width * grid; ++x) {
        const std::size_t to = std::size_t((tile.y * grid + y) * all.width + tile.x * grid + x);
        all.triangle[to] = tile.triangle[std::size_t(y * tile.stride + x)];
        all.nearness[to] = tile.nearness[std::size_t(y * tile.stride + x)];
      }
  }
  return all;
}

/// The plain twin: one ray against one triangle, in double.
struct RayHit {
  double t = 1e30, b1 = 0, b2 = 0;
};
RayHit meet(const TriMesh& mesh, std::size_t i, const DVec3& eye, const DVec3& d) {
  const UVec3& t = mesh.triangles[i];
  const DVec3 p0(mesh.positions[t.x]), e1 = DVec3(mesh.positions[t.y]) - p0,
                                       e2 = DVec3(mesh.positions[t.z]) - p0;
  const DVec3 n = cross(e1, e2);
  const double distance = dot(p0 - eye, n) / dot(d, n);
  const DVec3 q = eye + distance * d - p0;
  return {distance, dot(cross(q, e2), n) / dot(n, n), dot(cross(e1, q), n) / dot(n, n)};
}

/// Compares with brute force wherever no edge is within `margin` (barycentric) of the sample.
void expectSameAsRays(const TriMesh& mesh, const Camera& camera, int width, int height, int grid,
                      double margin) {
  const Samples drawn = drawAll(mesh, camera, width, height, grid);
  const CameraRays rays(camera, width, height);
  int compared = 0, wrong = 0;
  double worstDepth = 0;
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) {
      const float px = (float(x) + 0.5f) / float(grid), py = (float(y) + 0.5f) / float(grid);
      const DVec3 d(rays.through(px, py)), from(rays.origin(px, py));
      double nearest = 1e30;
      std::uint32_t id = kNoTriangle;
      bool nearEdge = false;
      for (std::size_t i = 0; i < mesh.triangleCount(); ++i) {
        const RayHit h = meet(mesh, i, from, d);
        const double inside = std::min({h.b1, h.b2, 1 - h.b1 - h.b2});
        if (!(h.t > (camera.orthographic ? -1e20 : 0)) || !(inside > -margin)) continue;
        if (inside < margin) nearEdge = true;
        if (inside >= 0 && h.t < nearest) nearest = h.t, id = std::uint32_t(i);
      }
      if (nearEdge) continue;
      const std::size_t at = std::size_t(y * drawn.width + x);
      ++compared;
      wrong += drawn.triangle[at] != id;
      if (id != kNoTriangle && drawn.triangle[at] == id && !camera.orthographic)
        worstDepth = std::max(worstDepth, std::abs(drawn.nearness[at] * nearest - 1));
    }
  EXPECT_EQ(wrong, 0) << "of " << compared;
  EXPECT_GT(compared, drawn.width * drawn.height / 2);
  EXPECT_LT(worstDepth, 2e-3);  // snapping moves a steep triangle's depth a little
}

TEST(Raster, SeesWhatRaysSee) {
  Camera camera;
  camera.eye = {1.5f, 1, 2.2f};
  expectSameAsRays(test::blob(12, 18, 0.9f, 0.3f), camera, 56, 48, 2, 0.02);
}

TEST(Raster, SeesWhatRaysSeeFromInside) {
  Camera camera;  // triangles reach behind the eye and far outside the image
  camera.eye = {0.1f, 0.2f, 0.3f}, camera.target = {1, 0.4f, 0.2f};
  camera.verticalFov = float(radians(100));
  expectSameAsRays(test::blob(5, 6, 1.0f), camera, 60, 40, 1, 0.01);
}

TEST(Raster, SeesWhatParallelRaysSeeBehindTheEyeToo) {
  Camera camera;
  camera.orthographic = true;
  camera.eye = {0.3f, 0.2f, 0.4f};  // inside
  camera.verticalFov = float(radians(120));
  expectSameAsRays(test::blob(12, 18, 0.9f, 0.3f), camera, 56, 48, 2, 0.02);
}

TEST(Raster, SeesWhatRaysSeeThroughAHugePlane) {
  TriMesh plane = test::shakenSquare(1, 0, 1);
  for (Vec3& p : plane.positions) p = Vec3(p.x * 1e5f, -0.01f, -p.y * 1e5f);
  Camera camera;
  camera.eye = {0, 0, 0}, camera.target = {0, -0.2f, -1};
  expectSameAsRays(plane, camera, 64, 48, 2, 1e-8);
}

TEST(Raster, NeighboursNeitherOverlapNorLeaveGaps) {
  const TriMesh square = test::shakenSquare(9, 0.8f, 7);
  Camera camera;
  camera.eye = {0.3f, 0.2f, 1.7f}, camera.verticalFov = float(radians(70));
  const Samples together = drawAll(square, camera, 40, 32, 4);
  std::vector<int> claims(together.triangle.size(), 0);
  TriMesh one = square;
  for (const UVec3& t : square.triangles) {
    one.triangles = {t};
    const Samples alone = drawAll(one, camera, 40, 32, 4);
    for (std::size_t i = 0; i < claims.size(); ++i) claims[i] += alone.triangle[i] != kNoTriangle;
  }
  // Inside the outline every sample belongs to exactly one triangle, also where corners fall on samples.
  TriMesh outline = test::shakenSquare(1, 0, 1);
  const Samples whole = drawAll(outline, camera, 40, 32, 4);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    EXPECT_LE(claims[i], 1);
    EXPECT_EQ(claims[i] == 1, together.triangle[i] != kNoTriangle);
  }
  int differ = 0, covered = 0;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    covered += whole.triangle[i] != kNoTriangle;
    differ += (whole.triangle[i] != kNoTriangle) != (claims[i] == 1);
  }
  EXPECT_GT(covered, 10000);
  EXPECT_LT(differ, 8);  // border corners snap independently of the single quad's edges
}

TEST(Raster, SamplesExactlyOnSharedEdgesHaveOneOwner) {
  // Corners project to sample centres: 2 units seen from distance 1 at 90 degrees fill the image exactly.
  TriMesh square = test::shakenSquare(8, 0, 1);
  Camera camera;
  camera.eye = {0, 0, 1}, camera.verticalFov = float(radians(90));
  for (Vec3& p : square.positions) p += Vec3(1.0f / 16, 1.0f / 16, 0);  // half a sample of 16 along both axes
  std::vector<int> claims(16 * 16, 0);
  TriMesh one = square;
  for (const UVec3& t : square.triangles) {
    one.triangles = {t};
    const Samples alone = drawAll(one, camera, 16, 16, 1);
    for (std::size_t i = 0; i < claims.size(); ++i) claims[i] += alone.triangle[i] != kNoTriangle;
  }
  for (int y = 0; y < 15; ++y)
    for (int x = 1; x < 16; ++x) EXPECT_EQ(claims[std::size_t(y * 16 + x)], 1) << x << "," << y;
}

TEST(Raster, CoverageMatchesArea) {
  const TriMesh sphere = test::blob(40, 80, 1.0f);
  Camera camera;
  camera.eye = {0, 0, 5};
  Job job;
  const FragmentImage image = rasterize(sphere, camera, 101, 77, 4, job);
  double covered = 0;
  for (const FragmentTile& tile : image.tiles)
    for (const Fragment& f : tile.fragments) covered += f.samples / 16.0;
  const double focal = 0.5 * 77 / std::tan(0.5 * camera.verticalFov);
  const double radius = focal / std::sqrt(24.0);  // silhouette cone of the unit sphere from distance 5
  EXPECT_NEAR(covered / (kPi * radius * radius), 1, 0.01);
}

TEST(Raster, FragmentsPartitionTheirSamplesAndLieOnTheirRay) {
  const TriMesh mesh = test::blob(30, 60, 1.0f, 0.2f);
  Camera camera;
  camera.eye = {2, 1, 2};
  Job job;
  const FragmentImage image = rasterize(mesh, camera, 70, 50, 4, job);
  const Samples samples = drawAll(mesh, camera, 70, 50, 4);
  const CameraRays rays(camera, 70, 50);
  std::size_t pixels = 0;
  for (const FragmentTile& tile : image.tiles)
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x, ++pixels) {
        std::map<std::uint32_t, int> expected, found;
        for (int s = 0; s < 16; ++s) {
          const int sx = (tile.x + x) * 4 + s % 4, sy = (tile.y + y) * 4 + s / 4;
          const std::uint32_t id = samples.triangle[std::size_t(sy * samples.width + sx)];
          if (id != kNoTriangle) ++expected[id];
        }
        for (const Fragment& f : tile.pixel(std::size_t(y * tile.width + x))) {
          found[f.triangle] += f.samples;
          EXPECT_FALSE(f.back);
          const UVec3& t = mesh.triangles[f.triangle];
          const Vec3 p = (1 - f.barycentric.x - f.barycentric.y) * mesh.positions[t.x] +
                         f.barycentric.x * mesh.positions[t.y] + f.barycentric.y * mesh.positions[t.z];
          const Vec3 local = camera.axes().toLocal(p - camera.eye);
          const float focal = 25 / std::tan(0.5f * camera.verticalFov);
          EXPECT_NEAR(35 - focal * local.x / local.z, float(tile.x + x) + 0.5f, 0.51f);
          EXPECT_NEAR(25 + focal * local.y / local.z, float(tile.y + y) + 0.5f, 0.51f);
        }
        EXPECT_EQ(found, expected);
      }
  EXPECT_EQ(pixels, 70u * 50u);
}

TEST(Raster, BarycentricsArePerspectiveCorrect) {
  TriMesh floor = test::shakenSquare(1, 0, 1);
  for (Vec3& p : floor.positions) p = Vec3(p.x, 0, -p.y);
  Camera camera;
  camera.eye = {0.1f, 0.3f, 1.2f}, camera.target = {0, 0, 0};
  Job job;
  const FragmentImage image = rasterize(floor, camera, 64, 48, 1, job);
  const CameraRays rays(camera, 64, 48);
  int seen = 0;
  for (const FragmentTile& tile : image.tiles)
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x)
        for (const Fragment& f : tile.pixel(std::size_t(y * tile.width + x))) {
          const RayHit h = meet(floor, f.triangle, DVec3(camera.eye),
                                DVec3(rays.through(float(tile.x + x) + 0.5f, float(tile.y + y) + 0.5f)));
          EXPECT_NEAR(f.barycentric.x, std::clamp(h.b1, 0.0, 1.0), 2e-3);
          EXPECT_NEAR(f.barycentric.y, std::clamp(h.b2, 0.0, 1.0), 2e-3);
          ++seen;
        }
  EXPECT_GT(seen, 500);
}

TEST(Raster, DoesNotDependOnThreads) {
  const TriMesh mesh = test::blob(60, 90, 1.0f, 0.3f);
  const auto draw = [&](int threads) {
    setThreadCount(threads);
    Job job;
    FragmentImage image = rasterize(mesh, frameBox(mesh.bounds()), 150, 130, 3, job);
    setThreadCount(0);
    return image;
  };
  const FragmentImage a = draw(1), b = draw(5);
  ASSERT_EQ(a.tiles.size(), b.tiles.size());
  for (std::size_t t = 0; t < a.tiles.size(); ++t) {
    EXPECT_EQ(a.tiles[t].first, b.tiles[t].first);
    ASSERT_EQ(a.tiles[t].fragments.size(), b.tiles[t].fragments.size());
    for (std::size_t i = 0; i < a.tiles[t].fragments.size(); ++i) {
      EXPECT_EQ(a.tiles[t].fragments[i].triangle, b.tiles[t].fragments[i].triangle);
      EXPECT_EQ(a.tiles[t].fragments[i].barycentric, b.tiles[t].fragments[i].barycentric);
    }
  }
}

TEST(Raster, SeesBackFaces) {
  Camera camera;
  camera.eye = {0, 0, -2};
  Job job;
  const FragmentImage image = rasterize(test::shakenSquare(2, 0, 1), camera, 32, 32, 1, job);
  std::size_t seen = 0;
  for (const FragmentTile& tile : image.tiles)
    for (const Fragment& f : tile.fragments) {
      EXPECT_TRUE(f.back);
      ++seen;
    }
  EXPECT_GT(seen, 100u);
}

TEST(Raster, DegenerateTrianglesAndEmptyViewsDrawNothing) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 9}, {1, 0, 9}, {0, 1, 9}};
  mesh.triangles = {{0, 1, 2}, {1, 1, 1}, {3, 4, 5}};  // a line, a point, one behind the eye
  Job job;
  for (const FragmentTile& tile : rasterize(mesh, Camera{}, 20, 20, 2, job).tiles)
    EXPECT_TRUE(tile.fragments.empty());
}

TEST(Raster, RefusesSizesItCannotHold) {
  const TriMesh mesh = test::shakenSquare(1, 0, 1);
  Job job;
  EXPECT_THROW(rasterize(mesh, Camera{}, 0, 10, 1, job), ValueError);
  EXPECT_THROW(rasterize(mesh, Camera{}, 10, 10, 17, job), ValueError);
  EXPECT_THROW(rasterize(mesh, Camera{}, 65536, 10, 2, job), ValueError);
}

}  // namespace
}  // namespace prt
