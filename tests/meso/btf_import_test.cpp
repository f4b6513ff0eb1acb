#include "libprt/meso/btf_import.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/core/image_io.h"
#include "libprt/meso/btf_render.h"
#include "tests/meso/meso_support.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace prt {
namespace {

using namespace test;
namespace fs = std::filesystem;

Patch sample() {
  return heightField(bumps(32, 0.08f), Rgb(0.8f, 0.5f, 0.3f));
}

RttSettings settings() {
  RttSettings s = small(8, 4, 512, 1);
  s.supersamples = 4;
  return s;
}

/// Rings as Bonn's sets have them.
std::vector<Vec3> rings(std::initializer_list<std::pair<double, int>> list) {
  std::vector<Vec3> directions;
  for (const auto& [theta, count] : list)
    for (int i = 0; i < count; ++i) {
      const double t = radians(theta), p = 2 * kPi * i / count;
      directions.emplace_back(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
    }
  return directions;
}

TEST(BtfImport, OwnImagesComeBack) {
  const TemporaryFolder folder;
  const PatchScene patch = sceneOf(sample());
  Job job;
  const LightSet lights = lightGrid();
  BtfWriter writer(folder / "btf", lights);
  renderBtf(patch, settings(), lights, job, [&](const BtfView& view) { writer.add(view, job); });
  EXPECT_EQ(writer.finish(), 16u * 128u);
  const BtfSet set = openBtf(folder / "btf");
  EXPECT_EQ(set.images.size(), 2048u);
  EXPECT_EQ(groupByView(set).size(), 16u);
  const Rtt imported = importBtf(set, {8, 4, 5}, job);
  const Rtt fitted = bakeRttByImages(patch, settings(), lights, LightFit::Fit, job);
  EXPECT_LT(relativeDifference(imported, fitted), 2e-3);  // cells of the lights found by nearest neighbours
  EXPECT_LT(relativeDifference(imported, bakeRtt(patch, settings(), job)), 0.02);
}

/// Exports pictures at Bonn's directions under Bonn's names.
void writeBonn(const fs::path& folder, const PatchScene& patch, const RttSettings& s,
               std::span<const Vec3> directions, const std::string& extension) {
  fs::create_directories(folder);
  Job job;
  renderBtf(patch, s, lightsAt(directions), directions, job, [&](const BtfView& view) {
    for (std::size_t l = 0; l < directions.size(); ++l) {
      const auto angle = [](const Vec3& d) {
        const double phi = degrees(std::atan2(double(d.y), double(d.x)));
        return std::pair(degrees(std::acos(std::min(1.0, double(d.z)))),
                         phi < -1e-6 ? phi + 360 : std::abs(phi));
      };
      const auto [tl, pl] = angle(directions[l]);
      const auto [tv, pv] = angle(view.direction);
      char name[128];
      std::snprintf(name, sizeof name, "%05zu_tl%03.0f_pl%05.1f_tv%03.0f_pv%05.1f%s", l, tl, pl, tv, pv,
                    extension.c_str());
      writeImage(folder / name, view.picture(l));
    }
  });
}

TEST(BtfImport, BonnStyleRingsAreFittedAndResampled) {
  const TemporaryFolder folder;
  const PatchScene patch = sceneOf(sample());
  const std::vector<Vec3> directions = rings({{0, 1}, {25, 6}, {50, 12}, {75, 16}});  // Bonn has 81
  writeBonn(folder / "set", patch, settings(), directions, ".exr");
  const BtfSet set = openBtf(folder / "set");
  EXPECT_EQ(set.images.size(), 35u * 35u);
  Job job;
  const Rtt imported = importBtf(set, {8, 4, 5}, job), fast = bakeRtt(patch, settings(), job);
  EXPECT_LT(relativeDifference(imported, fast), 0.035);
}

TEST(BtfImport, SparsePairsAreFittedAsAWhole) {
  // CUReT style: 205 pairs of light and view, most views under one to four lights.
  const TemporaryFolder folder;
  const PatchScene patch = sceneOf(sample());
  const std::vector<Vec3> views = rings({{10, 4}, {30, 12}, {50, 18}, {70, 21}}),
                          lights = rings({{5, 3}, {25, 9}, {45, 15}, {65, 22}});
  Job job;
  std::size_t next = 0;
  nlohmann::json images = nlohmann::json::array();
  renderBtf(patch, settings(), lightsAt(lights), views, job, [&](const BtfView& view) {
    for (int k = 0; k < 4; ++k, next = (next + 17) % lights.size()) {
      const std::string name = std::to_string(images.size()) + ".exr";
      writeImage(folder / name, view.picture(next));
      const auto json = [](const Vec3& d) { return nlohmann::json{d.x, d.y, d.z}; };
      images.push_back({{"file", name}, {"light", json(lights[next])}, {"view", json(view.direction)}});
    }
  });
  writeFile(folder / "manifest.json", nlohmann::json{{"format", "prt-btf"}, {"images", images}}.dump());
  const Rtt imported = importBtf(openBtf(folder / "manifest.json"), {8, 4, 5}, job),
            fast = bakeRtt(patch, settings(), job);
  EXPECT_LT(relativeDifference(imported, fast), 0.10);  // 220 numbers for 400
  // The mean over the patch, whose response is smooth, is met much better.
  EXPECT_NEAR(mean(underWhiteSky(imported, 5)), mean(underWhiteSky(fast, 5)),
              0.02 * mean(underWhiteSky(fast, 5)));
}

TEST(BtfImport, EncodingsAreUndone) {
  const TemporaryFolder folder;
  Image image(2, 2, 3);
  for (float& x : image.data) x = 0.25f;
  writeImage(folder / "a.exr", image);
  ImageWriteOptions as16;
  as16.png16 = true;
  writeImage(folder / "b.png", image, as16);  // sRGB
  Image raw = image;                          // the file's numbers are 0.25 ^ (1 / 2.2)
  for (float& x : raw.data) x = std::pow(0.25f, 1 / 2.2f);
  ImageWriteOptions asIs = as16;
  asIs.alreadySrgb = true;
  writeImage(folder / "c.png", raw, asIs);
  writeImage(folder / "d.png", image, asIs);  // linear numbers
  const auto level = [&](const std::string& file, const std::string& encoding) {
    const std::string text = R"({"format": "prt-btf", )" + encoding + R"("images": [{"file": ")" + file +
                             R"(", "light": [0, 0, 1], "view": {"theta": 0, "phi": 0}}]})";
    writeFile(folder / "manifest.json", text);
    Job job;
    return importBtf(openBtf(folder / "manifest.json"), {1, 1, 1}, job).values[0];
  };
  const float linear = level("a.exr", "");
  EXPECT_GT(linear, 0);
  EXPECT_NEAR(level("a.exr", R"("encoding": "linear", )"), linear, 1e-6);
  EXPECT_NEAR(level("b.png", ""), linear, 1e-3 * linear);
  EXPECT_NEAR(level("b.png", R"("encoding": "srgb", )"), linear, 1e-3 * linear);
  EXPECT_NEAR(level("c.png", R"("encoding": 2.2, )"), linear, 1e-3 * linear);
  EXPECT_NEAR(level("d.png", R"("encoding": "linear", )"), linear, 1e-3 * linear);
  EXPECT_NEAR(level("a.exr", R"("scale": 2, )"), 2 * linear, 1e-5);
}

