// What each command does when all is well.

#include "libprt/core/image_io.h"
#include "libprt/core/npy.h"
#include "libprt/mesh/generate.h"
#include "libprt/mesh/repair.h"
#include "libprt/shade/tonemap.h"
#include "tests/support/off_edges.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <set>

namespace prt {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using testing::HasSubstr;

const std::vector<std::string> kCommands{"bake",    "relight", "reference", "compare", "info",
                                         "verify",  "export",  "light",     "rtt",     "synthesis",
                                         "figures", "demo",    "bench"};
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
    std::vector<std::string> words{"bake",  "builtin:torus",     "-o",    output,
                                   "--set", "mesh.detail=0.2",   "--set", "transfer.rays=64",
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
  for (const char* path :
       {"objects[].mesh.path", "objects[].material.albedo", "transfer.bounces", "lights[].rotation"})
    EXPECT_THAT(help, HasSubstr(path));
}

TEST_F(Commands, APatchIsBakedLookedAtAndExported) {
  bakeSmall("cloth.prt", {"--set", "patch.model=weave", "--set", "patch.yarns=2", "--set", "rtt.texels=8",
                          "--set", "rtt.views=3", "--set", "rtt.rays=64", "--set", "patch.warp=1,0.5,0.5"});
  const json info = prtJson({"info", "cloth.prt"});
  std::set<std::string> stages;
  for (const json& product : info["products"]) stages.insert(product["stage"].get<std::string>());
  EXPECT_TRUE(stages.contains("patch") && stages.contains("rtt"));
  prtJson({"export", "cloth.prt", "--npy", "arrays"});
  const Array rtt = readNpy(folder / "arrays/rtt.npy");
  EXPECT_EQ(rtt.shape, (std::vector<std::int64_t>{8, 8, 3, 3, 25, 3}));
  const json looked = prtJson({"rtt", "cloth.prt", "--view", "30,50", "--light", "circle:1,1,0:40:3", "-o",
                               "cloth.exr", "--zoom", "2", "--errors"});
  EXPECT_EQ(looked["errors"]["terms"][0]["terms"], 1);
  const Image picture = readImage(folder / "cloth.exr");
  EXPECT_EQ(picture.width, 16);
  EXPECT_GT(picture.rgb(8, 8).x, 0);
  // One-sided settings are left out of everything else.
  bakeSmall("plain.prt");
  EXPECT_NE(prt({"rtt", "plain.prt", "-o", "a.png"}).status, 0);
  EXPECT_THAT(prt({"rtt", "plain.prt", "-o", "a.png"}).err, HasSubstr("holds no radiance transfer texture"));
  EXPECT_EQ(prt({"rtt", "cloth.prt"}).status, 2);
  EXPECT_EQ(prt({"rtt", "cloth.prt", "-o", "a.png", "--view", "0,-10"}).status, 2);
  EXPECT_EQ(prt({"figures", "biscale-44", "-o", "f"}).status, 2);
  EXPECT_THAT(prt({"figures", "biscale-44", "-o", "f"}).err, HasSubstr("did you mean biscale-4"));
}

TEST_F(Commands, APatchAloneIsEnough) {
  const ProgramResult baked = prt({"bake", "builtin:plane", "-o", "flat.prt", "--stage", "rtt", "--set",
                                   "patch.model=flat", "--set", "rtt.texels=4", "--set", "rtt.views=2"});
  ASSERT_EQ(baked.status, 0) << baked.err;
  prtJson({"export", "flat.prt", "--npy", "arrays"});
  const Array rtt = readNpy(folder / "arrays/rtt.npy");
  EXPECT_EQ(rtt.shape, (std::vector<std::int64_t>{4, 4, 2, 2, 25}));
  EXPECT_NEAR(rtt.as<float>()[0], 0.5f * 0.282095f, 1e-5);
}

TEST_F(Commands, TheRecipePageIsUpToDate) {
  std::ifstream file(test::sourceFolder() / "docs/recipe.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const ProgramResult now = prt({"bake", "--help-all"});
  EXPECT_EQ(now.status, 0);
  EXPECT_TRUE(now.out == page) << "write it anew with ./dev docs, or prt bake --help-all > docs/recipe.md";
  for (const char* path : {"`objects[].mesh.path`", "`lights[].rotation`", "`transfer.kind`",
                           "auto, none, diffuse, visibility, matrix"})
    EXPECT_THAT(page, HasSubstr(path));
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
  for (const json& stage : again["stages"]) EXPECT_FALSE(stage["made"] && stage["name"] == "mesh");
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

TEST_F(Commands, LightIsWrittenThroughOneWindow) {
  const auto bandOne = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"light", "builtin:clear-sky", "--bands", "5"});
    const json light = prtJson(std::move(words));
    return light["coefficients"][2][1].get<double>() /
           light["coefficients"][0][1].get<double>();  // Y(1,0) against the mean
  };
  const double fejer = 2.0 / 3;  // of band 1 of 5
  EXPECT_NEAR(bandOne({"--window", "fejer"}) / bandOne({}), fejer, 0.01);
  for (const char* window : {"none", "fejer"}) {
    const double shown = bandOne({"--window", "fejer", "-o", "light.exr"});
    const json written = prtJson(
        {"light", "builtin:clear-sky", "--bands", "5", "--window", window, "-o", "light.exr"})["written"];
    EXPECT_EQ(written["window"], "fejer");
    const json back = prtJson({"light", "light.exr", "--bands", "5"});
    EXPECT_NEAR(back["coefficients"][2][1].get<double>() / back["coefficients"][0][1].get<double>() / shown,
                1, 2e-3)
        << window;
  }
  // A window that leaves negative light tells what became of it.
  const ProgramResult lanczos = prt({"light", "builtin:clear-sky", "--window", "lanczos", "-o", "light.exr"});
  EXPECT_EQ(lanczos.status, 0);
  EXPECT_THAT(lanczos.err, HasSubstr("negative"));
}

