// What each command says when something is wrong: one line, the right exit status, nothing half-written.

#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <set>

namespace prt {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using testing::HasSubstr;

constexpr int kFailed = 1, kUsage = 2;

/// Names of everything in a folder, hidden files included.
std::set<std::string> namesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(fs::relative(entry.path(), folder));
  return names;
}

class Errors : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder / "t.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(folder / "text.txt") << "hello\n";
    std::ofstream(folder / "broken.json") << "{";
    std::ofstream(folder / "typo.json") << R"({"transfer": {"bonces": 3}})";
    std::ofstream(folder / "empty.prt");
    fs::create_directory(folder / "dir");
    ASSERT_EQ(
        test::run({"prt", "bake", "t.obj", "-o", "a.prt", "--set", "transfer.rays=16", "-q"}, folder.path())
            .status,
        0);
    ASSERT_EQ(
        test::run({"prt", "bake", "t.obj", "-o", "mesh.prt", "--stage", "mesh", "-q"}, folder.path()).status,
        0);
    fs::resize_file((fs::copy_file(folder / "a.prt", folder / "cut.prt"), folder / "cut.prt"), 200000);
  }

  /// Runs and checks that it fails as it must; returns the line on stderr.
  std::string failure(int status, std::vector<std::string> words) {
    const std::set<std::string> before = namesIn(folder.path());
    words.insert(words.begin(), "prt");
    const ProgramResult result = test::run(words, folder.path());
    std::string line;
    for (const std::string& word : words) line += word + " ";
    EXPECT_EQ(result.status, status) << line << result.err;
    EXPECT_EQ(result.errorLines(), 1) << line << result.err;
    EXPECT_EQ(result.out, "") << line;
    EXPECT_EQ(namesIn(folder.path()), before) << line << "left something behind";
    return result.err;
  }

  test::TemporaryFolder folder;
};

TEST_F(Errors, WrongUsageIsStatus2) {
  EXPECT_THAT(failure(kUsage, {}), HasSubstr("--help"));
  EXPECT_THAT(failure(kUsage, {"bkae"}), HasSubstr("did you mean bake?"));
  EXPECT_THAT(failure(kUsage, {"bake"}), HasSubstr("INPUT is required"));
  EXPECT_THAT(failure(kUsage, {"bake", "t.obj"}), HasSubstr("-o"));
  EXPECT_THAT(failure(kUsage, {"bake", "t.obj", "-o", "b.prt", "--stages", "mesh"}),
              HasSubstr("did you mean --stage?"));
  failure(kUsage, {"bake", "t.obj", "-o", "b.prt", "--stage", "quilts"});
  failure(kUsage, {"bake", "t.obj", "-o", "b.prt", "--threads", "many"});
  failure(kUsage, {"info"});
  failure(kUsage, {"info", "a.prt", "b.prt"});
  failure(kUsage, {"light", "builtin:overcast", "--bands", "0"});
  failure(kUsage, {"light", "builtin:overcast", "-o", "x.jpg"});
  failure(kUsage, {"reference", "a.prt", "-o", "x.exr", "--size", "big"});
  failure(kUsage, {"reference", "a.prt", "-o", "x.exr", "--size", "0x10"});
  failure(kUsage, {"reference", "a.prt", "-o", "x.exr", "--spp", "0"});
  failure(kUsage, {"reference", "a.prt", "-o", "x.txt"});
  failure(kUsage, {"compare", "one.exr"});
  failure(kUsage, {"relight", "a.prt", "-o", "x.exr", "--backend", "vulkan"});
  failure(kUsage, {"relight", "a.prt", "-o", "x.exr", "--method", "magic"});
  failure(kUsage, {"relight", "a.prt", "-o", "x.exr", "--exposure", "nan"});
  failure(kUsage, {"export", "a.prt"});
  failure(kUsage, {"demo"});
  failure(kUsage, {"demo", "-o", "d", "--scene", "none"});
  EXPECT_THAT(failure(kUsage, {"bench", "bke"}), HasSubstr("did you mean bake? choose from bake"));
}

