#include "libprt/shade/patch_filter.h"

#include "libprt/atlas/geometry_image.h"
#include "libprt/core/parallel.h"
#include "libprt/meso/rtt_compress.h"
#include "libprt/shade/biscale.h"
#include "tests/support/patch_covers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace prt {
namespace {

constexpr int kTexels = test::kContrastedTexels;
using test::byPlace;
using test::contrastedRtt;
using test::coverBy;
using test::matrices;
using test::PatchedWorld;
using test::rock;
using test::sceneOf;
using test::variedLight;

/// Coefficients of the patch's texels, as the filter has them.
std::vector<float> texelsOf(const Rtt& rtt) {
  Job job;
  return compressRtt(rtt, PatchFilter::kTerms, job).coefficients;
}

TEST(PatchFilter, LevelsAreMeansOverTheTexelsOfTheirChart) {
  const Scene scene = sceneOf(rock(12));
  const Rtt rtt = contrastedRtt();
  const auto cover = coverBy(scene, 64, byPlace);
  Job job;
  const PatchFilter filter(cover, rtt, job);
  const std::vector<float> texels = texelsOf(rtt);
  const Atlas& atlas = *cover->atlas();
  const GeometryImage image = makeGeometryImage(atlas, 64, -1, job);
  ASSERT_GT(atlas.chartCount, 1u);
  ASSERT_EQ(filter.levels(), 6);
  int compared = 0;
  for (std::uint32_t chart = 0; chart < atlas.chartCount; ++chart)
    for (int level = 1; level <= filter.levels(); ++level)
      for (int y = 0; y < 64 >> level; ++y)
        for (int x = 0; x < 64 >> level; ++x) {
          std::vector<double> mean(PatchFilter::kTerms, 0.0);
          int count = 0;
          for (int j = y << level; j < (y + 1) << level; ++j)
            for (int i = x << level; i < (x + 1) << level; ++i) {
              const std::size_t texel = image.index(i, j);
              if (image.kind[texel] != TexelKind::Inside || atlas.chartOf[image.triangle[texel]] != chart)
                continue;
              const auto [u, v] = rtt.texelAt(cover->map()->at(texel));
              for (std::size_t t = 0; t < mean.size(); ++t)
                mean[t] += double(texels[std::size_t(v * kTexels + u) * mean.size() + t]);
              ++count;
            }
          if (count < 1 << (2 * level - 1)) continue;  // rims weigh a thousandth of the others
          ++compared;
          PatchFilter::Coefficients sum{};
          filter.add({(Vec2(float(x), float(y)) + 0.5f) * float(1 << level), chart}, float(level), 1, sum);
          for (std::size_t t = 0; t < mean.size(); ++t)
            ASSERT_NEAR(double(sum[t]), mean[t] / count, 4e-3)
                << chart << ' ' << level << ' ' << x << ' ' << y;
        }
  EXPECT_GT(compared, 300);
}

/// `cover` with a second patch that shows `part`, in 255ths, of every texel.
std::shared_ptr<const PatchCover> layered(const Scene& scene, const std::shared_ptr<const PatchCover>& cover,
                                          const std::function<int(std::size_t)>& part) {
  auto map = std::make_shared<IdMap>(*cover->map());
  map->layers = 1;
  for (std::size_t i = 0; i < map->ids.size() / 2; ++i) map->weights.push_back(std::uint8_t(part(i)));
  return std::make_shared<PatchCover>(std::shared_ptr<const Atlas>(cover, cover->atlas()), map,
                                      scene.mesh.triangleCount());
}

TEST(PatchFilter, LayersAreMixedBeforeTheyAreFiltered) {
  const Scene scene = sceneOf(rock(12));
  Rtt rtt = contrastedRtt();
  const auto cover = coverBy(scene, 64, byPlace);
  const std::size_t each = rtt.values.size();
  for (std::size_t i = 0; i < each; ++i) rtt.values.push_back(0.3f * rtt.values[(7 * i + 50) % each]);
  rtt.layers = 2;
  Job job;
  const PatchFilter none(layered(scene, cover, [](std::size_t) { return 0; }), rtt, job),
      all(layered(scene, cover, [](std::size_t) { return 255; }), rtt, job),
      some(layered(scene, cover, [](std::size_t) { return 102; }), rtt, job);
  EXPECT_EQ(none.error(), some.error());
  const auto texels = std::uint32_t(kTexels * kTexels);
  for (std::uint32_t t = 0; t < scene.mesh.triangleCount(); ++t) {
    const FilterPlace place = some.place(t, Vec2(0.3f));
    const FilterTexels below = none.texelsAround(place), above = all.texelsAround(place),
                       both = some.texelsAround(place);
    ASSERT_EQ(both.count, below.count + above.count);
    for (std::size_t k = 0; k < below.count; ++k) {
      ASSERT_EQ(above.texel[k], below.texel[k] + texels);
      ASSERT_EQ(both.texel[2 * k], below.texel[k]);
      ASSERT_NEAR(both.weight[2 * k], 0.6f * below.weight[k], 1e-5f);
      ASSERT_EQ(both.texel[2 * k + 1], above.texel[k]);
      ASSERT_NEAR(both.weight[2 * k + 1], 0.4f * above.weight[k], 1e-5f);
    }
    for (const float level : {1.0f, 2.4f, 5.0f}) {
      PatchFilter::Coefficients a{}, b{}, mixed{};
      none.add(place, level, 1, a), all.add(place, level, 1, b), some.add(place, level, 1, mixed);
      for (std::size_t k = 0; k < mixed.size(); ++k)
        ASSERT_NEAR(mixed[k], 0.6f * a[k] + 0.4f * b[k], 4e-3f) << t << ' ' << level;
    }
  }
}

TEST(PatchFilter, NothingBleedsFromChartToChart) {
  const Scene scene = sceneOf(rock(12));
  const Rtt rtt = contrastedRtt();
  const auto idOf = [](std::uint32_t chart) {
    return (Vec2(float(chart % 16), float(chart / 16)) + 0.5f) / 16.0f;
  };
  const auto cover = coverBy(scene, 64, [&](const Vec3&, std::uint32_t chart) { return idOf(chart); });
  Job job;
  const PatchFilter filter(cover, rtt, job);
  const std::vector<float> texels = texelsOf(rtt);
  for (std::uint32_t t = 0; t < scene.mesh.triangleCount(); ++t)
    for (const Vec2& b : {Vec2(0), Vec2(1, 0), Vec2(0, 1), Vec2(0.3f)}) {
      const FilterPlace place = filter.place(t, b);
      const auto [u, v] = rtt.texelAt(idOf(place.chart));
      const std::size_t own = std::size_t(v * kTexels + u);
      const FilterTexels around = filter.texelsAround(place);
      ASSERT_FALSE(around.empty());
      for (std::size_t k = 0; k < around.count; ++k) ASSERT_EQ(around.texel[k], own);
      for (const float level : {1.0f, 1.5f, 2.0f, 3.7f, 6.0f}) {
        PatchFilter::Coefficients sum{};
        filter.add(place, level, 1, sum);
        for (std::size_t k = 0; k < sum.size(); ++k)
          ASSERT_NEAR(sum[k], texels[own * sum.size() + k], 4e-3f) << t << ' ' << level;
      }
    }
}

TEST(PatchFilter, ARepeatedPatchHasMeansOfItsParts) {
  const Scene scene = sceneOf(rock(8));
  const Rtt rtt = test::variedRtt(6, 2, 1);  // no power of two
  TriMesh mesh = scene.mesh;
  mesh.uv = {{0, 0}}, mesh.uvTriangles.assign(mesh.triangleCount(), UVec3(0));
  Job job;
  const PatchFilter filter(std::make_shared<PatchCover>(std::make_shared<TriMesh>(mesh), PatchRepeat{}), rtt,
                           job);
  const std::vector<float> texels = texelsOf(rtt);
  const std::size_t terms = texels.size() / 36;
  std::vector<double> mean(terms, 0.0);
  for (std::size_t i = 0; i < texels.size(); ++i) mean[i % terms] += double(texels[i]) / 36;
  PatchFilter::Coefficients all{}, quarter{}, shifted{};
  filter.add({{2.3f, 100.7f}, 0}, 9, 1, all);
  filter.add({{1, 1}, 0}, 1, 1, quarter);
  filter.add({{1 - 12, 1 + 6}, 0}, 1, 1, shifted);
  EXPECT_EQ(quarter, shifted) << "it repeats";
  for (std::size_t t = 0; t < terms; ++t) {
    EXPECT_NEAR(double(all[t]), mean[t], 4e-3);
    EXPECT_NEAR(quarter[t],
                (texels[t] + texels[terms + t] + texels[6 * terms + t] + texels[7 * terms + t]) / 4, 4e-3f);
  }
}

TEST(PatchFilter, FootprintsAreThatOfThePicture) {
  Camera camera;
  camera.eye = {0.3f, 1.4f, 2.0f};
  for (const bool parallel : {false, true}) {
    camera.orthographic = parallel;
    const PixelSteps steps(camera, 64, 48);
    const Vec3 a(-1, 0, 1), e1(2, 0.2f, 0), e2(0.3f, 0.1f, -2), p = a + 0.3f * e1 + 0.4f * e2;
    const PlaneSteps plane = planeSteps(steps, p, e1, e2);
    const Vec2 here = *camera.project(p, 64, 48);
    // A hundredth of a pixel, so that the perspective's bend does not matter.
    EXPECT_LT(length(*camera.project(p + 0.01f * plane.right, 64, 48) - here - Vec2(0.01f, 0)), 2e-4f);
    EXPECT_LT(length(*camera.project(p + 0.01f * plane.down, 64, 48) - here - Vec2(0, 0.01f)), 2e-4f);
    EXPECT_LT(
        length(plane.right - weightStep(plane.right, e1, e2).x * e1 - weightStep(plane.right, e1, e2).y * e2),
        1e-5f);
  }
  const Footprint square = footprintOf({2, 0}, {0, 2}), wide = footprintOf({0, 3}, {1, 0}),
                  endless = footprintOf({1e6f, 1e6f}, {0, 0});
  EXPECT_EQ(square.taps, 1);
  EXPECT_FLOAT_EQ(square.width, 2);
  EXPECT_EQ(wide.taps, 3);
  EXPECT_NEAR(wide.width, 1, 1e-5);
  EXPECT_NEAR(length(wide.step - Vec2(0, 1)), 0, 1e-5);
  EXPECT_EQ(endless.taps, Footprint::kMostTaps);
  EXPECT_EQ(footprintOf({0, 0}, {0, 0}).width, 0);
}

/// A surface and what lies on it.
struct Subject {
  std::shared_ptr<const BiscaleSurface> surface;
  SampleSet samples;
  Transfer transfer;
};

Subject subjectOf(
    Scene scene, const Rtt& rtt,
    const std::function<std::shared_ptr<const PatchCover>(const std::shared_ptr<const Scene>&)>& cover,
    bool filtered) {
  const PatchedWorld world(std::move(scene), rtt);
  auto surface = std::make_shared<BiscaleSurface>(world.scene, world.frames, cover(world.scene),
                                                  std::make_shared<ResponseTable>(rtt));
  Job job;
  if (filtered) surface->filter = std::make_shared<PatchFilter>(surface->cover, rtt, job);
  return {surface, world.samples, matrices(world.samples.size(), 1)};
}

Image picture(const Subject& s, const Camera& camera, int width, int height) {
  Job job;
  return renderBiscale({*s.surface, s.samples, s.transfer, variedLight()}, camera, width, height, 1, job);
}

/// The mean of 16 x 16 pictures' worth of samples, none of them filtered.
Image supersampled(const Subject& s, const Camera& camera, int width, int height) {
  const Image fine = picture(s, camera, 16 * width, 16 * height);
  Image out(width, height, 4);
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x)
      for (int c = 0; c < 4; ++c) out.pixel(x / 16, y / 16)[c] += fine.pixel(x, y)[c] / 256;
  return out;
}

