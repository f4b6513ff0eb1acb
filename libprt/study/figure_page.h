#pragma once
// The page that shows a figure's pictures. Internal to study.

#include <string>
#include <vector>

namespace prt {

struct FigurePicture {
  std::string file;  ///< beside the page
  std::string text;  ///< under it
};

/// HTML: a title, a paragraph, rows of pictures with their texts.
std::string figurePage(const std::string& title, const std::string& intro,
                       const std::vector<std::vector<FigurePicture>>& rows);

}  // namespace prt
