#include "libprt/core/image_io.h"
#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/core/sampling.h"
#include "libprt/core/srgb.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace prt {
namespace {

using test::TemporaryFolder;

Image gradient(int width, int height, int channels) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = hashUniform(1, i);
  return image;
}

void expectSame(const Image& a, const Image& b, double tolerance) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  ASSERT_EQ(a.channels, b.channels);
  for (std::size_t i = 0; i < a.data.size(); ++i) ASSERT_NEAR(a.data[i], b.data[i], tolerance) << i;
}

/// Writes a file of a kind that writeImage does not make.
void writeRaw(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
              const std::vector<float>& values) {
  const auto out = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(out && out->open(path.string(), spec)) << path;
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()) && out->close());
}

TEST(ImageIo, ExrKeepsEveryBitOfEveryChannelCount) {
  const TemporaryFolder folder;
  for (int channels = 1; channels <= 4; ++channels) {
    Image image = gradient(7, 5, channels);
    image.data[0] = -3;
    image.data[1] = 1e30f;
    image.data[2] = std::numeric_limits<float>::infinity();
    image.data[3] = 1e-40f;
    writeImage(folder / "a.exr", image);
    const Image back = readImage(folder / "a.exr");
    ASSERT_EQ(back.channels, channels);
    EXPECT_EQ(std::memcmp(back.data.data(), image.data.data(), image.data.size() * sizeof(float)), 0);
  }
}

TEST(ImageIo, ExrChannelsHaveTheirNames) {
  const TemporaryFolder folder;
  writeImage(folder / "a.exr", gradient(2, 2, 4));
  const auto in = OIIO::ImageInput::open((folder / "a.exr").string());
  EXPECT_EQ(in->spec().channelnames, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::FLOAT);
}

TEST(ImageIo, SameImageSameBytes) {
  const TemporaryFolder folder;
  const Image image = gradient(9, 4, 3);
  for (const char* extension : {".exr", ".hdr", ".png"}) {
    writeImage(folder / (std::string("a") + extension), image);
    writeImage(folder / (std::string("b") + extension), image);
    EXPECT_EQ(readFile(folder / (std::string("a") + extension)),
              readFile(folder / (std::string("b") + extension)))
        << extension;
    const auto in = OIIO::ImageInput::open((folder / (std::string("a") + extension)).string());
    EXPECT_EQ(in->spec().get_string_attribute("DateTime"), "") << "the time would differ: " << extension;
  }
}

TEST(ImageIo, HdrRoundsToItsEightBits) {
  const TemporaryFolder folder;
  Image image = gradient(40, 3, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] *= std::exp2(float(i % 37) - 18);
  writeImage(folder / "a.hdr", image);
  const Image back = readImage(folder / "a.hdr");
  double bias = 0;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 40; ++x) {
      const Rgb a = image.rgb(x, y), b = back.rgb(x, y);
      const float largest = std::max({a.r, a.g, a.b});
      for (int c = 0; c < 3; ++c) {
        EXPECT_LE(std::abs(a[c] - b[c]), largest / 255) << "half a step of the largest channel's 128 to 255";
        bias += (b[c] - a[c]) / largest / 360;
      }
    }
  EXPECT_LT(std::abs(bias), 5e-4) << "cutting off would be -2.6e-3";
}

TEST(ImageIo, HdrTakesOtherChannelCountsAndBadNumbers) {
  const TemporaryFolder folder;
  Image grey(2, 1, 1);
  grey.data = {-1, std::numeric_limits<float>::quiet_NaN()};
  writeImage(folder / "a.hdr", grey);
  const Image back = readImage(folder / "a.hdr");
  EXPECT_EQ(back.channels, 3);
  for (float value : back.data) EXPECT_EQ(value, 0);
}

