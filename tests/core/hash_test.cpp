#include "libprt/core/hash.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace prt {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text));
}

TEST(Hash, KnownValues) {
  // As printed by the xxh128sum program for the empty input and for "abc".
  EXPECT_EQ(hashBytes({}).hex(), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hashBytes(bytesOf("abc")).hex(), "06b05ab6733a618578af5f94892f3950");
}

TEST(Hash, HexAndBack) {
  EXPECT_TRUE(rc::check("fromHex undoes hex", [](std::uint64_t high, std::uint64_t low) {
    const Hash128 hash{high, low};
    RC_ASSERT(hash.hex().size() == 32u);
    RC_ASSERT(Hash128::fromHex(hash.hex()) == hash);
  }));
  EXPECT_FALSE(Hash128::fromHex("123"));
  EXPECT_FALSE(Hash128::fromHex(std::string(32, 'g')));
}

TEST(Hash, FramingTellsSequencesApart) {
  enum class Kind { A, B };
  std::set<Hash128> seen;
  const auto add = [&](Hasher& hasher) { EXPECT_TRUE(seen.insert(hasher.result()).second); };
  add(Hasher().add("ab").add("c"));
  add(Hasher().add("a").add("bc"));
  add(Hasher().add("abc"));
  add(Hasher().add("abc").add(""));
  add(Hasher().addBytes(bytesOf("abc")));
  add(Hasher().add(std::vector<char>{'a', 'b', 'c'}));
  add(Hasher().add(1));
  add(Hasher().add(1.0f));
  add(Hasher().add(1.0));
  add(Hasher().add(1u));
  add(Hasher().add(std::int64_t(1)));
  add(Hasher().add(true));
  add(Hasher().add(Kind::B));
  add(Hasher().add(std::vector<int>{1}));
  add(Hasher().add(std::vector<int>{1, 2}));
  add(Hasher().add(1).add(2));
  add(Hasher().add(std::vector<int>{1}).add(std::vector<int>{2}));
  add(Hasher().add(Vec3(1, 2, 3)));
  add(Hasher().add(std::vector<float>{1, 2, 3}));
  add(Hasher().add(std::vector<Vec3>{{1, 2, 3}}));
  add(Hasher().add(std::vector<Vec2>{{1, 2}, {3, 4}}));
  add(Hasher().add(std::vector<Vec4>{{1, 2, 3, 4}}));
  add(Hasher().add(hashBytes({})));
  add(Hasher().add(std::vector<float>{}));
  add(Hasher().add(std::vector<Vec3>{}));
}

TEST(Hash, SameValuesGiveTheSameHash) {
  const std::string text = "transfer.bands";
  EXPECT_EQ(Hasher().add(text).result(), Hasher().add("transfer.bands").result());
  EXPECT_EQ(Hasher().add(std::array<float, 2>{1, 2}).result(),
            Hasher().add(std::vector<float>{1, 2}).result());
  const std::vector<Vec3> points{{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(Hasher().add(points).result(), Hasher().add(std::span(points)).result());
}

TEST(Hash, ResultDoesNotEndTheSequence) {
  Hasher hasher;
  hasher.add(1);
  const Hash128 first = hasher.result();
  hasher.add(2);
  EXPECT_NE(hasher.result(), first);
  EXPECT_EQ(hasher.result(), Hasher().add(1).add(2).result());
}

TEST(Hash, FileHashIsTheHashOfItsBytes) {
  const auto path = std::filesystem::temp_directory_path() / "prt_hash_test";
  const std::string content(700'001, 'x');  // more than one read
  std::ofstream(path, std::ios::binary) << content;
  EXPECT_EQ(hashFile(path), hashBytes(bytesOf(content)));
  std::filesystem::remove(path);
  EXPECT_THROW(hashFile(path), FileError);
  EXPECT_THROW(hashFile(std::filesystem::temp_directory_path()), FileError);
}

}  // namespace
}  // namespace prt
