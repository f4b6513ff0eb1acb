// The hand-over: what docs/handover draws from exported files is what prt relight draws from the project.

#include "libprt/core/image_io.h"
#include "libprt/core/npy.h"
#include "libprt/shade/tonemap.h"
#include "tests/support/off_edges.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <fstream>

namespace prt {
namespace {

using nlohmann::json;

constexpr int kWidth = 320, kHeight = 200;
constexpr const char* kSize = "320x200";

class Handover : public testing::Test {
 protected:
  void prt(std::vector<std::string> words) {
    words.insert(words.begin(), "prt");
    const test::ProgramResult result = test::run(words, folder.path());
    ASSERT_EQ(result.status, 0) << result.err;
  }
  test::ProgramResult handover(std::vector<std::string> words) {
    words.insert(words.begin(), HANDOVER_PROGRAM);
    return test::run(words, folder.path());
  }
  /// A vase on a ground, baked and exported. `glossy` adds a lobe to the ground.
  void bakeAndExport(bool glossy, std::vector<std::string> settings = {}) {
    json scene = {
        {"objects",
         {{{"name", "vase"},
           {"mesh", {{"path", "builtin:vase"}, {"detail", 0.4}}},
           {"material", {{"albedo", {0.72, 0.38, 0.25}}}}},
          {{"name", "ground"},
           {"mesh", {{"path", "builtin:ground"}, {"detail", 0.5}}},
           {"material", {{"albedo", {0.3, 0.35, 0.4}}}}}}},
        {"cameras",
         {{{"name", "far"}, {"eye", {4, 4, 4}}},
          {{"name", "main"}, {"eye", {1.5, 1.75, 2.2}}, {"target", {-0.05, 0.42, 0}}, {"vfov_deg", 28}}}},
        {"transfer", {{"rays", 128}, {"bounces", 1}}}};
    if (glossy) {
      json& material = scene["objects"][1]["material"];
      material["model"] = "phong";
      material["specular"] = {0.5, 0.45, 0.4};
      material["exponent"] = 30;
    }
    std::ofstream(folder / "scene.json") << scene.dump();
    std::vector<std::string> bake{"bake", "scene.json", "-o", "a.prt"};
    for (const std::string& setting : settings) bake.insert(bake.end(), {"--set", setting});
    prt(bake);
    prt({"export", "a.prt", "--gltf", "gltf", "--npy", "npy"});
  }
  Image ppm(const std::string& name) {
    std::ifstream in(folder / name, std::ios::binary);
    std::string magic;
    int width = 0, height = 0, most = 0;
    in >> magic >> width >> height >> most;
    in.get();
    Image image(width, height, 3);
    for (float& v : image.data) v = float(in.get()) / 255;
    return image;
  }
  std::vector<bool> insides() {
    const json manifest = json::parse(std::ifstream(folder / "npy/manifest.json"));
    const Array positions = readNpy(folder / "npy/positions.npy"), faces = readNpy(folder / "npy/faces.npy"),
                object = readNpy(folder / "npy/object.npy");
    TriMesh mesh;
    mesh.positions.resize(std::size_t(positions.shape[0]));
    std::memcpy(mesh.positions.data(), positions.bytes.data(), positions.bytes.size());
    mesh.triangles.resize(std::size_t(faces.shape[0]));
    std::memcpy(mesh.triangles.data(), faces.bytes.data(), faces.bytes.size());
    std::vector<std::uint32_t> objects;
    for (const UVec3& t : mesh.triangles)
      objects.push_back(std::uint32_t(reinterpret_cast<const std::int32_t*>(object.bytes.data())[t.x]));
    Camera camera;
    for (const json& c : manifest["cameras"]) {
      if (c["name"] != "main") continue;
      const auto vector = [](const json& v) { return Vec3(v[0], v[1], v[2]); };
      camera = {vector(c["eye"]), vector(c["target"]), vector(c["up"]),
                float(radians(c["vfov_deg"].get<double>()))};
    }
    return test::offEdges(mesh, objects, camera, kWidth, kHeight);
  }
  /// Both at 8 bits: one step apart at most on 99.9 % of the pixels off edges.
  void expectSamePicture(std::vector<std::string> light = {}, std::vector<std::string> lamp = {}) {
    std::vector<std::string> relight{"relight", "a.prt", "--camera", "main",
                                     "--size",  kSize,   "-o",       "truth.exr"};
    relight.insert(relight.end(), light.begin(), light.end());
    prt(relight);
    std::vector<std::string> sample{"gltf", "npy", "sample.ppm", "--camera", "main", "--size", kSize};
    sample.insert(sample.end(), lamp.begin(), lamp.end());
    const test::ProgramResult result = handover(sample);
    ASSERT_EQ(result.status, 0) << result.err;
    const Image truth = toDisplay(readImage(folder / "truth.exr"), {}), picture = ppm("sample.ppm");
    ASSERT_EQ(picture.width, truth.width);
    ASSERT_EQ(picture.height, truth.height);
    const std::vector<bool> inside = insides();
    int compared = 0, agreeing = 0, lit = 0;
    float worst = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (!inside[std::size_t(y * kWidth + x)]) continue;
        float difference = 0;
        for (int channel = 0; channel < 3; ++channel)
          difference = std::max(difference, std::abs(255 * picture.pixel(x, y)[channel] -
                                                     std::round(255 * truth.pixel(x, y)[channel])));
        ++compared;
        agreeing += difference < 1.5f;
        lit += truth.rgb(x, y).x > 0.2f;
        worst = std::max(worst, difference);
      }
    EXPECT_GT(compared, kWidth * kHeight / 2);
    EXPECT_GT(lit, kWidth * kHeight / 4);
    EXPECT_GE(double(agreeing) / compared, 0.999) << "worst difference " << worst << " / 255";
  }

  test::TemporaryFolder folder;
};

TEST_F(Handover, DiffuseVectorsGiveThePictureOfRelight) {
  bakeAndExport(false);
  expectSamePicture();
}

TEST_F(Handover, ColouredMatricesAndAPhongLobeGiveThePictureOfRelight) {
  bakeAndExport(true);
  expectSamePicture();
}

TEST_F(Handover, VisibilityOfFewerBandsDoesToo) {
  bakeAndExport(true, {"transfer.bounces=0", "transfer.bands=4"});
  expectSamePicture();
}

TEST_F(Handover, LightThatTheSampleProjectsIsTheLightOfRelight) {
  bakeAndExport(false);
  expectSamePicture({"--light", "circle:1,1,0.5:60:3"}, {"--lamp", "1,1,0.5,60,3"});
}

TEST_F(Handover, WhatCannotBeReadIsToldInOneLine) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"no", "where", "a.ppm"}, {"usage"}}) {
    const test::ProgramResult result = handover(words);
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.errorLines(), 1) << result.err;
  }
}

}  // namespace
}  // namespace prt