TEST(ImageIo, PngIsSrgb) {
  const TemporaryFolder folder;
  Image image(4, 1, 3);
  image.data = {0, 0, 0, 0.21586f, 0.21586f, 0.21586f,
                1, 1, 1, 7,        -2,       std::numeric_limits<float>::quiet_NaN()};
  writeImage(folder / "a.png", image);
  const auto in = OIIO::ImageInput::open((folder / "a.png").string());
  std::vector<unsigned char> bytes(12);
  ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes.data()));
  EXPECT_EQ(bytes, (std::vector<unsigned char>{0, 0, 0, 128, 128, 128, 255, 255, 255, 255, 0, 0}));
  EXPECT_NEAR(readImage(folder / "a.png").data[3], decodeSrgb(128 / 255.0f), 1e-7);
}

TEST(ImageIo, PngRoundTripIsWithinItsSteps) {
  const TemporaryFolder folder;
  for (int channels : {1, 3}) {
    const Image image = gradient(16, 16, channels);
    writeImage(folder / "a.png", image);
    expectSame(readImage(folder / "a.png"), image,
               0.0046);  // half a step of 1/255 where the curve is steepest
    writeImage(folder / "a.png", image, {.png16 = true});
    expectSame(readImage(folder / "a.png"), image, 2e-5);
  }
}

TEST(ImageIo, PngAlphaIsDividedOutAndMultipliedIn) {
  const TemporaryFolder folder;
  Image image(3, 1, 4);
  image.data = {0.25f, 0.1f, 0, 0.5f, 0, 0, 0, 0, 1, 0.5f, 0.25f, 1};
  for (bool sixteen : {false, true}) {
    writeImage(folder / "a.png", image, {.png16 = sixteen});
    expectSame(readImage(folder / "a.png"), image, sixteen ? 5e-5 : 5e-3);
  }
  const auto in = OIIO::ImageInput::open((folder / "a.png").string());
  EXPECT_EQ(in->spec().nchannels, 4);
}

TEST(ImageIo, AlreadyEncodedValuesGoToPngAsTheyAre) {
  const TemporaryFolder folder;
  Image image(1, 1, 4);
  image.data = {0.2f, 0.4f, 0.6f, 0.8f};
  writeImage(folder / "a.png", image, {.png16 = true, .alreadySrgb = true});
  const Image back = readImage(folder / "a.png");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.data[c], 0.8f * decodeSrgb(image.data[c]), 1e-4);
}

TEST(ImageIo, JpegIsRead) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(16, 16, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("CompressionQuality", 100);
  writeRaw(folder / "a.jpg", spec, std::vector<float>(16 * 16 * 3, 128 / 255.0f));
  const Image image = readImage(folder / "a.jpg");
  ASSERT_EQ(image.channels, 3);
  EXPECT_NEAR(image.rgb(8, 8).g, 0.2158f, 0.01f);
}

TEST(ImageIo, ExrDataWindowIsPlacedInTheDisplayWindow) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(2, 2, 3, OIIO::TypeDesc::FLOAT);
  spec.x = 3, spec.y = 1;
  spec.full_x = 1, spec.full_y = 1, spec.full_width = 3, spec.full_height = 4;
  writeRaw(folder / "a.exr", spec, std::vector<float>(12, 1.0f));
  const Image image = readImage(folder / "a.exr");
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(image.rgb(x, y).r, x == 2 && y < 2 ? 1 : 0) << x << ' ' << y;
}

TEST(ImageIo, ColourIsFoundAmongLayers) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(1, 1, 7, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"depth.Z", "light.B", "light.G", "light.R", "other.R", "other.G", "other.B"};
  writeRaw(folder / "a.exr", spec, {9, 3, 2, 1, 7, 7, 7});
  const Image image = readImage(folder / "a.exr");
  ASSERT_EQ(image.channels, 3);
  EXPECT_EQ(image.rgb(0, 0), Rgb(1, 2, 3));

  spec = OIIO::ImageSpec(1, 1, 2, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"U", "V"};
  writeRaw(folder / "a.exr", spec, {1, 2});
  EXPECT_THROW(readImage(folder / "a.exr"), FileError);
}

