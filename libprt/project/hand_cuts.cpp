#include "libprt/project/hand_cuts.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <charconv>

namespace prt {
namespace {

/// Where the elements of an object begin and end; the scene has its objects in order.
struct Range {
  std::size_t first, last;
};

Range rangeOf(const std::vector<std::uint32_t>& owners, std::size_t object) {
  const auto [first, last] = std::equal_range(owners.begin(), owners.end(), std::uint32_t(object));
  return {std::size_t(first - owners.begin()), std::size_t(last - owners.begin())};
}

std::string pathOf(std::size_t object, const char* field) {
  return "objects[" + std::to_string(object) + "]." + field;
}

/// A text of numbers with each of them changed.
template <class Change>
std::string withNumbers(const std::string& text, const Change& change) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), number);
    if (error != std::errc()) {
      out += text[i++];
      continue;
    }
    out += std::to_string(change(number));
    i = std::size_t(end - text.data());
  }
  return out;
}

}  // namespace

Seams drawnSeams(const Recipe& recipe, const Scene& scene, const Surface& surface) {
  Seams seams(surface);
  for (std::size_t o = 0; o < recipe.objects.size(); ++o) {
    const Range vertices = rangeOf(scene.vertexObject, o);
    if (vertices.first == vertices.last || recipe.objects[o].seams.empty()) continue;
    const std::string shifted = withNumbers(recipe.objects[o].seams, [&](std::uint64_t number) {
      if (number >= vertices.last - vertices.first)
        throw ValueError("the mesh has no vertex " + std::to_string(number), pathOf(o, "seams"),
                         "draw the cut anew");
      return vertices.first + number;
    });
    for (const std::uint32_t e : seamsFromText(surface, shifted).edges()) seams.set(e);
  }
  return seams;
}

std::string seamsOfObject(const Scene& scene, const Surface& surface, const Seams& seams,
                          std::size_t object) {
  const Range vertices = rangeOf(scene.vertexObject, object);
  Seams own(surface);
  for (const std::uint32_t e : seams.edges())
    if (scene.triangleObject[surface.halfOf[e] / 3] == object) own.set(e);
  return withNumbers(seamsToText(surface, own),
                     [&](std::uint64_t number) { return number - vertices.first; });
}

std::vector<ChartSettings> chartSettingsOf(const Recipe& recipe, const Scene& scene) {
  std::vector<ChartSettings> all;
  for (std::size_t o = 0; o < recipe.objects.size(); ++o) {
    const Range faces = rangeOf(scene.triangleObject, o);
    if (faces.first == faces.last || recipe.objects[o].charts.empty()) continue;
    for (ChartSettings& chart : chartSettingsFromText(recipe.objects[o].charts)) {
      if (chart.face >= faces.last - faces.first)
        throw ValueError("the mesh has no triangle " + std::to_string(chart.face), pathOf(o, "charts"),
                         "the mesh is not the one that was cut; set the charts anew");
      chart.face += std::uint32_t(faces.first);
      all.push_back(std::move(chart));
    }
  }
  return all;
}

void setChartSettings(Recipe& recipe, const Scene& scene, std::span<const ChartSettings> settings) {
  for (std::size_t o = 0; o < recipe.objects.size(); ++o) {
    const Range faces = rangeOf(scene.triangleObject, o);
    if (faces.first == faces.last) continue;
    std::vector<ChartSettings> own;
    for (const ChartSettings& each : settings) {
      if (each.face < faces.first || each.face >= faces.last) continue;
      own.push_back(each);
      own.back().face -= std::uint32_t(faces.first);
    }
    std::sort(own.begin(), own.end(),
              [](const ChartSettings& a, const ChartSettings& b) { return a.face < b.face; });
    recipe.objects[o].charts = chartSettingsToText(own);
  }
}

std::string cornersText(const Recipe& recipe) {
  std::string text;
  for (std::size_t o = 0; o < recipe.objects.size(); ++o) {
    const ObjectRecipe& object = recipe.objects[o];
    if (object.charts.empty()) continue;
    std::vector<ChartSettings> own = chartSettingsFromText(object.charts);
    for (ChartSettings& chart : own) {
      chart.weight = 1;
      chart.place.reset();
      chart.locked = false;
    }
    const std::string corners = chartSettingsToText(own);
    if (!corners.empty()) text += std::to_string(o) + ": " + corners + "\n";
  }
  return text;
}

}  // namespace prt
