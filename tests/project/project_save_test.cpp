#include "libprt/core/error.h"
#include "libprt/project/backups.h"
#include "libprt/project/project_file.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <random>
#include <thread>

namespace prt {
namespace {

namespace fs = std::filesystem;

ProductStore::Stored product(std::uint32_t seed, std::size_t count = 1000) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> values(count);
  for (auto& v : values) v = random();
  return {
      {R"({"n":1})",
       {{"v", Array::from<std::uint32_t>(std::span<const std::uint32_t>(values), {std::int64_t(count)})}}},
      1,
      1};
}

bool holds(ProjectFile& project, const std::string& key, std::uint32_t seed, std::size_t count = 1000) {
  const auto found = project.find("direct", key);
  return found && found->data.arrays.at("v").bytes == product(seed, count).data.arrays.at("v").bytes;
}

Recipe recipeWith(int bands) {
  Recipe recipe;
  recipe.transfer.bands = bands;
  return recipe;
}

void verified(const fs::path& file) {
  Job job;
  EXPECT_NO_THROW(ProjectFile::verify(file, job)) << file;
}

struct ProjectSave : testing::Test {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "p.prt";
  Job job;
};

TEST_F(ProjectSave, KeepsTheWorkingCopyAndWhatIsInIt) {
  const auto project = ProjectFile::openForWork(file);
  project->put("direct", "wanted", product(1));
  project->put("direct", "undone", product(2));
  project->putCheckpoint("direct", "going on", product(3).data);
  project->saveKeepingWork(recipeWith(3), {.keys = {{"wanted", "going on"}}}, job);
  EXPECT_TRUE(fs::exists(ProjectFile::workFile(file)));
  EXPECT_FALSE(project->hasNewWork());
  EXPECT_TRUE(holds(*project, "undone", 2)) << "undo finds it";
  const auto saved = ProjectFile::open(file);
  EXPECT_EQ(saved->recipe().transfer.bands, 3);
  EXPECT_TRUE(holds(*saved, "wanted", 1));
  EXPECT_EQ(saved->find("direct", "undone"), nullptr);
  EXPECT_NE(saved->findCheckpoint("direct", "going on"), nullptr);
  EXPECT_FALSE(fs::exists(file.string() + ".saving"));
  verified(file);
  project->put("direct", "later", product(4));
  EXPECT_TRUE(project->hasNewWork());
}

TEST_F(ProjectSave, TheWorkingCopyIsGoneOnWithAfterIt) {
  {
    const auto project = ProjectFile::openForWork(file);
    project->put("direct", "a", product(1));
    project->saveKeepingWork(recipeWith(3), {}, job);
    project->put("direct", "b", product(2));
  }
  const auto project = ProjectFile::openForWork(file);
  EXPECT_TRUE(project->resumed());
  EXPECT_TRUE(holds(*project, "b", 2));
  project->saveKeepingWork(recipeWith(4), {}, job);
  EXPECT_FALSE(project->hasNewWork());
  project->discardWork();
  EXPECT_EQ(folder.entries(), 1);
  EXPECT_TRUE(holds(*ProjectFile::open(file), "b", 2));
}

TEST_F(ProjectSave, ABakeOnAnotherThreadLosesNothing) {
  const auto project = ProjectFile::openForWork(file);
  std::atomic<bool> stop{false};
  std::atomic<int> written{0};
  std::thread bake([&] {
    while (!stop) {
      project->put("direct", std::to_string(written), product(std::uint32_t(written), 50000));
      ++written;
      project->putCheckpoint("direct", "checkpoint", product(7).data);
    }
  });
  for (int save = 0; save < 8 || written < 20; ++save) {
    project->saveKeepingWork(recipeWith(1 + save % 10), {.backups = 2}, job);
    verified(file);
  }
  stop = true;
  bake.join();
  project->saveKeepingWork(recipeWith(5), {}, job);
  const auto saved = ProjectFile::open(file);
  for (int i = 0; i < written; ++i)
    EXPECT_TRUE(holds(*saved, std::to_string(i), std::uint32_t(i), 50000)) << i;
}

TEST_F(ProjectSave, AFailureLeavesTheSavedStateAndTheWork) {
  const auto project = ProjectFile::openForWork(file);
  project->put("direct", "a", product(1));
  project->saveKeepingWork(recipeWith(3), {}, job);
  project->put("direct", "b", product(2));
  Job cancelled;
  cancelled.cancel();
  EXPECT_THROW(project->saveKeepingWork(recipeWith(4), {}, cancelled), Cancelled);
  EXPECT_TRUE(project->hasNewWork());
  EXPECT_EQ(ProjectFile::open(file)->recipe().transfer.bands, 3);
  EXPECT_FALSE(fs::exists(file.string() + ".saving"));
  project->saveKeepingWork(recipeWith(4), {}, job);
  EXPECT_TRUE(holds(*ProjectFile::open(file), "b", 2));
}

TEST_F(ProjectSave, WhateverADyingProcessLeavesTheWorkBelongsToIt) {
  {
    const auto project = ProjectFile::openForWork(file);
    project->put("direct", "a", product(1));
    project->saveKeepingWork(recipeWith(3), {}, job);
    project->put("direct", "b", product(2));
    fs::copy_file(file, folder / "old.prt");
  }
  // Died just before, and just after the new file took the name: the working copy names both.
  const auto work = ProjectFile::workFile(file);
  fs::path seen;
  {
    const auto project = ProjectFile::openForWork(file);
    fs::create_directory(backupFile(file, 1));  // cannot be replaced: the save ends before the rename
    fs::rename(file, folder / "aside.prt");
    fs::create_directory(file);
    EXPECT_THROW(project->saveKeepingWork(recipeWith(4), {}, job), FileError);
    fs::remove(file);
    fs::rename(folder / "aside.prt", file);
  }
  const auto again = ProjectFile::openForWork(file);
  EXPECT_TRUE(again->resumed());
  EXPECT_TRUE(holds(*again, "b", 2));
}

TEST_F(ProjectSave, ImportsRowsAsTheyAre) {
  const auto from = ProjectFile::openForWork(folder / "from.prt");
  from->put("direct", "a", product(1, 600000));
  from->putCheckpoint("direct", "c", product(2).data);
  const auto to = ProjectFile::openForWork(file);
  to->put("direct", "own", product(3));
  to->putCheckpoint("direct", "c", product(4).data);
  to->importFrom(*from);
  EXPECT_TRUE(holds(*to, "a", 1, 600000));
  EXPECT_TRUE(holds(*to, "own", 3));
  EXPECT_EQ(to->contents().size(), 3u);
  EXPECT_EQ(to->findCheckpoint("direct", "c")->arrays.at("v").bytes, product(2).data.arrays.at("v").bytes);
  to->saveKeepingWork(recipeWith(2), {}, job);
  verified(file);
}

TEST_F(ProjectSave, KeepsNumberedBackupsOfTheLastSaves) {
  const auto project = ProjectFile::openForWork(file);
  for (int bands = 1; bands <= 6; ++bands) project->saveKeepingWork(recipeWith(bands), {.backups = 3}, job);
  ASSERT_EQ(backupsOf(file).size(), 3u);
  for (int n = 1; n <= 3; ++n) {
    EXPECT_EQ(ProjectFile::open(backupFile(file, n))->recipe().transfer.bands, 6 - n);
    verified(backupFile(file, n));
  }
  project->saveKeepingWork(recipeWith(7), {.backups = 1}, job);
  EXPECT_EQ(backupsOf(file), std::vector<fs::path>{backupFile(file, 1)});
  project->saveKeepingWork(recipeWith(8), {.backups = 0}, job);
  EXPECT_TRUE(backupsOf(file).empty());
}

TEST(Backups, AnInterruptedRotationIsGoneOnWith) {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "x.prt";
  const auto write = [](const fs::path& path, const char* text) { std::ofstream(path) << text; };
  write(file, "current");
  write(backupFile(file, 2), "older");
  keepBackup(file, 3);
  keepBackup(file, 3);  // the same save again is not two backups
  ASSERT_EQ(backupsOf(file).size(), 2u);
  EXPECT_TRUE(fs::equivalent(file, backupFile(file, 1)));
  EXPECT_TRUE(fs::exists(backupFile(file, 3)));
}

}  // namespace
}  // namespace prt
