#include "libprt/light/environment_io.h"
#include "libprt/core/error.h"
#include "libprt/core/image_io.h"
#include "libprt/core/sampling.h"
#include "libprt/light/projection.h"
#include "libprt/light/resample.h"
#include "tests/light/light_test_support.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstring>

namespace prt {
namespace {

using M = EnvironmentMapping;

TEST(EnvironmentIo, ReadsWhatWasWritten) {
  const test::TemporaryFolder folder;
  for (const MapGeometry& g : test::oneOfEach(8)) {
    const EnvironmentMap map = test::randomMap(g, 41, 1000);
    for (const std::string name : {"map.exr", "map.hdr"}) {
      writeImage(folder / name, map.pixels());
      const EnvironmentMap back = loadEnvironment(folder / name);
      EXPECT_EQ(back.report().mapping, g.mapping());
      EXPECT_EQ(back.report().source, (folder / name).string());
      // shared exponents keep 8 bits of the brightest channel
      const float bound = name == "map.exr" ? 0 : 1 / 128.0f;
      map.forEachTexel([&](int x, int y, const DVec3&, double, const Rgb& c) {
        EXPECT_LE(length(back.pixels().rgb(x, y) - c), bound * length(c));
      });
    }
  }
}

TEST(EnvironmentIo, TheUserMayNameTheMapping) {
  const test::TemporaryFolder folder;
  const EnvironmentMap map = test::randomMap(MapGeometry(M::LatLong, 30, 20), 42);
  writeImage(folder / "odd.exr", map.pixels());
  EXPECT_THROW(loadEnvironment(folder / "odd.exr"), FileError);
  EXPECT_EQ(loadEnvironment(folder / "odd.exr", M::LatLong).pixels().data, map.pixels().data);
  EXPECT_THROW(loadEnvironment(folder / "odd.exr", M::VerticalCross), FileError);
}

TEST(EnvironmentIo, ErrorsNameTheFileAndWhatWouldFit) {
  const test::TemporaryFolder folder;
  writeImage(folder / "photo.png", Image(50, 20, 3));
  try {
    loadEnvironment(folder / "photo.png");
    FAIL();
  } catch (const FileError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("photo.png"), std::string::npos);
    EXPECT_NE(text.find("50 x 20"), std::string::npos);
    EXPECT_NE(text.find("2:1"), std::string::npos);
  }
  EXPECT_THROW(loadEnvironment(folder / "missing.hdr"), FileError);
}

// --- Probes that people use ------------------------------------------------------------------------

struct Probe {
  std::string file;
  M mapping;
  int width, height;
  std::size_t negative;
  bool label;
  bool upright;  ///< more light from above than from below
};

std::vector<Probe> probes() {
  return {{"brown_photostudio_02_1k.hdr", M::LatLong, 1024, 512, 0, false, true},
          {"drachenfels_cellar_1k.hdr", M::LatLong, 1024, 512, 0, false, true},
          {"grace_latlong.exr", M::LatLong, 1024, 512, 0, false, false},
          {"kloppenheim_05_1k.hdr", M::LatLong, 1024, 512, 0, false, true},
          {"modern_buildings_2_1k.hdr", M::LatLong, 1024, 512, 0, false, true},
          {"night.exr", M::LatLong, 1024, 512, 596, false, true},
          {"rnl_probe.hdr", M::AngularMap, 900, 900, 0, true, true},
          {"stpeters_cross.hdr", M::VerticalCross, 768, 1024, 0, true, true},
          {"studio.exr", M::LatLong, 1024, 512, 3, false, true},
          {"uffizi_256.hdr", M::LatLong, 256, 128, 0, false, true}};
}

TEST(Probes, AreRecognisedMaskedAndMended) {
  PRT_NEEDS_SHARED_DATA();
  for (const Probe& probe : probes()) {
    const EnvironmentMap map = loadEnvironment(test::sharedData("probes/" + probe.file));
    const EnvironmentReport& report = map.report();
    EXPECT_EQ(report.mapping, probe.mapping) << probe.file;
    EXPECT_EQ(report.width, probe.width) << probe.file;
    EXPECT_EQ(report.height, probe.height) << probe.file;
    EXPECT_EQ(report.negative, probe.negative) << probe.file;
    EXPECT_EQ(report.nonFinite, 0u) << probe.file;
    EXPECT_EQ(report.labels > 500, probe.label) << probe.file << ": " << report.labels;
    for (const float value : map.pixels().data) ASSERT_GE(value, 0) << probe.file;
    double above = 0, below = 0;
    map.forEachTexel([&](int, int, const DVec3& d, double solidAngle, const Rgb& c) {
      (d.y > 0 ? above : below) += solidAngle * luminance(c);
    });
    EXPECT_EQ(above > below, probe.upright) << probe.file;
  }
}

TEST(Probes, ProjectionKeepsTheEnergyOfEveryProbe) {
  PRT_NEEDS_SHARED_DATA();
  for (const Probe& probe : probes()) {
    const EnvironmentMap map = loadEnvironment(test::sharedData("probes/" + probe.file));
    const DVec3 exact = test::energy(map);
    EXPECT_LT(length(DVec3(projectEnvironment(map, 5).c[0]) * std::sqrt(4 * kPi) / exact - DVec3(1)), 1e-6)
        << probe.file;
    EXPECT_LT(length(test::energy(toLatLong(map, 400, 200)) / exact - DVec3(1)), 1e-5) << probe.file;
  }
}

TEST(Probes, TheSunsHoldHalfOfThePower) {
  PRT_NEEDS_SHARED_DATA();
  for (const std::string file : {"kloppenheim_05_1k.hdr", "modern_buildings_2_1k.hdr"}) {
    const EnvironmentMap map = loadEnvironment(test::sharedData("probes/" + file));
    double sun = 0, all = 0, area = 0;
    map.forEachTexel([&](int, int, const DVec3&, double solidAngle, const Rgb& c) {
      all += solidAngle * luminance(c);
      if (luminance(c) > 5000) sun += solidAngle * luminance(c), area += solidAngle;
    });
    EXPECT_GT(sun / all, 0.45) << file;
    EXPECT_LT(area, 3e-4) << file;
    EXPECT_GT(bandSpectrum(map, projectEnvironment(map, 5)).truncation[4], 0.99)
        << "five bands hold next to nothing of it";
  }
}

// --- Any pixels; any bytes: tests/fuzz/environment_fuzz.cpp ---------------------------------------------

TEST(EnvironmentIo, AnyFloatsMakeAUsableMap) {
  // bit patterns as they come: denormals, NaNs, infinities, negative zero
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    for (const MapGeometry& g : test::oneOfEach(3)) {
      Image image(g.width(), g.height(), 3);
      for (std::size_t i = 0; i < image.data.size(); ++i) {
        const std::uint32_t bits = std::uint32_t(hashBits(seed, i));
        std::memcpy(&image.data[i], &bits, sizeof bits);
      }
      const EnvironmentMap map(image, g.mapping());
      for (const float value : map.pixels().data) ASSERT_TRUE(value >= 0 && value <= kMaxRadiance);
      for (const Rgb& c : projectEnvironment(map, 3).c) ASSERT_TRUE(isFinite(c));
      const EnvironmentMap resampled = toLatLong(map, 10, 5);
      for (const float value : resampled.pixels().data) ASSERT_TRUE(std::isfinite(value));
      detectMapping(image);
    }
}

}  // namespace
}  // namespace prt