TEST(ImageIo, ContentsDecideNotTheName) {
  const TemporaryFolder folder;
  writeImage(folder / "a.exr", gradient(3, 3, 3));
  std::filesystem::rename(folder / "a.exr", folder / "a.png");
  EXPECT_EQ(readImage(folder / "a.png").width, 3);
}

std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no FileError";
}

TEST(ImageIo, BadFilesGetAClearError) {
  const TemporaryFolder folder;
  writeFile(folder / "empty.exr", "");
  writeFile(folder / "text.exr", "This is not an image.");
  EXPECT_NE(errorOf([&] { readImage(folder / "missing.exr"); }).find("cannot open it"), std::string::npos);
  EXPECT_NE(errorOf([&] { readImage(folder / "empty.exr"); }).find("is empty"), std::string::npos);
  EXPECT_NE(errorOf([&] { readImage(folder / "text.exr"); }).find("is not an EXR, HDR, PNG or JPEG"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { readImage(folder.path()); }).find("is a folder"), std::string::npos);
}

TEST(ImageIo, TruncatedFilesAreRefusedAtEveryLength) {
  const TemporaryFolder folder;
  for (const char* extension : {".exr", ".hdr", ".png"}) {
    const auto path = folder / (std::string("a") + extension);
    writeImage(path, gradient(24, 9, 3));
    std::vector<std::byte> bytes = readFile(path);
    for (std::size_t length = 0; length < bytes.size(); length += length < 64 ? 1 : 13)
      EXPECT_THROW(readImage(std::span(bytes).first(length), "cut", {}), FileError)
          << extension << " cut to " << length;
  }
}

/// Makes the checksums of a PNG's chunks right, so that damage reaches the decoder.
void repairPngChecksums(std::vector<std::byte>& png) {
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | std::size_t(png[at + i]);
    if (at + 12 + length > png.size()) return;
    std::uint32_t crc = ~0u;  // bit by bit
    for (std::size_t i = at + 4; i < at + 8 + length; ++i) {
      crc ^= std::uint32_t(png[i]);
      for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
    }
    for (int i = 0; i < 4; ++i) png[at + 8 + length + i] = std::byte(~crc >> (24 - 8 * i));
    at += 12 + length;
  }
}

TEST(ImageIo, DamagedFilesGiveAnImageOrAFileError) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(24, 9, 3, OIIO::TypeDesc::UINT8);
  writeRaw(folder / "a.jpg", spec, gradient(24, 9, 3).data);
  for (const char* extension : {".exr", ".hdr", ".png", ".jpg"}) {
    const auto path = folder / (std::string("a") + extension);
    if (std::string(extension) != ".jpg") writeImage(path, gradient(24, 9, 3));
    const std::vector<std::byte> original = readFile(path);
    for (std::uint32_t round = 0; round < 1000; ++round) {
      std::vector<std::byte> bytes = original;
      const int changes = 1 + int(hashBits(1, round) % 4);
      for (int c = 0; c < changes; ++c) {
        // Half of the changes go to the header, where the sizes are.
        const std::size_t range =
            hashUniform(2, round, c) < 0.5f ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
        bytes[hashBits(3, round, c) % range] = std::byte(hashBits(4, round, c));
      }
      if (std::string(extension) == ".png" && round % 20 == 0) repairPngChecksums(bytes);
      try {
        const Image image = readImage(bytes, "damaged", {.maxBytes = 1 << 20});
        ASSERT_EQ(image.data.size(), image.pixels() * image.channels);
      } catch (const FileError&) {
      }
    }
  }
}

TEST(ImageIo, GiantClaimsAreRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  writeImage(folder / "a.hdr", gradient(4, 4, 3));
  std::string text;
  for (std::byte b : readFile(folder / "a.hdr")) text += char(b);
  const auto at = text.find("-Y 4 +X 4");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 9, "-Y 10000 +X 10000");
  EXPECT_NE(
      errorOf([&] { readImage(std::as_bytes(std::span(text)), "giant", {}); }).find("too short for its size"),
      std::string::npos);
  text.replace(at, 17, "-Y 99999999 +X 99999999");
  EXPECT_NE(errorOf([&] { readImage(std::as_bytes(std::span(text)), "giant", {}); }), "no FileError");
}