TEST_F(Errors, LightsAreExplained) {
  for (const char* light : {"circle:0,1,0:30", "circle:0,0,0:30:1", "circle:0,1,0:-3:1",
                            "circle:0,1,0:30:1,2", "square:1", "constant:x", ""})
    EXPECT_THAT(failure(kUsage, {"reference", "a.prt", "-o", "x.exr", "--light", light}),
                HasSubstr("circle:DIR:DEG:RGB"))
        << light;
}

TEST_F(Errors, BadInputIsStatus1) {
  EXPECT_THAT(failure(kFailed, {"bake", "none.obj", "-o", "b.prt"}), HasSubstr("none.obj: does not exist"));
  EXPECT_THAT(failure(kFailed, {"bake", "dir", "-o", "b.prt"}), HasSubstr("is a folder"));
  EXPECT_THAT(failure(kFailed, {"bake", "text.txt", "-o", "b.prt"}),
              HasSubstr("neither a mesh, a recipe nor a project"));
  EXPECT_THAT(failure(kFailed, {"bake", "broken.json", "-o", "b.prt"}), HasSubstr("is not JSON"));
  EXPECT_THAT(failure(kFailed, {"bake", "typo.json", "-o", "b.prt"}),
              HasSubstr("did you mean transfer.bounces?"));
  EXPECT_THAT(failure(kFailed, {"bake", "scene:nowhere", "-o", "b.prt"}), HasSubstr("choose from default"));
  EXPECT_THAT(failure(kFailed, {"bake", "builtin:teapot", "-o", "b.prt"}), HasSubstr("choose from"));
  EXPECT_THAT(failure(kFailed, {"bake", "empty.prt", "-o", "b.prt"}), HasSubstr("it is empty"));
  EXPECT_THAT(failure(kFailed, {"bake", "cut.prt"}), HasSubstr("truncated"));
  EXPECT_THAT(failure(kFailed, {"info", "none.prt"}), HasSubstr("No such file"));
  EXPECT_THAT(failure(kFailed, {"info", "dir"}), HasSubstr("is a folder"));
  EXPECT_THAT(failure(kFailed, {"info", "t.obj"}), HasSubstr("not a PRT project"));
  EXPECT_THAT(failure(kFailed, {"verify", "cut.prt"}), HasSubstr("truncated"));
  failure(kFailed, {"light", "none.hdr"});
  failure(kFailed, {"light", "text.txt"});
  failure(kFailed, {"light", "dir"});
  failure(kFailed, {"compare", "none.exr", "none.exr"});
  failure(kFailed, {"reference", "none.prt", "-o", "x.exr"});
  failure(kFailed, {"reference", "a.prt", "--env", "none.hdr", "-o", "x.exr"});
  failure(kFailed, {"reference", "a.prt", "--env", "builtin:mars", "-o", "x.exr"});
  EXPECT_THAT(failure(kFailed, {"reference", "a.prt", "--camera", "side", "-o", "x.exr"}),
              HasSubstr("there is no camera 'side'"));
  failure(kFailed, {"reference", "a.prt", "--camera", "broken.json", "-o", "x.exr"});
  failure(kFailed, {"relight", "cut.prt", "-o", "x.exr"});
  EXPECT_THAT(failure(kFailed, {"relight", "mesh.prt", "-o", "x.exr"}), HasSubstr("run prt bake mesh.prt"));
  EXPECT_THAT(failure(kFailed, {"export", "mesh.prt", "--npy", "d"}), HasSubstr("run prt bake mesh.prt"));
  EXPECT_THAT(failure(kFailed, {"relight", "a.prt", "--method", "glossy", "-o", "x.exr"}),
              HasSubstr("glossy"));
  failure(kFailed, {"export", "a.prt", "--npy", "text.txt"});
  failure(kFailed, {"demo", "-o", "text.txt"});
  failure(kFailed, {"reference", "a.prt", "--camera", "typo.json", "-o", "x.exr"});
}

