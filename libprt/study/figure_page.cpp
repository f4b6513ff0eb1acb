#include "libprt/study/figure_page.h"

#include "libprt/core/file.h"

#include <nlohmann/json.hpp>

namespace prt {
namespace {

constexpr const char* kHead = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>%TITLE%</title>
<style>
:root { color-scheme: dark; }
body { margin: 0; background: #1e1e1e; color: #d6d6d6; font: 14px/1.5 system-ui, sans-serif; }
main { max-width: 1440px; margin: 0 auto; padding: 32px 24px; }
h1 { font-size: 22px; font-weight: 600; margin: 0 0 4px; } p { color: #8c8c8c; max-width: 60em; margin: 0 0 24px; }
.pictures { border-spacing: 8px; width: 100%; } .pictures td { color: #8c8c8c; font-size: 12px; vertical-align: top; }
.numbers { border-collapse: collapse; margin: 0 0 24px 8px; } .numbers td, .numbers th { padding: 4px 24px 4px 0; text-align: left; }
.numbers th { color: #8c8c8c; font-weight: 400; font-size: 12px; } .numbers tr { border-bottom: 1px solid #303030; }
a { color: inherit; } img { width: 100%; display: block; border-radius: 4px; background: #161616; }
</style></head><body><main>
<h1>%TITLE%</h1>
<p>%INTRO%</p>
)html";

std::string filledIn(std::string text, const std::string& name, const std::string& with) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + with.size()))
    text.replace(at, name.size(), with);
  return text;
}

std::string cellOf(const FigurePicture& picture) {
  const std::string image = "<img src=\"" + picture.file + "\" alt=\"" + picture.text + "\">" + picture.text;
  return "<td>" + (picture.link.empty() ? image : "<a href=\"" + picture.link + "\">" + image + "</a>") +
         "</td>";
}

}  // namespace

std::string toHtml(const FigurePage& page) {
  std::string html = filledIn(filledIn(kHead, "%TITLE%", page.title), "%INTRO%", page.intro);
  if (!page.numbers.empty()) {
    html += "<table class=\"numbers\">\n<tr><th></th><th>the paper</th><th>here</th></tr>\n";
    for (const FigureNumber& n : page.numbers)
      html += "<tr><td>" + n.what + "</td><td>" + n.paper + "</td><td>" + n.here + "</td></tr>\n";
    html += "</table>\n";
  }
  html += "<table class=\"pictures\">\n";
  for (const std::vector<FigurePicture>& row : page.rows) {
    html += "<tr>";
    for (const FigurePicture& picture : row) html += cellOf(picture);
    html += "</tr>\n";
  }
  return html + "</table>\n</main></body></html>\n";
}

nlohmann::json picturesOf(const FigurePage& page) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& row : page.rows)
    for (const FigurePicture& picture : row) all.push_back({{"file", picture.file}, {"shows", picture.text}});
  return all;
}

std::string writePage(const std::filesystem::path& folder, const FigurePage& page) {
  const std::filesystem::path file = folder / "index.html";
  writeFile(file, toHtml(page));
  return file.string();
}

}  // namespace prt
