// What each command does when all is well.

#include "libprt/core/image_io.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace prt {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using testing::HasSubstr;

const std::vector<std::string> kCommands{"bake", "reference", "compare", "info", "verify", "light"};
const std::set<std::string> kStored{"mesh", "direct", "transfer"};

class Commands : public testing::Test {
 protected:
  ProgramResult prt(std::vector<std::string> words) {
    words.insert(words.begin(), "prt");
    return test::run(words, folder.path());
  }
  json prtJson(std::vector<std::string> words) {
    words.push_back("--json");
    const ProgramResult result = prt(std::move(words));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return json::parse(result.out, nullptr, false);
  }
  /// A project that is quick to bake.
  void bakeSmall(const std::string& output, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"bake", "builtin:torus", "-o", output, "--set", "mesh.detail=0.2", "--set", "transfer.rays=64",
                                   "--set", "transfer.bounces=1"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = prt(words);
    ASSERT_EQ(result.status, 0) << result.err;
  }

  test::TemporaryFolder folder;
};

TEST_F(Commands, HelpShowsAnExample) {
  for (const std::string& command : kCommands) {
    const ProgramResult result = prt({command, "--help"});
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.out, HasSubstr("Example")) << command;
    EXPECT_THAT(result.out, HasSubstr("prt " + command)) << command;
    EXPECT_EQ(result.err, "");
  }
  const ProgramResult all = prt({"--help"});
  for (const std::string& command : kCommands) EXPECT_THAT(all.out, HasSubstr("\n  " + command));
}

TEST_F(Commands, BakeListsEverySetting) {
  const std::string help = prt({"bake", "--help"}).out;
  for (const char* path : {"objects[].mesh.path", "objects[].material.albedo", "transfer.bounces", "lights[].rotation"})
    EXPECT_THAT(help, HasSubstr(path));
}

TEST_F(Commands, NothingIsPrintedWhenQuiet) {
  const ProgramResult result = prt({"bake", "builtin:box", "-o", "a.prt", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Commands, NoProgressBarWhenPiped) {
  const ProgramResult result = prt({"bake", "builtin:box", "-o", "a.prt"});
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out.find('\r'), std::string::npos);
}

TEST_F(Commands, BakeInfoAndVerifyAgree) {
  bakeSmall("a.prt");
  const json info = prtJson({"info", "a.prt"});
  EXPECT_EQ(info["recipe"]["objects"][0]["mesh"]["detail"], 0.2);
  const json verified = prtJson({"verify", "a.prt"});
  EXPECT_TRUE(verified["sound"]);
  EXPECT_EQ(verified["products"], info["products"].size());
  EXPECT_FALSE(fs::exists(folder / "a.prt.work"));
}

TEST_F(Commands, BakingAgainDoesNothing) {
  bakeSmall("a.prt");
  const auto before = fs::last_write_time(folder / "a.prt");
  const json again = prtJson({"bake", "a.prt"});
  for (const json& stage : again["stages"])
    EXPECT_FALSE(stage["made"] && kStored.contains(stage["name"].get<std::string>())) << stage;
  EXPECT_EQ(fs::last_write_time(folder / "a.prt"), before);
}

TEST_F(Commands, RecipesAndProjectsMoveBetweenFolders) {
  fs::create_directories(folder / "in/meshes");
  fs::create_directories(folder / "out");
  std::ofstream(folder / "in/meshes/t.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder / "in/r.json") << R"({"mesh": "meshes/t.obj", "transfer": {"rays": 16}})";
  ASSERT_EQ(prt({"bake", "in/r.json", "-o", "out/a.prt"}).status, 0);
  EXPECT_EQ(prtJson({"info", "out/a.prt"})["recipe"]["objects"][0]["mesh"]["path"], "../in/meshes/t.obj");
  // The source may go: the project has what it needs.
  fs::remove_all(folder / "in");
  const json again = prtJson({"bake", "out/a.prt", "-o", "b.prt", "--set", "material.albedo=0.1"});
  for (const json& stage : again["stages"])
    EXPECT_FALSE(stage["made"] && stage["name"] == "mesh");
}

TEST_F(Commands, LightPrintsEnergyAndTruncation) {
  const json light = prtJson({"light", "builtin:overcast", "--bands", "4", "-o", "band.exr"});
  EXPECT_EQ(light["coefficients"].size(), 16u);
  EXPECT_EQ(light["truncation_error"].size(), 4u);
  EXPECT_GT(light["energy"], 0);
  // What it wrote is that light: the same coefficients but for the window.
  const json band = prtJson({"light", "band.exr", "--bands", "4"});
  EXPECT_NEAR(band["coefficients"][0][0], light["coefficients"][0][0], 1e-3);
  EXPECT_LT(band["truncation_error"][3], 0.02);
}

TEST_F(Commands, ReferenceIsTheSamePictureForTheSameSeed) {
  bakeSmall("a.prt");
  const auto picture = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words{"reference", "a.prt", "--env", "builtin:overcast", "--size", "40x30", "--spp", "4", "-o", name};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = prt(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return readImage(folder / name).data;
  };
  const auto one = picture("1.exr", {"--threads", "1"});
  EXPECT_EQ(one, picture("2.exr", {"--threads", "3"}));
  EXPECT_NE(one, picture("3.exr", {"--seed", "2"}));
}

TEST_F(Commands, CompareMeasuresAndPaints) {
  bakeSmall("a.prt");
  for (const char* seed : {"1", "2", "3"})
    ASSERT_EQ(prt({"reference", "a.prt", "--light", "constant:1", "--size", "64x48", "--spp", "16", "--seed", seed, "-o", std::string(seed) + ".exr"}).status, 0);
  const json same = prtJson({"compare", "1.exr", "1.exr"});
  EXPECT_EQ(same["rmse"], 0);
  EXPECT_EQ(same["flip"], 0);
  const json other = prtJson({"compare", "1.exr", "2.exr", "--second-reference", "3.exr", "--heatmap", "heat.png"});
  EXPECT_GT(other["relative_rmse"], 0);
  EXPECT_GE(other["max"], other["rmse"]);
  EXPECT_TRUE(other.contains("noise_free"));
  EXPECT_EQ(readImage(folder / "heat.png").width, 64);
}

}  // namespace
}  // namespace prt
