#include "app/cli/recipe_page.h"

#include "libprt/project/recipe.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace prt::cli {
namespace {

constexpr const char* kBegin =
    R"(# The recipe

<!-- Made by `prt bake --help-all` (./dev docs) from libprt/project/recipe_table.cpp: change that, not this. -->

Every parameter of a project. In a file it is JSON, and what is left out has its default; on the command line each
parameter has a path: `--set transfer.bounces=3`. An unknown name, a wrong type or a value out of range is an error that
names the nearest valid one.

```json
{
  "mesh": "bunny.obj",
  "material": {"model": "phong", "albedo": [0.8, 0.4, 0.2], "specular": [0.2, 0.2, 0.2], "exponent": 60},
  "lights": [{"path": "sky.hdr", "rotation": 40}],
  "transfer": {"bands": 5, "bounces": 3}
}
```

`mesh`, `transform` and `material` are short for those of `objects[0]`, and a mesh may be given as its path alone. On the
command line `lights[1].kind=circle` may be one past the end of the list: a light is appended. Files are relative to the
recipe. Angles are degrees, colours linear Rec.709. *Changing it* says what has to be baked again.
)";

struct SectionTitle {
  const char* path;
  const char* title;
  const char* text;
};

constexpr SectionTitle kSections[] = {
    {"objects[]", "Objects", "One mesh with one material each; all objects shadow and light each other."},
    {"objects[].mesh", "Mesh", "Where an object's shape comes from and how it is mended."},
    {"objects[].transform", "Transform", "Where the object stands. Scale first, then turns, then moves."},
    {"objects[].material", "Material", ""},
    {"lights[]", "Lights", "What shines when pictures are made; no bake depends on it."},
    {"cameras[]", "Cameras", "Views by name. Without any a view that frames everything is used."},
    {"charts", "Charts", "How the surface is cut and laid flat; see [charts](charts.md)."},
    {"atlas", "Atlas", "How charts are packed. Made with `--stage atlas`."},
    {"transfer", "Transfer", "What is baked; see [transfer](transfer.md)."},
    {"patch", "Patch", "The fine structure of the surface, one period of it; see [meso scale](meso.md)."},
    {"layers[]", "Layers",
     "Further patches, the lowest first: each covers what is below where it is painted, at most three. All "
     "are "
     "baked as `rtt` says and laid as one; see [synthesis](synthesis.md)."},
    {"layers[].patch", "Patch of a layer", "As `patch`."},
    {"rtt", "Radiance transfer texture", "How the patch answers to light; baked when there is a patch."},
    {"field", "Orientation field", "Along what patches are laid; see [synthesis](synthesis.md)."},
    {"synthesis", "Synthesis",
     "How the patch covers the surface. Made for `method.name=biscale`, or with `--stage synthesis`."},
    {"idmap", "Id map",
     "The place in the patch of every texel of the atlas. Made for `method.name=biscale`, or with `--stage "
     "idmap`."},
    {"method", "Method", "How pictures are made from what is baked."},
};

std::string sectionOf(const std::string& path) {
  return path.substr(0, path.rfind('.'));
}

/// Whole numbers with all their digits, unless they are powers of ten that are easier read as such.
std::string number(double value) {
  const double power = value != 0 ? std::log10(std::abs(value)) : 0;
  if (power >= 6 && power == std::round(power)) return fmt::format("{}1e{:.0f}", value < 0 ? "-" : "", power);
  return value == std::round(value) ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value);
}

/// What may stand there.
std::string valuesOf(const Parameter& p) {
  std::string range = p.low < p.high ? number(p.low) + " to " + number(p.high) : "";
  switch (p.type) {
    case ParameterType::Boolean:
      return "true, false";
    case ParameterType::Choice:
      return fmt::format("{}", fmt::join(p.choices, ", "));
    case ParameterType::Text:
      return "text";
    case ParameterType::File:
      return "file";
    case ParameterType::Color:
      return "[r, g, b]" + (range.empty() ? "" : ", each " + range);
    case ParameterType::Vector:
      return "[x, y, z]";
    case ParameterType::Integer:
      range = range.empty() ? "whole number" : "whole, " + range;
      break;
    case ParameterType::Number:
      break;
  }
  const bool named = p.unit.empty() || p.path.ends_with(p.unit);  // the name says it
  return named ? range : range + " " + p.unit;
}

}  // namespace

std::string recipePage() {
  std::map<std::string, std::string> rows;  // by section
  for (const Parameter& p : parameters())
    rows[sectionOf(p.path)] +=
        fmt::format("| `{}` | {} | `{}` | {} | {} |\n", p.path, valuesOf(p), p.defaultText, p.doc, p.cost);
  std::string page = kBegin;
  const auto add = [&](const std::string& title, const std::string& text, const std::string& table) {
    page += "\n## " + title + "\n\n" + text + (text.empty() ? "" : "\n\n");
    page += "| path | values | default | what it is | changing it |\n|---|---|---|---|---|\n" + table;
  };
  for (const SectionTitle& section : kSections) {
    add(section.title, section.text, rows[section.path]);
    rows.erase(section.path);
  }
  for (const auto& [path, table] : rows) add(path, "", table);  // sections that have no words yet
  return page;
}

}  // namespace prt::cli
