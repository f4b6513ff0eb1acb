// Which pictures a BTF has: from a manifest or from their names.

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/meso/btf_import.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <regex>

namespace prt {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMaxManifest = std::size_t(64) << 20;

Vec3 fromAngles(double theta, double phi) {
  const double t = radians(theta), p = radians(phi);
  return Vec3(DVec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)));
}

/// One entry of a manifest, with errors that name it.
class EntryReader {
 public:
  EntryReader(const std::string& name, std::size_t number)
      : where_(name + ": images[" + std::to_string(number) + "]") {}

  BtfEntry read(const json& entry) const {
    if (!entry.is_object()) fail("is not an object", R"(write {"file": ..., "light": ..., "view": ...})");
    BtfEntry out;
    const auto file = entry.find("file");
    if (file == entry.end() || !file->is_string()) fail("has no 'file'", "name its image");
    out.file = file->get<std::string>();
    const fs::path path(out.file);
    const bool outside =
        path.is_absolute() || std::ranges::any_of(path, [](const fs::path& p) { return p == ".."; });
    if (out.file.empty() || outside || out.file.find('\0') != std::string::npos)
      fail("names a file that is not beside the manifest or below", "use a relative name");
    out.light = direction(entry, "light");
    out.view = direction(entry, "view");
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& fix) const {
    throw FileError(what, where_, fix);
  }

  double number(const json& value, const std::string& what) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail("'" + what + "' is not a number", "write degrees or coordinates");
    return value.get<double>();
  }

  Vec3 direction(const json& entry, const char* name) const {
    const auto found = entry.find(name);
    if (found == entry.end()) fail(std::string("has no '") + name + "'", "give [x, y, z] or theta and phi");
    Vec3 d(0);
    if (found->is_array() && found->size() == 3) {
      DVec3 raw;
      for (int i = 0; i < 3; ++i) raw[i] = number((*found)[std::size_t(i)], name);
      const double size = length(raw);
      if (!(size > 1e-6) || !(size < 1e12))
        fail(std::string("'") + name + "' has no direction", "give a vector");
      d = Vec3(raw / size);
    } else if (found->is_object() && found->contains("theta") && found->contains("phi")) {
      d = fromAngles(number((*found)["theta"], name), number((*found)["phi"], name));
    } else {
      fail(std::string("'") + name + "' is no direction",
           "give [x, y, z] or {\"theta\": .., \"phi\": ..} in degrees");
    }
    if (!(d.z > 1e-4f))
      fail(std::string("'") + name + "' is not above the sample", "z is the sample's normal");
    return normalize(d);
  }

  std::string where_;
};

double encodingOf(const json& manifest, const std::string& name) {
  const auto found = manifest.find("encoding");
  if (found == manifest.end()) return 0;
  if (*found == "linear") return 1;
  if (*found == "srgb") return -1;
  if (found->is_number() && found->get<double>() >= 0.1 && found->get<double>() <= 10)
    return found->get<double>();
  throw FileError("'encoding' is unknown", name, "use linear, srgb or a gamma of 0.1 to 10");
}

double scaleOf(const json& manifest, const std::string& name) {
  const auto found = manifest.find("scale");
  if (found == manifest.end()) return 1;
  if (found->is_number() && found->get<double>() > 0 && found->get<double>() < 1e9)
    return found->get<double>();
  throw FileError("'scale' is not a positive number", name, "leave it out or give a factor");
}

/// Angles out of a name such as 00001_tl015_pl000_tv030_pv060.jpg; false when there are none.
bool anglesOf(const std::string& name, double (&angles)[4]) {
  static const std::regex pattern(
      R"(tl(-?\d+(?:\.\d+)?)_pl(-?\d+(?:\.\d+)?)_tv(-?\d+(?:\.\d+)?)_pv(-?\d+(?:\.\d+)?))");
  std::smatch match;
  if (name.size() > 1000 || !std::regex_search(name, match, pattern)) return false;
  for (int i = 0; i < 4; ++i) angles[i] = std::stod(match[std::size_t(i) + 1]);
  return true;
}

BtfSet fromNames(const fs::path& folder) {
  BtfSet set;
  set.folder = folder;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    double a[4];
    const std::string name = it->path().filename().string();
    if (!it->is_regular_file(error) || !anglesOf(name, a)) continue;
    if (!(a[0] < 90) || !(a[2] < 90) || a[0] < 0 || a[2] < 0)
      throw FileError("shows a light or view that is not above the sample", it->path().string(),
                      "leave it out");
    set.images.push_back({name, fromAngles(a[0], a[1]), fromAngles(a[2], a[3])});
    if (set.images.size() > kMaxBtfImages)
      throw FileError("holds more than " + std::to_string(kMaxBtfImages) + " images", folder.string(),
                      "use fewer");
  }
  if (error)
    throw FileError("cannot be listed: " + error.message(), folder.string(), "check its permissions");
  if (set.images.empty())
    throw FileError("holds no images named tlTTT_plPPP_tvTTT_pvPPP", folder.string(),
                    "name them so, or write a manifest.json");
  std::ranges::sort(set.images, {}, &BtfEntry::file);
  return set;
}

}  // namespace

BtfSet parseBtfManifest(std::string_view text, const std::string& name) {
  const json manifest = json::parse(text, nullptr, false);
  if (!manifest.is_object()) throw FileError("is not a JSON object", name, "check its syntax");
  if (manifest.value("format", json()) != "prt-btf")
    throw FileError("is not a BTF's manifest", name, R"(it begins with {"format": "prt-btf", ...})");
  const auto images = manifest.find("images");
  if (images == manifest.end() || !images->is_array() || images->empty())
    throw FileError("lists no 'images'", name, "name at least one");
  if (images->size() > kMaxBtfImages)
    throw FileError("lists more than " + std::to_string(kMaxBtfImages) + " images", name, "use fewer");
  BtfSet set;
  set.gamma = encodingOf(manifest, name);
  set.scale = scaleOf(manifest, name);
  for (std::size_t i = 0; i < images->size(); ++i)
    set.images.push_back(EntryReader(name, i).read((*images)[i]));
  return set;
}

BtfSet openBtf(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    const fs::path manifest = path / "manifest.json";
    return fs::is_regular_file(manifest, error) ? openBtf(manifest) : fromNames(path);
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (path.extension() != ".json") return fromNames(folder);
  const std::vector<std::byte> bytes = readFile(path, kMaxManifest);
  BtfSet set = parseBtfManifest({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
  set.folder = folder;
  return set;
}

}  // namespace prt
