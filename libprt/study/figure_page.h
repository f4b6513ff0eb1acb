#pragma once
// The page that shows a figure's pictures. Internal to study.

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace prt {

struct FigurePicture {
  std::string file;  ///< beside the page
  std::string text;  ///< under it
  std::string link;  ///< page that it leads to; empty: none
};

/// A number of the paper and the one measured here.
struct FigureNumber {
  std::string what, paper, here;
};

struct FigurePage {
  std::string title, intro;
  std::vector<std::vector<FigurePicture>> rows;
  std::vector<FigureNumber> numbers;  ///< empty: none are shown
};

/// HTML: title, paragraph, numbers, rows of pictures with their texts.
std::string toHtml(const FigurePage& page);
/// [{"file", "shows"}] for results.
nlohmann::json picturesOf(const FigurePage& page);
/// Writes index.html into the folder and returns its path.
std::string writePage(const std::filesystem::path& folder, const FigurePage& page);

}  // namespace prt
