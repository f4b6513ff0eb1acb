#include "libprt/project/project_file.h"
#include "libprt/core/error.h"
#include "tests/project/toy_stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

namespace prt {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string readBytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void writeBytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

template <class T>
Array ramp(std::vector<std::int64_t> shape) {
  Array probe{dtypeOf<T>(), shape, {}};
  std::vector<T> values(probe.size());
  std::iota(values.begin(), values.end(), T(0));
  return Array::from<T>(std::span<const T>(values), std::move(shape));
}

ProductStore::Stored sample() {
  return {{R"({"rays":64})",
           {{"values", ramp<float>({7, 25})},
            {"indices", ramp<std::int32_t>({4, 3})},
            {"none", ramp<std::uint8_t>({0})}}},
          2,
          2};
}

bool equal(const ProductData& a, const ProductData& b) {
  if (a.meta != b.meta || a.arrays.size() != b.arrays.size()) return false;
  for (const auto& [name, array] : a.arrays) {
    const auto other = b.arrays.find(name);
    if (other == b.arrays.end() || other->second.dtype != array.dtype || other->second.shape != array.shape ||
        other->second.bytes != array.bytes)
      return false;
  }
  return true;
}

class ProjectFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("prt_project_" + std::to_string(getpid()));
    fs::create_directories(folder);
    file = folder / "a project #1%.prt";  // what a URI would take as special
  }
  void TearDown() override { fs::remove_all(folder); }

  void makeSaved() {
    const auto project = ProjectFile::openForWork(file);
    Recipe recipe;
    recipe.transfer.bands = 4;
    project->setRecipe(recipe);
    project->put("direct", "key", sample());
    project->save();
  }
  std::string openError() {
    try {
      ProjectFile::open(file);
    } catch (const FileError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string verifyError() {
    try {
      Job job;
      ProjectFile::verify(file, job);
    } catch (const FileError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder, file;
};

TEST_F(ProjectFileTest, KeepsRecipeAndProducts) {
  makeSaved();
  const auto project = ProjectFile::open(file);
  EXPECT_EQ(project->recipe().transfer.bands, 4);
  const auto found = project->find("direct", "key");
  ASSERT_NE(found, nullptr);
  EXPECT_TRUE(equal(found->data, sample().data));
  EXPECT_EQ(found->level, 2);
  EXPECT_EQ(found->levels, 2);
  EXPECT_EQ(project->find("direct", "other key"), nullptr);
  EXPECT_EQ(project->findCheckpoint("direct", "key"), nullptr);
}

TEST_F(ProjectFileTest, ASaveThatFailsCanBeTriedAgain) {
  for (const bool hadSaved : {false, true}) {
    if (hadSaved) makeSaved();
    const auto project = ProjectFile::openForWork(file);
    project->put("direct", "new", sample());
    fs::remove(file);
    fs::create_directories(file / "in the way");  // a folder cannot be replaced by a file
    EXPECT_THROW(project->save(), FileError);
    ASSERT_NE(project->find("direct", "new"), nullptr) << "what was worked on is still there";
    project->put("direct", "newer", sample());
    EXPECT_TRUE(project->hasNewWork());
    fs::remove_all(file);
    project->save();
    EXPECT_EQ(verifyError(), "no error");
    EXPECT_NE(ProjectFile::open(file)->find("direct", "newer"), nullptr);
    fs::remove(file);
  }
}

TEST_F(ProjectFileTest, LargeArraysSpanChunksAndCommits) {
  std::mt19937_64 random(1);
  std::vector<std::uint32_t> values(5 << 20);  // 20 MB that do not compress
  for (auto& v : values) v = std::uint32_t(random());
  const ProductStore::Stored big{{"{}",
                                  {{"v", Array::from<std::uint32_t>(std::span<const std::uint32_t>(values),
                                                                    {std::int64_t(values.size())})}}},
                                 1,
                                 1};
  const auto project = ProjectFile::openForWork(file);
  project->put("s", "k", big);
  project->save();
  EXPECT_TRUE(equal(ProjectFile::open(file)->find("s", "k")->data, big.data));
  EXPECT_EQ(verifyError(), "no error");
}

// Far enough that commits were made: what they hold must not be taken for a product, nor stay for good.
TEST_F(ProjectFileTest, AWriteThatIsBrokenOffLeavesWhatWasThere) {
  std::mt19937_64 random(2);
  std::vector<std::uint32_t> values(5 << 20);
  for (auto& v : values) v = std::uint32_t(random());
  const ProductStore::Stored big{{"{}",
                                  {{"v", Array::from<std::uint32_t>(std::span<const std::uint32_t>(values),
                                                                    {std::int64_t(values.size())})}}},
                                 1,
                                 1};
  const auto breakOff = [&](ProjectFile& project, int after) {
    int checks = 0;
    const auto check = [&] {
      if (++checks > after) throw Cancelled();
    };
    EXPECT_THROW(project.put("direct", "key", big, check), Cancelled);
    EXPECT_THROW(project.putCheckpoint("direct", "going on", big.data, check), Cancelled);
  };
  std::int64_t without = 0;
  {
    const auto project = ProjectFile::openForWork(file);
    project->put("direct", "key", sample());
    without = project->bytes();
    for (const int after : {0, 1, 9, 18}) breakOff(*project, after);
    EXPECT_GT(project->bytes(), without + (8 << 20)) << "nothing had been committed";
    EXPECT_TRUE(equal(project->find("direct", "key")->data, sample().data));
    EXPECT_EQ(project->findCheckpoint("direct", "going on"), nullptr);
    EXPECT_EQ(project->contents().size(), 1u);
  }
  {  // as a killed process would leave it, too
    const auto project = ProjectFile::openForWork(file);
    EXPECT_TRUE(project->resumed());
    EXPECT_TRUE(equal(project->find("direct", "key")->data, sample().data));
    breakOff(*project, 12);
    project->put("direct", "later", sample());
    project->keepOnly({"key", "later"});
    EXPECT_LT(project->bytes(), without + (1 << 20)) << "the rest was not cleared away";
    breakOff(*project, 12);
    project->save();
  }
  EXPECT_EQ(verifyError(), "no error");
  EXPECT_TRUE(equal(ProjectFile::open(file)->find("direct", "key")->data, sample().data));
  EXPECT_LT(fs::file_size(file), std::uintmax_t(without + (24 << 20)));
}

TEST_F(ProjectFileTest, WhatUndoMayWantIsKeptUpToABound) {
  const auto project = ProjectFile::openForWork(file);
  std::mt19937_64 random(3);
  const auto megabyte = [&] {
    std::vector<std::uint64_t> values(1 << 17);
    for (auto& v : values) v = random();
    std::vector<std::int32_t> half(values.size() * 2);
    std::memcpy(half.data(), values.data(), half.size() * 4);
    return Array::from<std::int32_t>(std::span<const std::int32_t>(half), {std::int64_t(half.size())});
  };
  for (const char* key : {"wanted", "first", "second", "third"})
    project->put("direct", key, {{"{}", {{"v", megabyte()}}}, 1, 1});
  project->putCheckpoint("direct", "going on", {"{}", {{"v", megabyte()}}});
  const auto keys = [&] {
    std::set<std::string> found;
    for (const ProductInfo& info : project->contents()) found.insert(info.key);
    return found;
  };
  Job job;
  project->keepRecent({"wanted"}, 100 << 20, job);
  EXPECT_EQ(keys().size(), 5u) << "there is room";
  const auto before = project->bytes();
  project->keepRecent({"wanted"}, 5 << 19, job);  // two of the four and a half
  EXPECT_EQ(keys(), (std::set<std::string>{"wanted", "third", "going on"})) << "the oldest go";
  EXPECT_LT(project->bytes(), before - (3 << 19));
  project->keepRecent({"wanted", "third"}, 0, job);
  EXPECT_EQ(keys(), (std::set<std::string>{"wanted", "third"}));
  project->save();
  EXPECT_EQ(verifyError(), "no error");
}

TEST_F(ProjectFileTest, AnotherPutReplacesAndVacuumShrinks) {
  const auto project = ProjectFile::openForWork(file);
  for (int i = 0; i < 3; ++i) project->put("direct", "key", sample());
  project->putCheckpoint("direct", "old", {"{}", {{"v", ramp<double>({300000})}}});
  EXPECT_EQ(project->contents().size(), 2u);
  const auto before = project->bytes();
  project->keepOnly({"key"});
  EXPECT_EQ(project->contents().size(), 1u);
  EXPECT_LT(project->bytes(), before);
  project->save();
  EXPECT_EQ(verifyError(), "no error");
}

TEST_F(ProjectFileTest, WorkDoesNotTouchTheSavedFile) {
  makeSaved();
  const std::string saved = readBytes(file);
  {
    const auto project = ProjectFile::openForWork(file);
    project->put("bounces", "k2", sample());
    Recipe recipe;
    project->setRecipe(recipe);
  }
  EXPECT_EQ(readBytes(file), saved);
  const auto again = ProjectFile::openForWork(file);
  EXPECT_TRUE(again->resumed());
  EXPECT_NE(again->find("bounces", "k2"), nullptr);
  EXPECT_EQ(again->recipe(), Recipe{});
  again->save();
  EXPECT_FALSE(fs::exists(ProjectFile::workFile(file)));
  EXPECT_NE(ProjectFile::open(file)->find("bounces", "k2"), nullptr);
}

TEST_F(ProjectFileTest, DiscardingWorkReturnsToTheSavedState) {
  makeSaved();
  const auto project = ProjectFile::openForWork(file);
  project->put("bounces", "k2", sample());
  project->discardWork();
  EXPECT_EQ(project->find("bounces", "k2"), nullptr);
  EXPECT_EQ(project->recipe().transfer.bands, 4);
  EXPECT_FALSE(fs::exists(ProjectFile::workFile(file)));
}

TEST_F(ProjectFileTest, WorkOnAnotherStateIsNotTakenUp) {
  makeSaved();
  ProjectFile::openForWork(file)->put("bounces", "k2", sample());
  const std::string work = readBytes(ProjectFile::workFile(file));
  {
    const auto project = ProjectFile::openForWork(file);
    project->put("floor", "k3", sample());
    project->save();
  }
  writeBytes(ProjectFile::workFile(file), work);
  EXPECT_FALSE(ProjectFile::openForWork(file)->resumed());
}

TEST_F(ProjectFileTest, DamagedWorkIsDropped) {
  makeSaved();
  for (const std::string& rubbish :
       {std::string(), std::string("rubbish"), readBytes(file).substr(0, 100000)}) {
    writeBytes(ProjectFile::workFile(file), rubbish);
    const auto project = ProjectFile::openForWork(file);
    EXPECT_FALSE(project->resumed());
    EXPECT_NE(project->find("direct", "key"), nullptr);
  }
}

/// Flips a bit in every compressed chunk of a file.
void damageChunks(const fs::path& file) {
  std::string bytes = readBytes(file);
  const std::string frame = "\x28\xb5\x2f\xfd";
  for (auto at = bytes.find(frame); at != std::string::npos; at = bytes.find(frame, at + 1))
    bytes[at + 6] ^= 1;
  writeBytes(file, bytes);
}

TEST_F(ProjectFileTest, WhatIsDamagedInAWorkingCopyIsNotThere) {
  for (const bool saved : {false, true}) {
    if (saved) makeSaved();
    {
      const auto project = ProjectFile::openForWork(file);
      project->put("direct", "key", sample());
      project->putCheckpoint("bounces", "k2", sample().data);
    }
    damageChunks(ProjectFile::workFile(file));
    const auto project = ProjectFile::openForWork(file);
    ASSERT_TRUE(project->resumed());
    EXPECT_EQ(project->find("direct", "key"), nullptr);
    EXPECT_EQ(project->findCheckpoint("bounces", "k2"), nullptr);
    EXPECT_TRUE(project->contents().empty());
    project->put("direct", "key", sample());
    project->save();
    EXPECT_EQ(verifyError(), "no error");
    EXPECT_TRUE(equal(ProjectFile::open(file)->find("direct", "key")->data, sample().data));
  }
}

TEST_F(ProjectFileTest, BakingAgainMendsASavedProject) {
  makeSaved();
  damageChunks(file);
  EXPECT_THROW(ProjectFile::open(file)->find("direct", "key"), FileError) << "a reader is told";
  const auto project = ProjectFile::openForWork(file);
  EXPECT_EQ(project->find("direct", "key"), nullptr);
  project->put("direct", "key", sample());
  project->save();
  EXPECT_EQ(verifyError(), "no error");
}

TEST_F(ProjectFileTest, AWorkingCopyWhosePagesAreDamagedIsDroppedOrServes) {
  constexpr std::size_t kPage = 65536;
  makeSaved();
  ProjectFile::openForWork(file)->put("bounces", "k2", sample());
  const std::string good = readBytes(ProjectFile::workFile(file)), savedBytes = readBytes(file);
  ASSERT_GT(good.size(), 3 * kPage);
  for (std::size_t page = 0; page * kPage < good.size(); ++page) {
    std::string bytes = good;
    bytes.replace(page * kPage + (page == 0 ? 100 : 0), 64, 64, '\x55');
    writeBytes(file, savedBytes);
    writeBytes(ProjectFile::workFile(file), bytes);
    const auto project = ProjectFile::openForWork(file);
    project->find("bounces", "k2");
    project->put("bounces", "k2", sample());
    EXPECT_NE(project->find("direct", "key"), nullptr) << page;
    project->save();
    EXPECT_EQ(verifyError(), "no error") << page;
  }
}

/// A bake runs again whatever was damaged, and ends in the same bits.
TEST_F(ProjectFileTest, ABakeMakesDamagedWorkAnew) {
  Recipe recipe;
  recipe.transfer.rays = 64;
  const auto bake = [&](test::ToyStages& toy) {
    const auto project = ProjectFile::openForWork(file);
    Job job;
    return Pipeline(project.get(), {folder, 0}, toy.table)
        .run(recipe, {"bounces"}, job)
        .get<test::Number>("bounces")
        ->value;
  };
  test::ToyStages first, again;
  const double expected = bake(first);
  damageChunks(ProjectFile::workFile(file));
  EXPECT_EQ(bake(again), expected);
  EXPECT_EQ(again.runs["direct"], 1);
  EXPECT_EQ(again.passes, 4) << "the checkpoint is damaged too";
  test::ToyStages third;
  EXPECT_EQ(bake(third), expected);
  EXPECT_TRUE(third.runs.empty()) << "what was made anew is kept";
}

TEST_F(ProjectFileTest, OnlyOneMayWork) {
  const auto first = ProjectFile::openForWork(file);
  try {
    ProjectFile::openForWork(file);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("in use"));
  }
  first->put("direct", "key", sample());
  first->save();
}

TEST_F(ProjectFileTest, ClearErrorsForWhatIsNoProject) {
  EXPECT_THAT(openError(), HasSubstr("No such file"));
  fs::create_directory(file);
  EXPECT_THAT(openError(), HasSubstr("is a folder"));
  fs::remove(file);
  writeBytes(file, "");
  EXPECT_THAT(openError(), HasSubstr("empty"));
  writeBytes(file, "v 0 0 0\nf 1 2 3\n");
  EXPECT_THAT(openError(), HasSubstr("not a PRT project"));
  fs::remove(file);
  makeSaved();
  const std::string good = readBytes(file);
  std::string bytes = good;
  bytes[71] ^= 1;
  writeBytes(file, bytes);
  EXPECT_THAT(openError(), HasSubstr("SQLite database, but not a PRT project"));
  bytes = good;
  bytes[63] = 99;
  writeBytes(file, bytes);
  EXPECT_THAT(openError(), HasSubstr("newer version"));
  writeBytes(file, good.substr(0, good.size() - 1));
  EXPECT_THAT(openError(), HasSubstr("truncated"));
}

/// What can be known of a project: nothing when opening or verifying fails.
std::string everythingIn(const fs::path& file) {
  try {
    Job job;
    ProjectFile::verify(file, job);
    const auto project = ProjectFile::open(file);
    std::string all = recipeToJson(project->recipe()).dump();
    for (const ProductInfo& info : project->contents()) {
      all += info.stage + info.key + std::to_string(info.level) + std::to_string(info.levels) + info.meta;
      const auto stored = project->find(info.stage, info.key);
      for (const auto& [name, array] : stored->data.arrays) {
        all += name + toString(array.dtype) + nlohmann::json(array.shape).dump();
        all.append(reinterpret_cast<const char*>(array.bytes.data()), array.bytes.size());
      }
    }
    return all;
  } catch (const FileError&) {
    return {};
  }
}

/// A flipped bit either is caught or lies where nothing is stored: never another content.
TEST_F(ProjectFileTest, FlippedBitsNeverChangeTheContents) {
  makeSaved();
  const std::string good = readBytes(file), contents = everythingIn(file);
  ASSERT_FALSE(contents.empty());
  std::mt19937 random(7);
  int caught = 0;
  const auto flip = [&](std::size_t at) {
    std::string bytes = good;
    bytes[at] = char(bytes[at] ^ (1 << random() % 8));
    writeBytes(file, bytes);
    const std::string now = everythingIn(file);
    caught += now.empty();
    EXPECT_TRUE(now.empty() || now == contents) << "byte " << at;
  };
  std::vector<std::size_t> used;  // most of a small file is empty space
  for (std::size_t i = 0; i < good.size(); ++i)
    if (good[i] != 0) used.push_back(i);
  for (int i = 0; i < 600; ++i) flip(used[random() % used.size()]);
  EXPECT_GT(caught, 500);
  for (int i = 0; i < 100; ++i) flip(random() % good.size());
}

TEST_F(ProjectFileTest, TruncationsAreAlwaysCaught) {
  makeSaved();
  const std::string good = readBytes(file);
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i) {
    writeBytes(file, good.substr(0, random() % good.size()));
    EXPECT_NE(openError(), "no error");
  }
}

TEST_F(ProjectFileTest, ADamagedWorkingCopyNeverReplacesTheSavedProject) {
  makeSaved();
  ProjectFile::openForWork(file)->put("bounces", "k2", sample());
  const auto project = ProjectFile::openForWork(file);
  ASSERT_TRUE(project->resumed());
  const fs::path work = ProjectFile::workFile(file);
  std::string bytes = readBytes(work);
  bytes[bytes.rfind("\x28\xb5\x2f\xfd") + 6] ^= 1;  // inside the last compressed chunk
  std::fstream(work, std::ios::in | std::ios::out | std::ios::binary) << bytes;
  EXPECT_THROW(project->save(), FileError);
  EXPECT_EQ(verifyError(), "no error");
  EXPECT_EQ(ProjectFile::open(file)->find("bounces", "k2"), nullptr);
}

TEST_F(ProjectFileTest, MovesOnlyWhereItMayWrite) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  makeSaved();
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(ProjectFile::openForWork(file), FileError);
  EXPECT_EQ(verifyError(), "no error") << "a read-only project must stay readable";
  fs::permissions(folder, fs::perms::owner_all);
}

}  // namespace
}  // namespace prt
