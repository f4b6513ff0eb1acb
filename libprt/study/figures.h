#pragma once
// Figures of the papers, made anew: pictures and a page that shows them.

#include "libprt/core/job.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace prt {

struct FigureInfo {
  std::string name;
  std::string shows;  ///< one line for people
};
/// All figures, by name: "biscale" (all of that paper and its numbers), "biscale-1", ...
const std::vector<FigureInfo>& figures();

struct FigureRequest {
  std::filesystem::path folder;  ///< made where it is not there
  std::string mesh;              ///< in place of the built-in models: a file or builtin:NAME; empty: those
};

/// Makes one: PNG files and index.html. Returns what is in it and the numbers that belong to it. Throws
/// ValueError, naming the choices, when there is none of that name; FileError; what baking throws; Cancelled.
nlohmann::json makeFigure(const std::string& name, const FigureRequest& request, Job& job);

}  // namespace prt
