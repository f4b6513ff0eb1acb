#include "libprt/project/export_manifest.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"

#include <system_error>

namespace prt {

ExportManifest::ExportManifest(std::filesystem::path folder, const std::string& kind)
    : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (!std::filesystem::is_directory(folder_, error))
    throw FileError("is not a folder and cannot be made one", folder_.string(), "choose another name");
  json_ = {{"format", "prt-export"},
           {"version", 1},
           {"kind", kind},
           {"program", "prt " PRT_VERSION},
           {"frame", "right-handed, +Y up; transfer and light are about the axes of the object frame"},
           {"basis", "real spherical harmonics, orthonormal, index l(l+1)+m, no Condon-Shortley sign"},
           {"colour", "linear Rec.709"},
           {"files", nlohmann::json::object()}};
}

void ExportManifest::setCameras(const Recipe& recipe, const Box3& bounds) {
  nlohmann::json list = nlohmann::json::array();
  const auto vector = [](const Vec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
  const auto add = [&](const std::string& name, const Camera& c) {
    list.push_back({{"name", name},
                    {"eye", vector(c.eye)},
                    {"target", vector(c.target)},
                    {"up", vector(c.up)},
                    {"vfov_deg", degrees(c.verticalFov)}});
  };
  for (const CameraRecipe& camera : recipe.cameras) add(camera.name, camera.camera());
  if (recipe.cameras.empty()) add("default", frameBox(bounds));
  json_["cameras"] = list;
}

void ExportManifest::addArray(const std::string& name, const Array& array, const std::string& doc) {
  const std::string file = name + ".npy";
  files_.push_back(file);
  json_["files"][file] = {{"name", name},
                          {"dtype", array.dtype == DType::i32 ? "int32" : "float32"},
                          {"shape", array.shape},
                          {"doc", doc}};
}

void ExportManifest::addFile(const std::string& file, const std::string& doc) {
  files_.push_back(file);
  json_["files"][file] = {{"doc", doc}};
}

ExportedFiles ExportManifest::finish() {
  writeFile(folder_ / "manifest.json", json_.dump(2) + "\n");
  files_.push_back("manifest.json");
  return files_;
}

}  // namespace prt
