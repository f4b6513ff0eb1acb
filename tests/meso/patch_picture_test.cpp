#include "libprt/meso/patch_picture.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/meso/patch_generate.h"
#include "libprt/meso/weave.h"
#include "tests/meso/meso_support.h"

#include <gtest/gtest.h>

#include <limits>

namespace prt {
namespace {

using namespace test;

Image pictureOf(const PatchScene& patch, const PatchView& view, int size = 48) {
  Job job;
  return patchPicture(patch, view, size, size, job);
}

double covered(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) sum += double(image.data[4 * i + 3]);
  return sum / double(image.pixels());
}

PatchView fromAbove() {
  PatchView view;
  view.azimuth = 0, view.elevation = 1.5707f;
  return view;
}

TEST(PatchPicture, AFlatPatchFromAboveIsOneSquareOfOneColour) {
  const PatchScene patch = sceneOf(flatPatch(Rgb(0.5f)));
  const Image image = pictureOf(patch, fromAbove());
  EXPECT_EQ(image.pixel(0, 0)[3], 0);
  ASSERT_EQ(image.pixel(24, 24)[3], 1);
  // Almost its diagonal fits the picture's height, measured on the sphere around it.
  const double side = 1 / (std::sqrt(2.0) * 0.88 / std::cos(0.26));
  EXPECT_NEAR(covered(image), side * side, 0.01);
  for (int y = 12; y < 36; ++y)
    for (int x = 12; x < 36; ++x) EXPECT_NEAR(image.pixel(x, y)[0], image.pixel(24, 24)[0], 1e-5f);
}

TEST(PatchPicture, ShowsTheTextureTheRightWayRound) {
  Patch patch = flatPatch(Rgb(1));
  Image texture(2, 2, 3);  // v = 1 at the top: red, green / blue, black
  texture.pixel(0, 0)[0] = 1, texture.pixel(1, 0)[1] = 1, texture.pixel(0, 1)[2] = 1;
  patch.albedoTexture = std::make_shared<Image>(texture);
  const Image image = pictureOf(sceneOf(patch), fromAbove());
  EXPECT_GT(image.pixel(17, 17)[0], 2 * image.pixel(17, 17)[1]);
  EXPECT_GT(image.pixel(31, 17)[1], 2 * image.pixel(31, 17)[0]);
  EXPECT_GT(image.pixel(17, 31)[2], 2 * image.pixel(17, 31)[0]);
}

TEST(PatchPicture, CutSidesOfASolidPatchAreDarkAndClosed) {
  const PatchScene patch = sceneOf(heightField(bumps(32, 0.5f), Rgb(0.8f)));
  PatchView view = fromAbove();
  view.elevation = 0.05f;
  const Image image = pictureOf(patch, view, 64);
  // Low in the middle of the front: cut, covered, and much darker than what the light reaches above.
  int dark = 0, holes = 0;
  for (int x = 20; x < 44; ++x) {
    const float* p = image.pixel(x, 38);
    dark += p[3] == 1 && p[0] < 0.05f;
    holes += p[3] == 0;
  }
  EXPECT_GT(dark, 12);
  EXPECT_EQ(holes, 0);
}

TEST(PatchPicture, MorePeriodsShowTheSameSurfaceSmaller) {
  const PatchScene patch = sceneOf(weave({}));
  PatchView view = fromAbove();
  const Image one = pictureOf(patch, view, 96);
  view.periods = 2;
  const Image two = pictureOf(patch, view, 96);
  EXPECT_NEAR(covered(one), covered(two), 0.02);
}

TEST(PatchPicture, DoesNotDependOnThreads) {
  const PatchScene patch = sceneOf(weave({}));
  setThreadCount(1);
  const Image one = pictureOf(patch, {});
  setThreadCount(3);
  const Image three = pictureOf(patch, {});
  setThreadCount(0);
  EXPECT_EQ(one.data, three.data);
}

TEST(PatchPicture, RefusesViewsOutOfRange) {
  const PatchScene patch = sceneOf(flatPatch(Rgb(0.5f)));
  PatchView view;
  view.elevation = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(pictureOf(patch, view), ValueError);
  view = {};
  view.zoom = 0;
  EXPECT_THROW(pictureOf(patch, view), ValueError);
  EXPECT_THROW(pictureOf(patch, {}, 0), ValueError);
  Job job;
  job.cancel();
  EXPECT_THROW(patchPicture(patch, {}, 8, 8, job), Cancelled);
}

}  // namespace
}  // namespace prt