TEST_F(Commands, WhatASettingExcludesIsTold) {
  const std::vector<std::string> shadowsOnly{"--set", "transfer.kind=visibility", "--set",
                                             "transfer.bounces=2"};
  std::vector<std::string> words{"bake", "builtin:box", "-o", "a.prt", "--set", "transfer.rays=16"};
  words.insert(words.end(), shadowsOnly.begin(), shadowsOnly.end());
  const ProgramResult result = prt(words);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("the 2 bounces of transfer.bounces are left out"));
  EXPECT_EQ(result.errorLines(), 1);
  words.insert(words.end(), {"--json", "--quiet"});
  const json baked = json::parse(prt(words).out);
  EXPECT_EQ(baked["transfer"]["bounces"], 0);
  EXPECT_EQ(baked["notes"].size(), 1u);
  const json contented = prtJson({"bake", "a.prt", "--set", "transfer.bounces=0"});
  EXPECT_TRUE(contented["notes"].empty());
}

TEST_F(Commands, BakePrintsWhatToExpect) {
  bakeSmall("a.prt");
  const json baked = prtJson({"bake", "a.prt", "--set", "transfer.rays=128"});
  EXPECT_EQ(baked["transfer"]["form"], "diffuse");
  EXPECT_EQ(baked["transfer"]["rays"], 128);
  EXPECT_GT(baked["floor"]["interpolation"].get<double>() + baked["floor"]["monte_carlo"].get<double>(), 0);
  EXPECT_THAT(prt({"bake", "a.prt"}).out, HasSubstr("interpolation floor"));
}