TEST(ImageIo, GiantPartsAreRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  writeImage(folder / "a.png", gradient(4, 4, 3));
  std::vector<std::byte> png = readFile(folder / "a.png");
  png[33] = std::byte(0x7f);  // length of the chunk after the header
  EXPECT_NE(errorOf([&] { readImage(png, "giant", {}); }).find("cut off"), std::string::npos);

  writeImage(folder / "a.exr", gradient(4, 4, 3));
  std::string exr;
  for (std::byte b : readFile(folder / "a.exr")) exr += char(b);
  const auto window = exr.find("box2i", exr.find("dataWindow")) + 6 + 4;  // its value: x0 y0 x1 y1
  const std::int32_t far = 60'000;
  std::memcpy(exr.data() + window + 12, &far, 4);
  EXPECT_NE(errorOf([&] { readImage(std::as_bytes(std::span(exr)), "giant", {}); }).find("too short"),
            std::string::npos);
  const std::int32_t negative = -5;
  std::memcpy(exr.data() + window + 12, &negative, 4);
  EXPECT_NE(errorOf([&] { readImage(std::as_bytes(std::span(exr)), "giant", {}); }).find("is damaged"),
            std::string::npos);
}

TEST(ImageIo, PngChecksumsAreChecked) {
  const TemporaryFolder folder;
  writeImage(folder / "a.png", gradient(4, 4, 3));
  std::vector<std::byte> png = readFile(folder / "a.png");
  png[png.size() - 20] ^= std::byte(1);
  EXPECT_NE(errorOf([&] { readImage(png, "flipped", {}); }).find("is damaged or cut off"), std::string::npos);
  repairPngChecksums(png);
  EXPECT_EQ(errorOf([&] { readImage(png, "flipped", {}); }).find("is damaged or cut off"), std::string::npos);
}

TEST(ImageIo, LimitsAreKept) {
  const TemporaryFolder folder;
  writeImage(folder / "a.exr", gradient(32, 4, 4));
  EXPECT_THROW(readImage(folder / "a.exr", {.maxSide = 31}), FileError);
  EXPECT_THROW(readImage(folder / "a.exr", {.maxChannels = 3}), FileError);
  EXPECT_THROW(readImage(folder / "a.exr", {.maxBytes = 32 * 4 * 16 - 1}), FileError);
  EXPECT_EQ(readImage(folder / "a.exr", {.maxSide = 32, .maxChannels = 4}).width, 32);
}

TEST(ImageIo, FailedWritesLeaveNothing) {
  const TemporaryFolder folder;
  const Image image = gradient(2, 2, 3);
  EXPECT_THROW(writeImage(folder / "a.tiff", image), FileError);
  EXPECT_THROW(writeImage(folder / "a", image), FileError);
  EXPECT_THROW(writeImage(folder / "none" / "a.exr", image), FileError);
  EXPECT_THROW(writeImage(folder / "a.exr", Image()), ValueError);
  EXPECT_THROW(writeImage(folder / "a.exr", gradient(2, 2, 5)), ValueError);
  EXPECT_EQ(folder.entries(), 0);
  writeImage(folder / "B.EXR", image);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(ImageIo, ReadsTheProbesOfTheWorld) {
  PRT_NEEDS_SHARED_DATA();
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::sharedData("probes"))) {
    const Image image = readImage(entry.path());
    EXPECT_GE(image.channels, 3) << entry.path();
    EXPECT_GE(image.width, 256) << entry.path();
    double sum = 0;
    for (float value : image.data) sum += value;
    EXPECT_TRUE(sum > 0 && std::isfinite(sum)) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 10);
}

}  // namespace
}  // namespace prt