/// Root mean square difference over pixels that the surface covers.
double apart(const Image& a, const Image& truth) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      if (truth.pixel(x, y)[3] < 0.999f || a.pixel(x, y)[3] < 0.999f) continue;
      const Rgb d = a.rgb(x, y) - truth.rgb(x, y);
      sum += double(dot(d, d)) / 3, ++count;
    }
  EXPECT_GT(count, a.width * a.height / 10);
  return std::sqrt(sum / count);
}

TEST(PatchFilter, FilteredPicturesAreNearerToSupersampledOnes) {
  const Rtt rtt = contrastedRtt();
  const auto mapped = [](const std::shared_ptr<const Scene>& scene) { return coverBy(*scene, 512, byPlace); };
  const auto scene = [] { return sceneOf(rock(20)); };
  const Subject sharp = subjectOf(scene(), rtt, mapped, false), soft = subjectOf(scene(), rtt, mapped, true);
  Camera camera;
  camera.eye = {1.2f, 1.4f, 3.4f};
  for (const int height : {72, 36, 18}) {
    const int width = height * 4 / 3;
    const Image truth = supersampled(sharp, camera, width, height);
    const double plain = apart(picture(sharp, camera, width, height), truth),
                 filtered = apart(picture(soft, camera, width, height), truth);
    EXPECT_LT(filtered, plain / 4) << height << " rows";
    RecordProperty("nearer_" + std::to_string(height), std::to_string(plain / filtered));
  }
}

