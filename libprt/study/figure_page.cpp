#include "libprt/study/figure_page.h"

namespace prt {

std::string figurePage(const std::string& title, const std::string& intro,
                       const std::vector<std::vector<FigurePicture>>& rows) {
  std::string page = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>)html" +
                     title + R"html(</title>
<style>
:root { color-scheme: dark; }
body { margin: 0; background: #1e1e1e; color: #d6d6d6; font: 14px/1.5 system-ui, sans-serif; }
main { max-width: 1440px; margin: 0 auto; padding: 32px 24px; }
h1 { font-size: 22px; font-weight: 600; margin: 0 0 4px; } p { color: #8c8c8c; max-width: 60em; margin: 0 0 24px; }
table { border-spacing: 8px; width: 100%; } td { font-weight: 400; text-align: left; color: #8c8c8c; font-size: 12px; vertical-align: top; }
img { width: 100%; display: block; border-radius: 4px; background: #161616; }
</style></head><body><main>
<h1>)html" + title + "</h1>\n<p>" +
                     intro + "</p>\n<table>\n";
  for (const std::vector<FigurePicture>& row : rows) {
    page += "<tr>";
    for (const FigurePicture& picture : row)
      page += "<td><img src=\"" + picture.file + "\" alt=\"" + picture.text + "\">" + picture.text + "</td>";
    page += "</tr>\n";
  }
  return page + "</table>\n</main></body></html>\n";
}

}  // namespace prt
