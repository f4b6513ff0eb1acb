#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/core/image_header.h"
#include "libprt/core/image_io.h"
#include "libprt/core/oiio_setup.h"
#include "libprt/core/srgb.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace prt {
namespace {

struct Format {
  const char* name;  // what OpenImageIO calls it
  std::string_view magic;
  std::optional<ImageHeader> (*header)(std::span<const std::byte>);  // null: its decoder takes no memory yet
};

constexpr std::array<Format, 5> kFormats{{{"openexr", "\x76\x2f\x31\x01", readExrHeader},
                                          {"hdr", "#?RADIANCE", nullptr},
                                          {"hdr", "#?RGBE", nullptr},
                                          {"png", "\x89PNG\r\n\x1a\n", readPngHeader},
                                          {"jpeg", "\xff\xd8\xff", readJpegHeader}}};

/// One file being read; knows what to say when something is wrong with it.
class Reader {
 public:
  Reader(std::span<const std::byte> file, const std::string& name, const ImageLimits& limits)
      : file_(file), name_(name), limits_(limits), memory_(file.data(), file.size()) {}

  Image read() {
    open();
    checkSize();
    const std::vector<int> channels = chooseChannels();
    Image image = readWindow(channels);
    if (std::string_view(input_->format_name()) == "png" || std::string_view(input_->format_name()) == "jpeg")
      linearise(image);
    return inDisplayWindow(image);
  }

 private:
  [[noreturn]] void fail(const std::string& what,
                         const std::string& fix = "save it again, or give another file") const {
    throw FileError(what, name_, fix);
  }

  void open() {
    if (file_.empty()) fail("is empty");
    const std::string_view start(reinterpret_cast<const char*>(file_.data()),
                                 std::min<std::size_t>(file_.size(), 16));
    const auto format = std::find_if(kFormats.begin(), kFormats.end(),
                                     [&](const Format& f) { return start.starts_with(f.magic); });
    if (format == kFormats.end())
      fail("is not an EXR, HDR, PNG or JPEG image", "give an image in one of these formats");
    if (format->header) checkHeader(format->header(file_));
    setUpOiio();
    input_ = OIIO::ImageInput::create(format->name);
    if (!input_)
      fail("cannot be read: OpenImageIO lacks the format " + std::string(format->name),
           "install OpenImageIO with it");
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    input_->set_ioproxy(&memory_);
    if (!input_->open(name_, spec_, config)) fail("is damaged: " + input_->geterror());
  }

  void checkHeader(const std::optional<ImageHeader>& header) const {
    if (!header) fail("is damaged or cut off");
    checkExtent(header->width, header->height, 1);
    if (header->chunks > std::int64_t(file_.size() / 8)) fail("is damaged: too short for its size");
    if (header->chunkPixels > std::int64_t(limits_.maxBytes / sizeof(float))) fail("is damaged: giant tiles");
  }

  void checkExtent(std::int64_t width, std::int64_t height, int channels) const {
    if (width <= 0 || height <= 0 || channels <= 0) fail("has no pixels");
    if (std::max(width, height) > limits_.maxSide)
      fail("is larger than " + std::to_string(limits_.maxSide) + " pixels on a side", "give a smaller image");
    if (channels > limits_.maxChannels)
      fail("has " + std::to_string(channels) + " channels", "remove layers");
    const std::size_t bytes =
        std::size_t(width) * std::size_t(height) * std::size_t(channels) * sizeof(float);
    if (bytes > limits_.maxBytes)
      fail("needs " + std::to_string(bytes >> 20) + " MB, more than the limit of " +
               std::to_string(limits_.maxBytes >> 20) + " MB",
           "give a smaller image");
    // No compression here packs an image this tightly: the header promises what the file cannot hold.
    constexpr std::size_t kMostCompression = 8192, kSmall = std::size_t(16) << 20;
    if (bytes > kSmall && bytes / kMostCompression > file_.size()) fail("is damaged: too short for its size");
  }

  void checkSize() const {
    if (spec_.deep) fail("is a deep image", "flatten it first");
    if (spec_.depth > 1) fail("is a volume, not an image", "give a plain image");
    checkExtent(spec_.width, spec_.height, spec_.nchannels);
    checkExtent(spec_.full_width, spec_.full_height, 1);
  }

