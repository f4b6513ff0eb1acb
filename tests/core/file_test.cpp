#include "libprt/core/file.h"
#include "libprt/core/error.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <fstream>
#include <string>

namespace prt {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

std::string textOf(const fs::path& path) {
  const std::vector<std::byte> bytes = readFile(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(File, WritesAndReadsBack) {
  const TemporaryFolder folder;
  writeFile(folder / "a", "first");
  writeFile(folder / "a", "second, longer");
  EXPECT_EQ(textOf(folder / "a"), "second, longer");
  writeFile(folder / "empty", "");
  EXPECT_EQ(textOf(folder / "empty"), "");
  EXPECT_EQ(folder.entries(), 2);
}

TEST(File, UncommittedWritingLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  writeFile(folder / "a", "old");
  try {
    const AtomicFile file(folder / "a");
    std::ofstream(file.path()) << "half of the new";
    EXPECT_EQ(file.path().parent_path(), folder.path());
    throw Cancelled();
  } catch (const Cancelled&) {
  }
  EXPECT_EQ(textOf(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(File, KeepsPermissionsAndFollowsLinks) {
  const TemporaryFolder folder;
  writeFile(folder / "real", "old");
  fs::permissions(folder / "real", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real", folder / "link");
  writeFile(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(textOf(folder / "real"), "new");
  EXPECT_EQ(fs::status(folder / "real").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(File, WritesIntoTheCurrentFolder) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  writeFile("plain-name", "x");
  fs::current_path(before);
  EXPECT_EQ(textOf(folder / "plain-name"), "x");
}

TEST(File, ErrorsNameThePath) {
  const TemporaryFolder folder;
  EXPECT_THROW(readFile(folder / "missing"), FileError);
  EXPECT_THROW(readFile(folder.path()), FileError);
  EXPECT_THROW(readFile("/dev/zero"), FileError);
  EXPECT_THROW(writeFile(folder / "no" / "such" / "folder", "x"), FileError);
  EXPECT_THROW(writeFile(folder.path(), "x"), FileError);
  EXPECT_THROW(writeFile("/dev/null", "x"), FileError) << "would replace the device";
  EXPECT_THROW(writeFile("", "x"), FileError);
  writeFile(folder / "large", std::string(100, 'x'));
  EXPECT_THROW(readFile(folder / "large", 99), FileError);
  ::mkfifo((folder / "pipe").c_str(), 0600);
  EXPECT_THROW(readFile(folder / "pipe"), FileError) << "must not wait for a writer";
  try {
    readFile(folder / "missing");
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("missing: cannot open it: No such file"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace prt
