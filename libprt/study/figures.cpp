#include "libprt/study/figures.h"

#include "libprt/core/error.h"
#include "libprt/study/figure_list.h"

#include <nlohmann/json.hpp>

namespace prt {
namespace {

struct Entry {
  FigureInfo info;
  nlohmann::json (*make)(const FigureRequest&, Job&);
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {{"biscale", "all of the following and the paper's numbers, on one page; takes minutes"},
       makeBiscaleAll},
      {{"biscale-1", "a model without and with either scale"}, makeBiscale1},
      {{"biscale-3", "a rock with three kinds of macro transport"}, makeBiscale3},
      {{"biscale-4", "the weave's radiance transfer texture on a square: two views, five lights"},
       makeBiscale4},
      {{"biscale-5", "radiance transfer textures on a model"}, makeBiscale5},
      {{"biscale-6",
        "a woven bird without and with the macro scale and views, and its id map (figures 2 and 6)"},
       makeBiscale6},
      {{"biscale-truth", "stucco on a rock against the displaced surface, path traced"}, makeBiscaleTruth}};
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

nlohmann::json makeFigure(const std::string& name, const FigureRequest& request, Job& job) {
  std::string names;
  for (const Entry& entry : entries()) {
    if (entry.info.name != name) {
      names += (names.empty() ? "" : ", ") + entry.info.name;
      continue;
    }
    std::error_code error;
    std::filesystem::create_directories(request.folder, error);
    if (!std::filesystem::is_directory(request.folder, error))
      throw FileError("is not a folder and cannot be made one", request.folder.string(),
                      "choose another name");
    return entry.make(request, job);
  }
  throw ValueError("there is no figure '" + name + "'", "figures", "choose one of " + names);
}

}  // namespace prt