  /// Index of channel `wanted` of the layer ("" or ending in a dot), or nothing.
  std::optional<int> channel(const std::string& layer, char wanted) const {
    for (int i = 0; i < spec_.nchannels; ++i) {
      const std::string& name = spec_.channelnames[i];
      if (name.size() == layer.size() + 1 && name.starts_with(layer) && std::toupper(name.back()) == wanted)
        return i;
    }
    return {};
  }

  std::vector<int> chooseChannels() const {
    std::vector<std::string> layers{""};
    for (const std::string& name : spec_.channelnames)
      if (const auto dot = name.rfind('.'); dot != std::string::npos)
        layers.push_back(name.substr(0, dot + 1));
    for (const char* colour : {"RGB", "Y"})
      for (const std::string& layer : layers) {
        std::vector<int> chosen;
        for (const char* c = colour; *c; ++c)
          if (const auto index = channel(layer, *c)) chosen.push_back(*index);
        if (chosen.size() != std::strlen(colour)) continue;
        if (const auto alpha = channel(layer, 'A')) chosen.push_back(*alpha);
        return chosen;
      }
    if (spec_.nchannels == 1) return {0};
    fail("has neither R, G, B nor Y channels", "save it as RGB");
  }

  Image readWindow(const std::vector<int>& channels) {
    const auto [first, last] = std::minmax_element(channels.begin(), channels.end());
    const int stride = *last - *first + 1;
    std::vector<float> all(std::size_t(spec_.width) * spec_.height * stride);
    if (!input_->read_image(0, 0, *first, *last + 1, OIIO::TypeDesc::FLOAT, all.data()))
      fail("is damaged: " + input_->geterror());
    Image image(spec_.width, spec_.height, int(channels.size()));
    for (std::size_t p = 0; p < image.pixels(); ++p)
      for (std::size_t c = 0; c < channels.size(); ++c)
        image.data[p * channels.size() + c] = all[p * stride + std::size_t(channels[c] - *first)];
    return image;
  }

  void linearise(Image& image) const {
    const bool linear = OIIO::Strutil::iequals(spec_.get_string_attribute("oiio:ColorSpace"), "linear");
    const int colours = image.channels % 2 ? image.channels : image.channels - 1;
    std::array<float, 256> table;
    for (int i = 0; i < 256; ++i) table[i] = decodeSrgb(float(i) / 255);
    const bool bytes = spec_.format == OIIO::TypeDesc::UINT8;
    for (std::size_t p = 0; p < image.pixels(); ++p) {
      float* pixel = image.data.data() + p * image.channels;
      const float alpha = colours < image.channels ? pixel[colours] : 1;
      for (int c = 0; c < colours; ++c) {
        if (!linear) pixel[c] = bytes ? table[std::lround(pixel[c] * 255)] : decodeSrgb(pixel[c]);
        pixel[c] *= alpha;
      }
    }
  }

  Image inDisplayWindow(Image& image) const {
    const int dx = spec_.x - spec_.full_x, dy = spec_.y - spec_.full_y;
    if (dx == 0 && dy == 0 && spec_.width == spec_.full_width && spec_.height == spec_.full_height)
      return std::move(image);
    Image full(spec_.full_width, spec_.full_height, image.channels);
    for (int y = std::max(0, -dy); y < image.height && y + dy < full.height; ++y) {
      const int from = std::max(0, -dx), to = std::min(image.width, full.width - dx);
      if (from < to)
        std::copy(image.pixel(from, y), image.pixel(from, y) + std::size_t(to - from) * image.channels,
                  full.pixel(from + dx, y + dy));
    }
    return full;
  }

  std::span<const std::byte> file_;
  std::string name_;
  ImageLimits limits_;
  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
};

}  // namespace

Image readImage(const std::filesystem::path& path, const ImageLimits& limits) {
  return readImage(readFile(path, limits.maxBytes), path.string(), limits);
}

Image readImage(std::span<const std::byte> file, const std::string& name, const ImageLimits& limits) {
  return Reader(file, name, limits).read();
}

}  // namespace prt
