#pragma once
// The figures that makeFigure() knows. Internal to study: to add one, declare it here and list it in
// figures.cpp.

#include "libprt/core/job.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace prt {

nlohmann::json makeBiscale4(const std::filesystem::path& folder, Job& job);
nlohmann::json makeBiscale6(const std::filesystem::path& folder, Job& job);

}  // namespace prt