TEST_F(Commands, RelightAgreesWithTheReference) {
  bakeSmall("a.prt", {"--set", "transfer.rays=1024", "--set", "mesh.detail=0.5"});
  const std::vector<std::string> view{"--light", "constant:1", "--size", "80x60"};
  const auto picture = [&](std::vector<std::string> words) {
    words.insert(words.end(), view.begin(), view.end());
    const ProgramResult result = prt(words);
    ASSERT_EQ(result.status, 0) << result.err;
  };
  picture({"relight", "a.prt", "-o", "relit.exr"});
  picture({"reference", "a.prt", "--spp", "256", "-o", "truth.exr"});
  EXPECT_LT(prtJson({"compare", "relit.exr", "truth.exr"})["relative_rmse"], 0.02);
}

TEST_F(Commands, LightsThatAreOffShineForNobody) {
  const std::vector<std::string> off{
      "--set", "lights[1].kind=circle", "--set", "lights[1].radiance=9",
      "--set", "lights[1].on=false",    "--set", "lights[2].path=builtin:studio",
      "--set", "lights[2].on=false"};
  bakeSmall("plain.prt");
  bakeSmall("muted.prt", off);
  bakeSmall("lit.prt", {"--set", "lights[1].kind=circle", "--set", "lights[1].radiance=9"});
  const auto picture = [&](const std::string& project, std::vector<std::string> words) {
    words.insert(words.begin() + 1, {project, "--size", "48x36", "-o", "out.exr"});
    const ProgramResult result = prt(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return readImage(folder / "out.exr").data;
  };
  for (const std::vector<std::string>& words : {std::vector<std::string>{"relight", "--background"},
                                                {"relight", "--backend", "gl"},
                                                {"reference", "--spp", "8"}}) {
    EXPECT_EQ(picture("muted.prt", words), picture("plain.prt", words)) << words[0];
    EXPECT_NE(picture("lit.prt", words), picture("plain.prt", words)) << words[0];
  }
}

TEST_F(Commands, TheSunIsMovedBySettingsAndEveryRendererSeesIt) {
  // A slope with nothing around it, the sun straight before it and aside.
  const auto bake = [&](const std::string& output, const char* azimuth) {
    bakeSmall(output,
              {"--set", "mesh=builtin:ground", "--set", "mesh.detail=1", "--set", "transform.rotate=0,0,40",
               "--set", "transfer.bounces=0", "--set", "transfer.bands=10", "--set",
               "lights[0].sunElevation=25", "--set", std::string("lights[0].sunAzimuth=") + azimuth});
  };
  bake("before.prt", "90");
  bake("aside.prt", "0");
  std::ofstream(folder / "cam.json") << R"({"eye": [0, 4, 0.1], "target": [0, 0, 0], "vfov_deg": 10})";
  const auto mean = [&](const std::string& name, std::vector<std::string> words) {
    words.insert(words.end(), {"--camera", "cam.json", "--size", "40x30", "-o", name});
    const ProgramResult result = prt(words);
    EXPECT_EQ(result.status, 0) << result.err;
    const Image image = readImage(folder / name);
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) sum += double(luminance(image.rgb(x, y)));
    return sum / double(image.pixels());
  };
  for (const std::string project : {"before", "aside"}) {
    const double cpu = mean(project + "_cpu.exr", {"relight", project + ".prt"});
    const double gl = mean(project + "_gl.exr", {"relight", project + ".prt", "--backend", "gl"});
    const double truth = mean(project + "_truth.exr", {"reference", project + ".prt", "--spp", "64"});
    EXPECT_NEAR(gl / cpu, 1, 1e-3) << project;
    EXPECT_NEAR(cpu / truth, 1, 0.03) << project << ": irradiance needs few bands";
  }
  EXPECT_GT(mean("b.exr", {"relight", "before.prt"}) / mean("a.exr", {"relight", "aside.prt"}), 1.5)
      << "it slopes towards -X";
}

