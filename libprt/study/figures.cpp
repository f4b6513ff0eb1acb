#include "libprt/study/figures.h"

#include "libprt/core/error.h"
#include "libprt/study/figure_list.h"

#include <nlohmann/json.hpp>

namespace prt {
namespace {

struct Entry {
  FigureInfo info;
  nlohmann::json (*make)(const std::filesystem::path&, Job&);
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {{"biscale-4", "the weave's radiance transfer texture on a square: two views, five lights"},
       makeBiscale4},
      {{"biscale-6",
        "a woven bird without and with the macro scale and views, and its id map (figures 2 and 6)"},
       makeBiscale6}};
  return all;
}

}  // namespace

const std::vector<FigureInfo>& figures() {
  static const std::vector<FigureInfo> infos = [] {
    std::vector<FigureInfo> list;
    for (const Entry& entry : entries()) list.push_back(entry.info);
    return list;
  }();
  return infos;
}

nlohmann::json makeFigure(const std::string& name, const std::filesystem::path& folder, Job& job) {
  std::string names;
  for (const Entry& entry : entries()) {
    if (entry.info.name != name) {
      names += (names.empty() ? "" : ", ") + entry.info.name;
      continue;
    }
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder, error))
      throw FileError("is not a folder and cannot be made one", folder.string(), "choose another name");
    return entry.make(folder, job);
  }
  throw ValueError("there is no figure '" + name + "'", "figures", "choose one of " + names);
}

}  // namespace prt
