#include "libprt/core/npy.h"
#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/core/sampling.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace prt {
namespace {

using test::TemporaryFolder;

Array counting(DType type, std::vector<std::int64_t> shape) {
  Array array{type, std::move(shape), {}};
  array.bytes.resize(array.size() * sizeOf(type));
  for (std::size_t i = 0; i < array.bytes.size(); ++i) array.bytes[i] = std::byte(i);
  return array;
}

void expectSame(const Array& a, const Array& b) {
  EXPECT_EQ(a.dtype, b.dtype);
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_EQ(a.bytes, b.bytes);
}

TEST(Npy, EveryTypeAndShapeComesBack) {
  const TemporaryFolder folder;
  for (DType type :
       {DType::f16, DType::f32, DType::f64, DType::u8, DType::u16, DType::u32, DType::i32, DType::i64})
    for (const std::vector<std::int64_t>& shape :
         std::vector<std::vector<std::int64_t>>{{}, {0}, {1}, {7}, {2, 3}, {3, 0, 2}, {2, 3, 4, 1, 2}}) {
      const Array array = counting(type, shape);
      writeNpy(folder / "a.npy", array);
      expectSame(readNpy(folder / "a.npy"), array);
    }
}

TEST(Npy, BytesAreTheFormats) {
  const TemporaryFolder folder;
  const std::vector<float> values{1, 2};
  writeNpy(folder / "a.npy", Array::from<float>(values, {2, 1}));
  std::string text;
  for (std::byte b : readFile(folder / "a.npy")) text += char(b);
  ASSERT_EQ(text.size(), 128u + 8u);
  EXPECT_EQ(text.substr(0, 10), std::string("\x93NUMPY\x01\x00\x76\x00", 10));
  EXPECT_EQ(text.substr(10, 62), "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 1), }   ");
  EXPECT_EQ(text[127], '\n');
  EXPECT_EQ(text.substr(128), std::string("\0\0\x80\x3f\0\0\0\x40", 8));

  writeNpy(folder / "one.npy", counting(DType::u8, {5}));
  text.clear();
  for (std::byte b : readFile(folder / "one.npy")) text += char(b);
  EXPECT_NE(text.find("'|u1', 'fortran_order': False, 'shape': (5, ), }"), std::string::npos);
}

std::vector<std::byte> file(const std::string& dict, std::size_t dataBytes, int version = 1) {
  std::string text("\x93NUMPY");
  text += char(version);
  text += char(0);
  text += char(dict.size() & 0xff);
  text += char(dict.size() >> 8);
  if (version > 1) text += std::string(2, '\0');
  text += dict + std::string(dataBytes, 'x');
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

TEST(Npy, ReadsWhatOtherProgramsWrite) {
  // Key order, quotes, spaces and versions as other writers choose them.
  expectSame(readNpy(file("{\"shape\":(2,),'fortran_order':False,'descr':'<u2'}", 4), ""),
             Array{DType::u16, {2}, std::vector<std::byte>(4, std::byte('x'))});
  EXPECT_EQ(readNpy(file("{'descr': '<f8', 'fortran_order': False, 'shape': (), }\n", 8, 2), "").shape.size(),
            0u);
  EXPECT_EQ(readNpy(file("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }  \n", 8, 3), "").size(),
            2u);
}

std::string errorOf(const std::vector<std::byte>& bytes) {
  try {
    readNpy(bytes, "a.npy");
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Npy, AnyDeviationIsAnError) {
  const auto dict = [](const std::string& descr, const std::string& order, const std::string& shape) {
    return "{'descr': " + descr + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }";
  };
  EXPECT_NE(errorOf({}).find("is not a .npy file"), std::string::npos);
  EXPECT_NE(errorOf(file(dict("'<f4'", "False", "(2,)"), 7)).find("is cut off"), std::string::npos);
  EXPECT_NE(errorOf(file(dict("'<f4'", "False", "(2,)"), 9)).find("is longer"), std::string::npos);
  EXPECT_NE(errorOf(file(dict("'>f4'", "False", "(2,)"), 8)).find("'>f4'"), std::string::npos);
  EXPECT_NE(errorOf(file(dict("'<f4'", "True", "(2,)"), 8)).find("Fortran"), std::string::npos);
  EXPECT_NE(errorOf(file(dict("'<f4'", "False", "(2,)"), 8, 9)).find("version"), std::string::npos);
  for (const std::string shape :
       {"(-1,)", "(2)", "(2", "2", "(2,,)", "(2.0,)", "(99999999999999999999,)", "[2]"})
    EXPECT_NE(errorOf(file(dict("'<f4'", "False", shape), 8)).find("header"), std::string::npos) << shape;
  EXPECT_NE(errorOf(file("{'descr': '<f4', 'shape': (2,)}", 8)).find("header"), std::string::npos);
  EXPECT_NE(errorOf(file("{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (2,)}", 8))
                .find("header"),
            std::string::npos);
  EXPECT_NE(errorOf(file(dict("'<f4'", "False", "(2,)") + "garbage", 8)).find("header"), std::string::npos);
  EXPECT_NE(errorOf(file(dict("'<f8'", "False", "(4294967296, 4294967296, 4294967296)"), 8)).find("cut off"),
            std::string::npos);
}

TEST(Npy, DamagedFilesGiveAnArrayOrAFileError) {
  const std::vector<std::byte> original =
      file("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }   \n", 24);
  for (std::uint32_t round = 0; round < 20'000; ++round) {
    std::vector<std::byte> bytes = original;
    bytes[hashBits(1, round) % bytes.size()] = std::byte(hashBits(2, round));
    if (round % 3 == 0) bytes.resize(hashBits(3, round) % bytes.size());
    try {
      const Array array = readNpy(bytes, "damaged");
      ASSERT_EQ(array.bytes.size(), array.size() * sizeOf(array.dtype));
    } catch (const FileError&) {
    }
  }
}

TEST(Npy, WrongArraysAreNotWritten) {
  const TemporaryFolder folder;
  Array array = counting(DType::f32, {2, 2});
  array.shape = {5};
  EXPECT_THROW(writeNpy(folder / "a.npy", array), ValueError);
  array.shape = {-2, -2};
  EXPECT_THROW(writeNpy(folder / "a.npy", array), ValueError);
  EXPECT_EQ(folder.entries(), 0);
  EXPECT_THROW(readNpy(folder / "a.npy"), FileError);
}

}  // namespace
}  // namespace prt
