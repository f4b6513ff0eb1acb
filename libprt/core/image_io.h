#pragma once
// Image files in and out: OpenEXR, Radiance HDR and PNG; JPEG in. Nothing else is opened. What a file is
// is decided by its contents, not by its name.

#include "libprt/core/image.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace prt {

struct ImageLimits {
  int maxSide = 1 << 16;                        ///< pixels
  int maxChannels = 64;                         ///< in the file; at most 4 are kept
  std::size_t maxBytes = std::size_t(2) << 30;  ///< of the decoded image
};

/// Reads an image as linear Rec.709 floats. Kept are R, G, B and A of the first part (without layer name,
/// else of the first layer that has them), or else the grey channel (with A if there is one): 1 to 4
/// channels. PNG and JPEG are decoded from sRGB, unless they are marked linear, and their alpha is multiplied
/// in, as EXR has it. An EXR whose data window is not its display window comes back as the display window,
/// black outside of the data. Values are not changed otherwise: negative and non-finite ones stay. Throws
/// FileError when the file is missing, empty, of another format, truncated, damaged, or beyond `limits`.
Image readImage(const std::filesystem::path& path, const ImageLimits& limits = {});

/// The same from memory; `name` is what errors call it.
Image readImage(std::span<const std::byte> file, const std::string& name, const ImageLimits& limits = {});

struct ImageWriteOptions {
  bool png16 = false;  ///< PNG with 16 bits per channel instead of 8
  bool alreadySrgb =
      false;  ///< the values are display-encoded (see toDisplay): PNG takes them, and alpha, as they are
};

/// Writes an image, atomically; the format follows the extension: .exr (32-bit float, ZIP, channels Y, YA,
/// RGB, RGBA), .hdr (RGB; alpha is left out) or .png (sRGB, clamped to 0..1, NaN as 0; alpha divided out).
/// Throws FileError when it cannot be written or the extension is another, ValueError when the image is
/// empty or does not have 1 to 4 channels.
void writeImage(const std::filesystem::path& path, const Image& image, const ImageWriteOptions& options = {});

}  // namespace prt