TEST(PatchFilter, SoAreThoseOfAPatchLaidByCoordinatesOverAGround) {
  const Rtt rtt = contrastedRtt();
  const auto ground = [] {
    TriMesh mesh = test::grid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 4, 4);
    for (const Vec3& p : mesh.positions) mesh.uv.push_back(Vec2(0.5f * p.x + 0.5f, 0.5f - 0.5f * p.z));
    mesh.uvTriangles = mesh.triangles;
    return sceneOf(std::move(mesh));
  };
  const auto laid = [](const std::shared_ptr<const Scene>& scene) {
    const std::shared_ptr<const TriMesh> mesh(scene, &scene->mesh);
    return std::make_shared<PatchCover>(mesh, PatchRepeat{5, 5});
  };
  const Subject sharp = subjectOf(ground(), rtt, laid, false), soft = subjectOf(ground(), rtt, laid, true);
  for (const Vec3& eye : {Vec3(0.4f, 2, 2), Vec3(0.3f, 0.5f, 2.4f)}) {
    Camera camera;
    camera.eye = eye;
    const Image truth = supersampled(sharp, camera, 40, 30);
    const double plain = apart(picture(sharp, camera, 40, 30), truth),
                 filtered = apart(picture(soft, camera, 40, 30), truth);
    EXPECT_LT(filtered, plain / 4) << filtered << " against " << plain;
  }
}

TEST(PatchFilter, MagnifiedTexelsBlendAndDoNotDependOnThreads) {
  const Rtt rtt = contrastedRtt();
  const auto mapped = [](const std::shared_ptr<const Scene>& scene) { return coverBy(*scene, 64, byPlace); };
  const Subject sharp = subjectOf(sceneOf(rock(12)), rtt, mapped, false),
                soft = subjectOf(sceneOf(rock(12)), rtt, mapped, true);
  Camera camera;
  camera.eye = {0, 0.3f, 1.8f};
  camera.verticalFov = 0.2f;
  const Image plain = picture(sharp, camera, 80, 60);
  setThreadCount(1);
  const Image one = picture(soft, camera, 80, 60);
  setThreadCount(3);
  const Image three = picture(soft, camera, 80, 60);
  setThreadCount(0);
  EXPECT_EQ(one.data, three.data);
  const auto roughness = [](const Image& image) {  // from pixel to pixel
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 1; x < image.width; ++x)
        sum += double(std::pow(image.rgb(x, y).x - image.rgb(x - 1, y).x, 2.0f));
    return sum;
  };
  EXPECT_LT(roughness(one), 0.5 * roughness(plain));
}

}  // namespace
}  // namespace prt