TEST_F(Commands, RelightTurnsTheEnvironment) {
  bakeSmall("a.prt");
  const auto picture = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words{"relight", "a.prt", "--env", "builtin:orientation",
                                   "--size",  "32x24", "-o",    name};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(prt(words).status, 0);
    return readImage(folder / name).data;
  };
  const auto still = picture("0.exr", {});
  EXPECT_EQ(picture("360.exr", {"--rotate", "0"}), still);
  EXPECT_NE(picture("90.exr", {"--rotate", "90"}), still);
  EXPECT_EQ(picture("t1.exr", {"--threads", "1"}), picture("t3.exr", {"--threads", "3"}));
  const Image alpha = readImage(folder / "0.exr");
  EXPECT_EQ(alpha.channels, 4);
  EXPECT_EQ(alpha.pixel(0, 0)[3], 0);
  picture("b.exr", {"--background"});
  EXPECT_EQ(readImage(folder / "b.exr").pixel(0, 0)[3], 1);
}

/// Share of the pixels off edges that agree to 1/255 as a screen shows them.
double agreement(const Image& a, const Image& b, const std::vector<bool>& off) {
  const Image x = toDisplay(a, {}), y = toDisplay(b, {});
  double compared = 0, agreeing = 0;
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (!off[i]) continue;
    const Rgb d = abs(x.rgb(int(i) % x.width, int(i) / x.width) - y.rgb(int(i) % x.width, int(i) / x.width));
    ++compared;
    agreeing += std::max({d.x, d.y, d.z}) <= 1.0f / 255;
  }
  EXPECT_GT(compared, 0.5 * double(off.size()));
  return agreeing / compared;
}

TEST_F(Commands, RelightWithOpenGlMakesTheSamePicture) {
  constexpr int kWidth = 320, kHeight = 240;
  std::ofstream(folder / "cam.json")
      << R"({"eye": [1.2, 1.6, 2.4], "target": [0, 0, 0], "up": [0, 1, 0], "vfov_deg": 40})";
  Camera camera;
  camera.eye = Vec3(1.2f, 1.6f, 2.4f);
  camera.verticalFov = float(radians(40.0));
  const std::vector<bool> off = test::offEdges(makeBuiltinMesh("torus", 0.2f, 1), camera, kWidth, kHeight);
  const std::vector<std::string> glossy{"--set", "material.model=phong", "--set", "material.specular=0.3",
                                        "--set", "material.exponent=30"};
  const std::vector<std::vector<std::string>> materials{{}, glossy};
  for (const auto& material : materials) {
    bakeSmall("a.prt", material);
    for (const char* backend : {"cpu", "gl"})
      ASSERT_EQ(prt({"relight", "a.prt", "--backend", backend, "--camera", "cam.json", "--size", "320x240",
                     "--background", "-o", std::string(backend) + ".exr"})
                    .status,
                0);
    EXPECT_GE(agreement(readImage(folder / "gl.exr"), readImage(folder / "cpu.exr"), off), 0.999)
        << material.size();
  }
}