TEST(BtfImport, ViewsAreExactWhereMeasured) {
  const ViewSquare square(4);
  std::vector<Vec3> measured;
  for (int i = 0; i < 16; ++i) measured.push_back(square.centre(i));
  const std::vector<double> weights = viewWeights(measured, square);
  for (std::size_t cell = 0; cell < 16; ++cell)
    for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(weights[cell * 16 + i], cell == i ? 1 : 0, 1e-6);
  const std::vector<double> one = viewWeights(std::span(measured).first(1), square);
  for (const double w : one) EXPECT_NEAR(w, 1, 1e-9);
}

TEST(BtfImport, ComplaintsNameTheEntryAndWhatToDo) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      parseBtfManifest(text, "m.json");
    } catch (const FileError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string head = R"({"format": "prt-btf", "images": [)";
  const std::string good = R"({"file": "a.exr", "light": [0,0,1], "view": [0,0,1]})";
  EXPECT_EQ(complaint(head + good + "]}"), "accepted");
  for (const auto& [text, part] : std::initializer_list<std::pair<std::string, std::string>>{
           {"{", "not a JSON object"},
           {"[]", "not a JSON object"},
           {"{}", "not a BTF's manifest"},
           {R"({"format": "prt-btf"})", "lists no 'images'"},
           {head + "]}", "lists no 'images'"},
           {head + good + ", 3]}", "images[1]: is not an object"},
           {head + R"({"light": [0,0,1], "view": [0,0,1]}]})", "has no 'file'"},
           {head + R"({"file": "../a.exr", "light": [0,0,1], "view": [0,0,1]}]})", "not beside the manifest"},
           {head + R"({"file": "/a.exr", "light": [0,0,1], "view": [0,0,1]}]})", "not beside the manifest"},
           {head + R"({"file": "a.exr", "view": [0,0,1]}]})", "has no 'light'"},
           {head + R"({"file": "a.exr", "light": [0,0,0], "view": [0,0,1]}]})", "has no direction"},
           {head + R"({"file": "a.exr", "light": [0,0,"1"], "view": [0,0,1]}]})", "is not a number"},
           {head + R"({"file": "a.exr", "light": [0,0,-1], "view": [0,0,1]}]})", "not above the sample"},
           {head + R"({"file": "a.exr", "light": {"theta": 95, "phi": 0}, "view": [0,0,1]}]})",
            "not above the sample"},
           {R"({"format": "prt-btf", "encoding": "cmyk", "images": [)" + good + "]}",
            "'encoding' is unknown"},
           {R"({"format": "prt-btf", "scale": -1, "images": [)" + good + "]}", "'scale' is not"}}) {
    const std::string message = complaint(text);
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("m.json"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  const TemporaryFolder folder;
  EXPECT_THROW(openBtf(folder / "nothing.json"), FileError);
  EXPECT_THROW(openBtf(folder / "."), FileError);
  writeFile(folder / "manifest.json", head + good + "]}");
  Job job;
  EXPECT_THROW(importBtf(openBtf(folder / "manifest.json"), {4, 2, 5}, job), FileError);  // a.exr is missing
}

}  // namespace
}  // namespace prt
