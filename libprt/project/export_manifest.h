#pragma once
// manifest.json of an export. Internal to project/.

#include "libprt/core/array.h"
#include "libprt/project/export.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace prt {

class ExportManifest {
 public:
  /// Makes the folder if it is not there. Throws FileError when that cannot be.
  ExportManifest(std::filesystem::path folder, const std::string& kind);

  template <class T>
  ExportManifest& set(const std::string& name, const T& value) {
    json_[name] = value;
    return *this;
  }
  /// "cameras": those of the recipe, or where it has none a "default" one that frames the scene, as
  /// pictures are made with.
  void setCameras(const Recipe& recipe, const Box3& bounds);
  /// A file NAME.npy.
  void addArray(const std::string& name, const Array& array, const std::string& doc);
  void addFile(const std::string& file, const std::string& doc);
  /// Writes it; returns all files, the manifest included.
  ExportedFiles finish();

 private:
  std::filesystem::path folder_;
  nlohmann::json json_;
  ExportedFiles files_;
};

}  // namespace prt
