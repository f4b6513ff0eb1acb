// A process that dies at any moment leaves the saved project as it was, and the next bake goes on to the
// same bits as one that was never interrupted.

#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <map>
#include <random>
#include <thread>

namespace prt {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

/// Stage and array to checksum, of final products only.
std::map<std::string, std::string> productsIn(const fs::path& folder, const std::string& file) {
  const test::ProgramResult result = test::run({"prt", "info", file, "--json"}, folder);
  EXPECT_EQ(result.status, 0) << result.err;
  std::map<std::string, std::string> checksums;
  const json info = json::parse(result.out, nullptr, false);
  if (info.is_discarded()) return {};
  for (const json& product : info["products"])
    if (!product["checkpoint"])
      for (const json& array : product["arrays"])
        checksums[product["stage"].get<std::string>() + "/" + array["name"].get<std::string>()] =
            array["checksum"];
  return checksums;
}

std::vector<std::string> bakeCommand(const std::string& output, const std::string& bands) {
  return {"prt",           "bake",
          "scene:default", "-o",
          output,          "-q",
          "--checkpoint",  "0",
          "--threads",     "2",
          "--set",         "objects[0].mesh.detail=0.4",
          "--set",         "objects[1].mesh.detail=0.3",
          "--set",         "transfer.rays=1024",
          "--set",         "transfer.bounces=3",
          "--set",         "transfer.threshold=0",
          "--set",         "transfer.bands=" + bands};
}

TEST(Kill, NeverHurtsTheSavedProjectAndResumesToTheSameBits) {
  const test::TemporaryFolder folder;
  const auto begun = Clock::now();
  ASSERT_EQ(test::run(bakeCommand("whole.prt", "4"), folder.path()).status, 0);
  const double whole = std::chrono::duration<double>(Clock::now() - begun).count();
  const auto expected = productsIn(folder.path(), "whole.prt");
  ASSERT_EQ(test::run(bakeCommand("first.prt", "2"), folder.path()).status, 0);
  const auto saved = productsIn(folder.path(), "first.prt");

  std::mt19937 random(2024);
  std::uniform_real_distribution<double> moment(0, 1.1 * whole);
  int finished = 0, killed = 0;
  fs::copy_file(folder / "first.prt", folder / "a.prt");
  for (int kill = 0; kill < 50; ++kill) {
    test::Program bake(bakeCommand("a.prt", "4"), folder.path());
    std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
    bake.send(SIGKILL);
    (bake.wait().status == 0 ? finished : killed)++;
    ASSERT_EQ(test::run({"prt", "verify", "a.prt", "-q"}, folder.path()).status, 0) << "after kill " << kill;
    const auto now = productsIn(folder.path(), "a.prt");
    ASSERT_TRUE(now == saved || now == expected) << "after kill " << kill;
    if (now != expected && kill % 5 != 4) continue;
    // Let it end, compare, and begin anew from the first state.
    ASSERT_EQ(test::run(bakeCommand("a.prt", "4"), folder.path()).status, 0);
    ASSERT_EQ(productsIn(folder.path(), "a.prt"), expected) << "after kill " << kill;
    fs::copy_file(folder / "first.prt", folder / "a.prt", fs::copy_options::overwrite_existing);
  }
  EXPECT_GT(killed, 20);
}

TEST(Interrupt, CtrlCEndsWith130AndKeepsTheWork) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(test::run(bakeCommand("whole.prt", "4"), folder.path()).status, 0);
  std::vector<std::string> slow = bakeCommand("a.prt", "4");
  slow.insert(slow.end(), {"--set", "transfer.rays=65536"});
  test::Program bake(slow, folder.path());
  while (bake.running() && !fs::exists(folder / "a.prt.work"))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const auto asked = Clock::now();
  bake.send(SIGINT);
  const test::ProgramResult result = bake.wait();
  const double seconds = std::chrono::duration<double>(Clock::now() - asked).count();
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_EQ(result.errorLines(), 1) << result.err;
  EXPECT_LT(seconds, 2) << "generous: the machine may be busy";
  EXPECT_FALSE(fs::exists(folder / "a.prt"));
  EXPECT_TRUE(fs::exists(folder / "a.prt.work"));
  // With fewer rays, the same command goes on from there, or begins anew where it must, to the same bits.
  ASSERT_EQ(test::run(bakeCommand("a.prt", "4"), folder.path()).status, 0);
  EXPECT_EQ(productsIn(folder.path(), "a.prt"), productsIn(folder.path(), "whole.prt"));
  EXPECT_FALSE(fs::exists(folder / "a.prt.work"));
}

TEST(Threads, DoNotChangeTheProducts) {
  const test::TemporaryFolder folder;
  const auto bake = [&](const std::string& output, const std::string& threads) {
    std::vector<std::string> words{"prt",           "bake",
                                   "scene:default", "-o",
                                   output,          "-q",
                                   "--threads",     threads,
                                   "--set",         "objects[0].mesh.detail=0.4",
                                   "--set",         "objects[1].mesh.detail=0.3",
                                   "--set",         "transfer.rays=128",
                                   "--set",         "objects[0].material.model=phong",
                                   "--set",         "objects[0].material.specular=0.3"};
    EXPECT_EQ(test::run(words, folder.path()).status, 0);
    return productsIn(folder.path(), output);
  };
  EXPECT_EQ(bake("one.prt", "1"), bake("three.prt", "3"));
}

}  // namespace
}  // namespace prt
