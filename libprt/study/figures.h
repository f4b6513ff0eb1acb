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
/// All figures, by name: "biscale-4", "biscale-6".
const std::vector<FigureInfo>& figures();

/// Makes one into a folder (made where it is not there): PNG files and index.html. Returns what is in it and
/// the numbers that belong to it. Throws ValueError, naming the choices, when there is none of that name;
/// FileError; Cancelled.
nlohmann::json makeFigure(const std::string& name, const std::filesystem::path& folder, Job& job);

}  // namespace prt