/// A sheet bent like a gutter: each vertex has a sample on either side.
TEST_F(Commands, TwoSidedSurfacesAreLitFromBothSides) {
  constexpr int kSide = 17, kVertices = kSide * kSide;
  std::ofstream obj(folder / "sheet.obj");
  const auto at = [](int i) { return 2.0 * i / (kSide - 1) - 1; };
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      obj << "v " << at(i) << " " << 0.6 * at(i) * at(i) << " " << at(j) << "\n";
  for (int j = 0; j + 1 < kSide; ++j)
    for (int i = 0; i + 1 < kSide; ++i) {
      const int a = 1 + j * kSide + i;
      obj << "f " << a << " " << a + kSide << " " << a + kSide + 1 << " " << a + 1 << "\n";
    }
  obj.close();
  constexpr int kWidth = 120, kHeight = 90;
  Job job;
  const std::map<std::string, Camera> cameras{{"above", {.eye = {1, 3, 2}}}, {"below", {.eye = {1, -3, 2}}}};
  for (const auto& [name, camera] : cameras)
    std::ofstream(folder / (name + ".json")) << json{{"eye", {camera.eye.x, camera.eye.y, camera.eye.z}},
                                                     {"target", {0, 0, 0}},
                                                     {"up", {0, 1, 0}},
                                                     {"vfov_deg", 30}};
  const auto picture = [&](std::vector<std::string> words, const std::string& camera,
                           const std::string& name) {
    words.insert(words.end(), {"a.prt", "--light", "constant:1", "--light", "circle:1,-1,0.5:60:2,1,1",
                               "--camera", camera + ".json", "--size", "120x90", "-o", name});
    const ProgramResult result = prt(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return readImage(folder / name);
  };
  const std::vector<std::string> common{"bake",  "sheet.obj",
                                        "-o",    "a.prt",
                                        "--set", "transfer.bounces=1",
                                        "--set", "material.albedo=0.8,0.5,0.3",
                                        "--set", "mesh.orientation=keep"};
  const auto bake = [&](const std::string& twoSided, const std::string& model) {
    std::vector<std::string> words = common;
    words.insert(words.end(), {"--set", "material.twoSided=" + twoSided, "--set", "material.model=" + model,
                               "--set", "material.exponent=10", "--set",
                               "material.specular=" + std::string(model == "phong" ? "0.3" : "0")});
    return prtJson(words);
  };
  for (const char* model : {"lambert", "phong"}) {
    const json baked = bake("true", model);
    EXPECT_EQ(baked["objects"][0]["vertices"], kVertices);
    EXPECT_EQ(baked["transfer"]["samples"], 2 * kVertices);
    EXPECT_GT(baked["floor"]["monte_carlo"], 0);
    EXPECT_LT(baked["floor"]["total"], 0.02);
    for (const auto& [name, camera] : cameras) {
      const Image cpu = picture({"relight"}, name, "cpu.exr");
      EXPECT_GT(cpu.rgb(kWidth / 2, kHeight / 2).x, 0.1f) << model << " from " << name;
      const std::vector<bool> off = test::offEdges(
          loadMesh(folder / "sheet.obj", {.orientation = Orientation::keep}, job), camera, kWidth, kHeight);
      EXPECT_GE(agreement(cpu, picture({"relight", "--backend", "gl"}, name, "gl.exr"), off), 0.999)
          << model << " from " << name;
      if (std::string(model) == "phong") continue;  // lights of few bands have no sharp highlights to compare
      picture({"reference", "--spp", "256"}, name, "truth.exr");
      EXPECT_LT(prtJson({"compare", "cpu.exr", "truth.exr"})["percentile95"], 0.03) << name;
    }
    const json written = prtJson({"export", "a.prt", "--npy", "npy", "--gltf", "gltf"});
    const json manifest = json::parse(std::ifstream(folder / "npy/manifest.json"));
    EXPECT_EQ(manifest["vertices"], kVertices);
    EXPECT_EQ(manifest["samples"], 2 * kVertices) << "of which the vertices' fronts are exported";
    EXPECT_EQ(readNpy(folder / "npy/transfer_diffuse.npy").shape[0], kVertices);
  }
  EXPECT_EQ(bake("false", "lambert")["transfer"]["samples"], kVertices);
  EXPECT_EQ(picture({"relight"}, "below", "dark.exr").rgb(kWidth / 2, kHeight / 2).x, 0)
      << "the back of a one-sided sheet";
}

TEST_F(Commands, CamerasComeFromFilesAndNames) {
  std::ofstream(folder / "r.json")
      << R"({"mesh": "builtin:box", "cameras": [{"name": "side", "eye": [4, 0, 0]}], "transfer": {"rays": 16}})";
  ASSERT_EQ(prt({"bake", "r.json", "-o", "a.prt"}).status, 0);
  std::ofstream(folder / "cam.json")
      << R"({"eye": [4, 0, 0], "target": [0, 0, 0], "up": [0, 1, 0], "vfov_deg": 30})";
  for (const char* camera : {"side", "cam.json"})
    ASSERT_EQ(
        prt({"relight", "a.prt", "--camera", camera, "--size", "32x24", "-o", std::string(camera) + ".exr"})
            .status,
        0);
  EXPECT_EQ(readImage(folder / "side.exr").data, readImage(folder / "cam.json.exr").data);
}

TEST_F(Commands, ExportWritesWhatTheManifestSays) {
  bakeSmall("a.prt", {"--set", "transfer.kind=matrix", "--set", "material.albedo=0.8,0.4,0.2"});
  prtJson({"export", "a.prt", "--npy", "npy", "--exr", "exr", "--gltf", "gltf"});
  const auto manifestOf = [&](const std::string& kind) {
    const json manifest = json::parse(std::ifstream(folder / (kind + "/manifest.json")));
    for (const auto& [file, entry] : manifest["files"].items())
      EXPECT_TRUE(fs::exists(folder / (kind + "/" + file))) << file;
    return manifest;
  };
  const json npy = manifestOf("npy");
  const auto vertices = npy["vertices"].get<std::int64_t>(), faces = npy["faces"].get<std::int64_t>();
  const std::map<std::string, std::vector<std::int64_t>> shapes{
      {"positions", {vertices, 3}},        {"normals", {vertices, 3}},
      {"tangents", {vertices, 3}},         {"faces", {faces, 3}},
      {"transfer", {vertices, 25, 25, 3}}, {"transfer_diffuse", {vertices, 25, 3}}};
  for (const auto& [name, shape] : shapes) {
    const Array array = readNpy(folder / ("npy/" + name + ".npy"));
    EXPECT_EQ(array.shape, shape) << name;
    EXPECT_EQ(npy["files"][name + ".npy"]["shape"], shape);
  }
  EXPECT_GT(readImage(folder / "exr/light_bands.exr").width, 0);
  manifestOf("exr");
  manifestOf("gltf");
  Job job;
  EXPECT_EQ(loadMesh(folder / "gltf/scene.glb", {}, job).triangleCount(), std::size_t(faces));
}

TEST_F(Commands, DemoLeavesAPageThatNeedsNothingElse) {
  const json demo = prtJson({"demo", "-o", "d", "--scene", "default", "--frames", "2", "--size", "48x36",
                             "--set", "transfer.rays=32", "--set", "objects[0].mesh.detail=0.3", "--set",
                             "objects[1].mesh.detail=0.3"});
  std::ifstream file(folder / "d/index.html");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  for (const char* outside : {"http://", "https://", "<link", "@import"})
    EXPECT_THAT(page, testing::Not(HasSubstr(outside)));
  EXPECT_EQ(readImage(folder / "d/default_180.png").width, 48);
  EXPECT_TRUE(demo["scenes"].contains("default"));
}

TEST_F(Commands, ReferenceIsTheSamePictureForTheSameSeed) {
  bakeSmall("a.prt");
  const auto picture = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words{
        "reference", "a.prt", "--env", "builtin:overcast", "--size", "40x30", "--spp", "4", "-o", name};
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
    ASSERT_EQ(prt({"reference", "a.prt", "--light", "constant:1", "--size", "64x48", "--spp", "16", "--seed",
                   seed, "-o", std::string(seed) + ".exr"})
                  .status,
              0);
  const json same = prtJson({"compare", "1.exr", "1.exr"});
  EXPECT_EQ(same["rmse"], 0);
  EXPECT_EQ(same["flip"], 0);
  const json other =
      prtJson({"compare", "1.exr", "2.exr", "--second-reference", "3.exr", "--heatmap", "heat.png"});
  EXPECT_GT(other["relative_rmse"], 0);
  EXPECT_GE(other["max"], other["rmse"]);
  EXPECT_TRUE(other.contains("noise_free"));
  EXPECT_EQ(readImage(folder / "heat.png").width, 64);
}

}  // namespace
}  // namespace prt
