#pragma once
// The page that prt demo leaves: one file, nothing loaded from elsewhere.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace prt::cli {

struct DemoScene {
  std::string name;
  std::string caption;
  std::vector<std::filesystem::path> frames;  ///< PNGs of the light turning once around
  std::vector<std::pair<std::string, std::string>> facts;
};

/// The page as HTML, pictures inside.
std::string demoPage(const std::vector<DemoScene>& scenes);

std::string base64(const std::string& bytes);

}  // namespace prt::cli