TEST_F(Errors, BadSettingsNameTheNearestPath) {
  EXPECT_THAT(failure(kFailed, {"bake", "t.obj", "-o", "b.prt", "--set", "transfer.bonces=3"}),
              HasSubstr("did you mean transfer.bounces?"));
  EXPECT_THAT(failure(kFailed, {"bake", "t.obj", "-o", "b.prt", "--set", "transfer.bands=99"}),
              HasSubstr("use 1 to 10"));
  EXPECT_THAT(failure(kFailed, {"bake", "t.obj", "-o", "b.prt", "--set", "transfer.bands"}),
              HasSubstr("PATH=VALUE"));
  EXPECT_THAT(failure(kFailed, {"bake", "t.obj", "-o", "b.prt", "--set", "mesh=missing.obj"}),
              HasSubstr("missing.obj"));
}

TEST_F(Errors, OutputsThatCannotBeWritten) {
  EXPECT_THAT(failure(kFailed, {"bake", "t.obj", "-o", "nowhere/b.prt"}), HasSubstr("folder does not exist"));
  EXPECT_THAT(failure(kFailed, {"bake", "t.obj", "-o", "dir"}), HasSubstr("is a folder"));
  EXPECT_THAT(failure(kFailed, {"bake", "t.obj", "-o", "t.obj"}), HasSubstr("not a PRT project"))
      << "a mesh must never be overwritten";
  EXPECT_THAT(failure(kFailed, {"bake", "t.obj", "-o", "text.txt/b.prt"}), HasSubstr("folder"));
  failure(kFailed, {"bake", "t.obj", "-o", "/proc/b.prt"});
  failure(kFailed, {"reference", "a.prt", "-o", "nowhere/x.exr"});
  failure(kFailed, {"light", "builtin:overcast", "-o", "nowhere/x.exr"});
}

/// A disk that is full, as far as one process can tell: its files may not grow beyond a size.
TEST_F(Errors, AFullDiskLeavesTheSavedProjectIntact) {
  const auto size = fs::file_size(folder / "a.prt");
  for (const auto limit : {size / 2, size + 100000}) {  // too small for the working copy; for what is baked
    const std::string script = "ulimit -f " + std::to_string(limit / 512) + "; exec " +
                               (fs::read_symlink("/proc/self/exe").parent_path() / "prt").string() +
                               " bake a.prt --set mesh=builtin:rock -q";
    const ProgramResult result = test::run({"/bin/sh", "-c", script}, folder.path());
    EXPECT_EQ(result.status, kFailed);
    EXPECT_EQ(result.errorLines(), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("disk"));
    EXPECT_EQ(test::run({"prt", "verify", "a.prt", "-q"}, folder.path()).status, 0);
  }
}

/// Every broken mesh either bakes or is refused with one line.
TEST(BadMeshes, EndInAProjectOrOneLine) {
  PRT_NEEDS_SHARED_DATA();
  const test::TemporaryFolder folder;
  int baked = 0, refused = 0;
  for (const auto& entry : fs::directory_iterator(test::sharedData("badmeshes"))) {
    const ProgramResult result =
        test::run({"prt", "bake", entry.path(), "-o", "b.prt", "--stage", "mesh", "-q"}, folder.path());
    const std::string file = entry.path().filename();
    if (result.status == 0) {
      ++baked;
      EXPECT_EQ(result.err, "") << file;
      EXPECT_EQ(test::run({"prt", "verify", "b.prt", "-q"}, folder.path()).status, 0) << file;
    } else {
      ++refused;
      EXPECT_EQ(result.status, kFailed) << file << result.err;
      EXPECT_EQ(result.errorLines(), 1) << file << result.err;
      EXPECT_THAT(result.err, HasSubstr(file));
    }
    fs::remove(folder / "b.prt");
    EXPECT_EQ(folder.entries(), 0) << file << " left something behind";
  }
  EXPECT_GT(baked, 5);
  EXPECT_GT(refused, 5);
}

}  // namespace
}  // namespace prt
