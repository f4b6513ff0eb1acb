#pragma once
// Acquired BTFs - pictures of a flat sample by light and view - to radiance transfer textures. Two forms of
// input:
//
// manifest.json: {"format": "prt-btf", "images": [{"file": "a.exr", "light": D, "view": D}, ...]} where D is
//   [x, y, z] towards the light or viewer in the sample's frame (z its normal, x along the pictures' rows),
//   or
//   {"theta": degrees from the normal, "phi": degrees from x}. Optional: "encoding": "linear", "srgb" or a
//   gamma such as 2.2 (default: what the file format says, PNG and JPEG sRGB), "scale": factor to radiance
//   under a light of irradiance 1 across its beam (a white Lambert sample lit at 0 degrees then shows 1/pi).
//   Files lie beside the manifest or below.
// A folder of pictures named as Bonn's 81 x 81 sets are: ..tlTTT_plPPP_tvTTT_pvPPP.. = theta and phi of light
// and view,
//   in degrees.
//
// Pictures are of the whole sample, the same for all: rectified; each is averaged down to the texels. Whether
// the sample tiles is left as it is.
//
// Where every view was seen under some twenty lights or more (Bonn style), lights are fitted view by view
// (light_projection.h) and views interpolated between the measured ones: radial functions |d| with a
// constant, exact where measured. Sets with few lights per view (CUReT style: 205 pairs) are fitted as a
// whole, light functions times smooth functions of the view, the smoother the less is known.

#include "libprt/core/job.h"
#include "libprt/core/math.h"
#include "libprt/meso/rtt.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace prt {

struct BtfEntry {
  std::string file;  ///< relative to the set's folder
  Vec3 light{0, 0, 1}, view{0, 0, 1};
};

struct BtfSet {
  std::filesystem::path folder;
  std::vector<BtfEntry> images;
  double gamma = 0;  ///< of the stored numbers; 0 = as the format says, 1 = linear, -1 = sRGB
  double scale = 1;
};

/// Most pictures of a set.
inline constexpr std::size_t kMaxBtfImages = 200'000;

/// Reads a manifest's text; `name` is what errors call it. Throws FileError: what, where, what to do.
BtfSet parseBtfManifest(std::string_view text, const std::string& name);

/// A manifest file, a folder of pictures, or any picture in such a folder. Throws FileError.
BtfSet openBtf(const std::filesystem::path& path);

struct BtfImportSettings {
  int texels = 64, views = 8, bands = 5;
};

/// Reads all pictures and fits. The job counts pictures. Throws FileError for what cannot be read, ValueError
/// for settings out of range.
Rtt importBtf(const BtfSet& set, const BtfImportSettings& settings, Job& job);

/// How views were told apart in a set: [views] the numbers of the pictures that share a view (within 0.1
/// degree).
std::vector<std::vector<std::size_t>> groupByView(const BtfSet& set);

/// Weights that take values at measured views to the cells of a square: [cells, measured], rows add up to 1.
std::vector<double> viewWeights(std::span<const Vec3> measured, const ViewSquare& cells);

}  // namespace prt
