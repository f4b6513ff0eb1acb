#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/core/image_io.h"
#include "libprt/core/oiio_setup.h"
#include "libprt/core/srgb.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace prt {
namespace {

struct Pixels {
  OIIO::ImageSpec spec;
  const void* data;
};

void write(const char* format, const std::filesystem::path& path, const Pixels& pixels) {
  setUpOiio();
  AtomicFile file(path);
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
  const auto fail = [&](const std::string& why) {
    throw FileError("cannot write it: " + why, path.string(),
                    "check the disk's space and the folder's permissions");
  };
  if (!out) fail("OpenImageIO lacks the format " + std::string(format));
  if (!out->open(file.path().string(), pixels.spec)) fail(out->geterror());
  if (!out->write_image(pixels.spec.format, pixels.data)) fail(out->geterror());
  if (!out->close()) fail(out->geterror());
  file.commit();
}

OIIO::ImageSpec specOf(const Image& image, int channels, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(image.width, image.height, channels, type);
  const std::vector<std::string> colours =
      channels < 3 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  spec.channelnames = colours;
  spec.alpha_channel = -1;
  if (channels % 2 == 0) {
    spec.channelnames.push_back("A");
    spec.alpha_channel = channels - 1;
  }
  return spec;
}

void writeExr(const std::filesystem::path& path, const Image& image) {
  OIIO::ImageSpec spec = specOf(image, image.channels, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("DateTime", "");  // else OpenImageIO writes the time, and no two files are the same
  write("openexr", path, {spec, image.data.data()});
}

/// What OpenImageIO's writer will cut to the nearest RGBE colour; left alone it always cuts downwards.
/// RGBE knows no sign, NaN or infinity.
Rgb roundedForRgbe(const Rgb& colour) {
  Rgb c;
  for (int i = 0; i < 3; ++i) c[i] = colour[i] > 0 ? std::min(colour[i], 1e38f) : 0.0f;
  const float largest = std::max({c.r, c.g, c.b});
  if (largest < 1e-30f) return Rgb(0);
  int exponent;
  const float mantissa = std::frexp(largest, &exponent);
  const float step = std::ldexp(1.0f, exponent - (mantissa * 256 >= 255.5f ? 7 : 8));
  return c + 0.5f * step;
}

void writeHdr(const std::filesystem::path& path, const Image& image) {
  std::vector<Rgb> rgb;
  rgb.reserve(image.pixels());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) rgb.push_back(roundedForRgbe(image.rgb(x, y)));
  write("hdr", path, {specOf(image, 3, OIIO::TypeDesc::FLOAT), rgb.data()});
}

template <class T>
std::vector<T> quantised(const Image& image, const ImageWriteOptions& options) {
  constexpr float kTop = float(T(~T(0)));
  const int colours = image.channels % 2 ? image.channels : image.channels - 1;
  std::vector<T> out(image.data.size());
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    const float* pixel = image.data.data() + p * image.channels;
    const bool divide = colours < image.channels && pixel[colours] > 0 && !options.alreadySrgb;
    const float alpha = divide ? std::min(pixel[colours], 1.0f) : 1.0f;
    for (int c = 0; c < image.channels; ++c) {
      const float value = c < colours ? pixel[c] / alpha : pixel[c];
      const float clamped = value > 0 ? std::min(value, 1.0f) : 0.0f;  // NaN gives 0
      out[p * image.channels + c] =
          T(std::lround(kTop * (c < colours && !options.alreadySrgb ? encodeSrgb(clamped) : clamped)));
    }
  }
  return out;
}

template <class T>
void writePng(const std::filesystem::path& path, const Image& image, const ImageWriteOptions& options,
              OIIO::TypeDesc type) {
  const std::vector<T> values = quantised<T>(image, options);
  OIIO::ImageSpec spec = specOf(image, image.channels, type);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  write("png", path, {spec, values.data()});
}

}  // namespace

void writeImage(const std::filesystem::path& path, const Image& image, const ImageWriteOptions& options) {
  if (image.width < 1 || image.height < 1 || image.channels < 1 || image.channels > 4 ||
      image.data.size() != image.pixels() * image.channels)
    throw ValueError("cannot write an image of " + std::to_string(image.width) + " x " +
                         std::to_string(image.height) + " pixels with " + std::to_string(image.channels) +
                         " channels",
                     path.string(), "give 1 to 4 channels and as many values as pixels need");
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (extension == ".exr") return writeExr(path, image);
  if (extension == ".hdr") return writeHdr(path, image);
  if (extension == ".png" && options.png16)
    return writePng<std::uint16_t>(path, image, options, OIIO::TypeDesc::UINT16);
  if (extension == ".png") return writePng<std::uint8_t>(path, image, options, OIIO::TypeDesc::UINT8);
  throw FileError("'" + extension + "' is not an image format that can be written", path.string(),
                  "use .exr, .hdr or .png");
}

}  // namespace prt
