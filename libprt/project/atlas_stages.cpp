#include "libprt/project/atlas_stages.h"

#include "libprt/atlas/geometry_image.h"
#include "libprt/core/error.h"
#include "libprt/core/log.h"
#include "libprt/project/hand_cuts.h"
#include "libprt/project/product_rows.h"
#include "libprt/project/products.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace prt {
namespace {

/// Charts that were put by hand must not lie over others or leave the square.
void checkPlaces(const FlatCharts& charts, const Atlas& atlas) {
  std::vector<std::vector<DVec2>> outlines;
  for (std::size_t c = 0; c < charts.uv.size(); ++c)
    outlines.push_back(outlineOf(charts.charts.charts[c], charts.uv[c]));
  const auto problems = placementProblems(outlines, atlas.placements, atlas.size);
  if (problems.empty()) return;
  const PlacementProblem& first = problems.front();
  const std::string more =
      problems.size() > 1 ? fmt::format("; {} places in all", problems.size()) : std::string();
  throw GeometryError(first.chart == first.other
                          ? "leaves the square" + more
                          : fmt::format("lies over {}{}", chartName(first.other), more),
                      chartName(first.chart), "move it, or take its place from objects[].charts");
}

/// A mesh's own coordinates, refused where they are no map.
Atlas imported(const TriMesh& mesh, const PackOptions& options, Job& job) {
  ImportedAtlas result = importAtlas(mesh, options, job);
  if (!result.problems.empty()) {
    const UvProblem& first = result.problems[0];
    const std::string more = result.problems.size() > 1
                                 ? fmt::format("; {} places in all", result.problems.size())
                                 : std::string();
    throw GeometryError(
        fmt::format("triangle {} {}{} at u {:.4f}, v {:.4f}{}", first.triangle, toString(first.kind),
                    first.other == kNowhere ? "" : fmt::format(" (triangle {})", first.other), first.at.x,
                    first.at.y, more),
        "texture coordinates", "mend them where they were made, or set charts.mode=auto");
  }
  return std::move(result.atlas);
}

using Write = std::function<void(const std::string& name, const Array& array, const std::string& doc)>;

}  // namespace

ProductPtr makeChartsStage(StageRun& run) {
  const Recipe& recipe = run.recipe();
  auto product = std::make_shared<ChartsProduct>();
  if (recipe.charts.mode == ChartsMode::Imported) return product;
  const Scene& scene = *run.input<SceneProduct>("scene")->scene;
  const Surface surface(scene.mesh, run.job());
  const std::vector<ChartSettings> settings = chartSettingsOf(recipe, scene);
  if (recipe.charts.mode == ChartsMode::Manual) {
    product->charts = std::make_shared<FlatCharts>(flattenCharts(
        surface, drawnSeams(recipe, scene, surface), flattenOptionsOf(recipe.charts), settings, run.job()));
    return product;
  }
  const AutoCutOptions options = autoCutOptionsOf(recipe.charts);
  const std::vector<float> costs = seamCosts(
      surface, {.followCreases = recipe.charts.creases, .concaveBonus = 0.2 * recipe.charts.creases},
      run.job());
  FlatCharts charts = autoCut(surface, costs, options, run.job());
  const bool corners =
      std::any_of(settings.begin(), settings.end(), [](const ChartSettings& c) { return c.hasCorners(); });
  const bool again = corners || recipe.charts.boundary == ChartsBoundary::Polygon;
  if (again)
    charts = flattenCharts(surface, charts.seams, flattenOptionsOf(recipe.charts), settings, run.job());
  product->charts = std::make_shared<FlatCharts>(std::move(charts));
  // They were cut for free boundaries: on polygons the same charts may stretch more.
  if (const std::string note = stretchNote(recipe, *product); again && !note.empty()) logWarning(note);
  return product;
}

std::string stretchNote(const Recipe& recipe, const ChartsProduct& product) {
  if (recipe.charts.mode != ChartsMode::Auto || !product.charts) return {};
  return boundMissed(*product.charts, autoCutOptionsOf(recipe.charts).stretch);
}

FlattenOptions flattenOptionsOf(const ChartsRecipe& charts) {
  FlattenOptions options;
  options.boundary = ChartBoundary(int(charts.boundary));
  options.cornerCount = charts.corners;
  return options;
}

AtlasFacts atlasFacts(const TriMesh& mesh, const Surface& surface, const Atlas& atlas, Job& job) {
  AtlasFacts facts;
  facts.charts = atlas.chartCount;
  const StretchSum stretch = atlasStretch(mesh.positions, mesh.triangles, atlas);
  facts.l2 = stretch.l2();
  facts.lInf = stretch.lInf();
  facts.seam =
      seamLength(surface, seamsOfCoordinates(surface, atlas.uvTriangles)) / std::sqrt(surface.totalArea());
  facts.filled = makeGeometryImage(atlas, atlas.size, 0, job).filled();
  return facts;
}

AutoCutOptions autoCutOptionsOf(const ChartsRecipe& charts) {
  AutoCutOptions options;
  options.stretch = std::max(1.001, double(charts.stretch));  // 1 itself only a plane can have
  options.chartStretch = std::max(1.30, 1 + 2 * (options.stretch - 1));
  return options;
}

namespace {

/// Where a patch is grown its id map wants the texels: what carries none gets a tenth of them at most.
void makeRoomForPatch(const Recipe& recipe, const Scene& scene, const FlatCharts& charts,
                      std::vector<double>& weights) {
  constexpr double kShare = 0.1, kLeast = 1e-3;
  if (recipe.patch.model == PatchModel::None) return;
  const auto& all = charts.charts.charts;
  weights.resize(all.size(), 1.0);
  const auto plain = [&](std::size_t c) {
    return !recipe.objects[scene.triangleObject[all[c].faces.front()]].patch;
  };
  double area[2] = {};
  for (std::size_t c = 0; c < all.size(); ++c) area[plain(c)] += weights[c] * all[c].area;
  if (area[0] <= 0 || area[1] <= 0) return;
  const double less = std::clamp(kShare * area[0] / area[1], kLeast, 1.0);
  for (std::size_t c = 0; c < all.size(); ++c)
    if (plain(c)) weights[c] *= less;
}

}  // namespace

AtlasOptions packingOf(const Recipe& recipe, const Scene& scene, const FlatCharts& charts,
                       std::span<const ChartSettings> settings) {
  AtlasOptions options{{recipe.atlas.size, recipe.atlas.gutter, recipe.atlas.turns}, {}, {}};
  options.locked = parsePlacements(recipe.atlas.placements, charts.charts.charts.size());
  for (std::size_t c = 0; c < settings.size(); ++c) {
    options.weights.push_back(settings[c].weight);
    if (!settings[c].place) continue;
    options.locked.resize(settings.size());
    options.locked[c] = *settings[c].place;
  }
  makeRoomForPatch(recipe, scene, charts, options.weights);
  return options;
}

ProductPtr makeAtlasStage(StageRun& run) {
  const Recipe& recipe = run.recipe();
  const Scene& scene = *run.input<SceneProduct>("scene")->scene;
  const TriMesh& mesh = scene.mesh;
  const PackOptions pack{recipe.atlas.size, recipe.atlas.gutter, recipe.atlas.turns};
  auto product = std::make_shared<AtlasProduct>();
  const auto charts = run.input<ChartsProduct>("charts")->charts;
  if (!charts) {
    product->atlas = std::make_shared<Atlas>(imported(mesh, pack, run.job()));
  } else {
    const AtlasOptions options =
        packingOf(recipe, scene, *charts, settingsOfCharts(charts->charts, chartSettingsOf(recipe, scene)));
    product->atlas = std::make_shared<Atlas>(packAtlas(*charts, options, run.job()));
    if (!options.locked.empty()) checkPlaces(*charts, *product->atlas);
  }
  product->facts = atlasFacts(mesh, Surface(mesh, run.job()), *product->atlas, run.job());
  return product;
}

ProductData ChartsProduct::save() const {
  ProductData data;
  if (!charts) return data;
  std::vector<std::uint32_t> vertices, rim, rimStart{0};
  std::vector<DVec2> uv;
  std::vector<UVec3> triangles(charts->charts.chartOf.size());
  std::vector<double> sums;
  for (std::size_t c = 0; c < charts->charts.charts.size(); ++c) {
    const Chart& chart = charts->charts.charts[c];
    const auto first = std::uint32_t(vertices.size());
    vertices.insert(vertices.end(), chart.vertices.begin(), chart.vertices.end());
    uv.insert(uv.end(), charts->uv[c].begin(), charts->uv[c].end());
    for (std::size_t t = 0; t < chart.faces.size(); ++t)
      triangles[chart.faces[t]] = chart.triangles[t] + UVec3(first);
    rim.insert(rim.end(), chart.loops[0].begin(), chart.loops[0].end());
    rimStart.push_back(std::uint32_t(rim.size()));
    const StretchSum& s = charts->stretch[c];
    sums.insert(sums.end(), {s.squares, s.area, s.flatArea, s.worst});
  }
  data.meta = nlohmann::json{{"edges", charts->seams.size()}}.dump();
  data.arrays["seams"] = listOf(charts->seams.edges());
  data.arrays["chart_of"] = listOf(charts->charts.chartOf);
  data.arrays["vertices"] = listOf(vertices);
  data.arrays["rim"] = listOf(rim);
  data.arrays["rim_start"] = listOf(rimStart);
  data.arrays["uv"] = rowsOf(uv);
  data.arrays["triangles"] = rowsOf(triangles);
  data.arrays["stretch"] =
      Array::from<double>(std::span<const double>(sums), {std::int64_t(charts->charts.charts.size()), 4});
  return data;
}

ProductPtr ChartsProduct::load(ProductData data) {
  auto product = std::make_shared<ChartsProduct>();
  if (data.arrays.empty()) return product;
  auto flat = std::make_shared<FlatCharts>();
  const nlohmann::json meta = nlohmann::json::parse(data.meta, nullptr, false);
  const double edges = numberOf(meta, "edges", "charts");
  const auto chartOf = readList<std::uint32_t>(data, "chart_of"),
             vertices = readList<std::uint32_t>(data, "vertices"), rim = readList<std::uint32_t>(data, "rim"),
             rimStart = readList<std::uint32_t>(data, "rim_start");
  const auto uv = readRows<DVec2>(data, "uv", "charts");
  const auto triangles = readRows<UVec3>(data, "triangles", "charts");
  const Array& sums = data.array("stretch", DType::f64, 2);
  const std::size_t count = std::size_t(sums.shape[0]);
  if (!(edges >= 0 && edges < 4e9) || uv.size() != vertices.size() || triangles.size() != chartOf.size() ||
      rimStart.size() != count + 1 || sums.shape[1] != 4 || rimStart.back() != rim.size() ||
      edges > 3.0 * double(triangles.size()))
    unfit("charts");
  flat->seams = Seams(std::size_t(edges));
  for (std::uint32_t e : readList<std::uint32_t>(data, "seams")) {
    if (e >= flat->seams.size()) unfit("charts");
    flat->seams.set(e);
  }
  flat->charts.charts.resize(count);
  std::vector<std::uint32_t> low(count, kNowhere), high(count, 0);
  for (std::uint32_t f = 0; f < chartOf.size(); ++f) {
    const std::uint32_t c = chartOf[f];
    if (c >= count) unfit("charts");
    flat->charts.charts[c].faces.push_back(f);
    for (int i = 0; i < 3; ++i) {
      if (triangles[f][i] >= vertices.size()) unfit("charts");
      low[c] = std::min(low[c], triangles[f][i]);
      high[c] = std::max(high[c], triangles[f][i]);
    }
  }
  const auto values = sums.as<double>();
  flat->uv.resize(count);
  for (std::size_t c = 0; c < count; ++c) {
    Chart& chart = flat->charts.charts[c];
    if (chart.faces.empty()) unfit("charts");
    const std::size_t size = high[c] - low[c] + 1;
    chart.vertices.assign(vertices.begin() + low[c], vertices.begin() + low[c] + std::ptrdiff_t(size));
    flat->uv[c].assign(uv.begin() + low[c], uv.begin() + low[c] + std::ptrdiff_t(size));
    for (std::uint32_t f : chart.faces) chart.triangles.push_back(triangles[f] - UVec3(low[c]));
    if (rimStart[c] >= rimStart[c + 1] || rimStart[c + 1] > rim.size()) unfit("charts");
    chart.loops.emplace_back(rim.begin() + rimStart[c], rim.begin() + rimStart[c + 1]);
    for (std::uint32_t v : chart.loops[0])
      if (v >= size) unfit("charts");
    chart.euler = 1;
    flat->stretch.push_back({values[4 * c], values[4 * c + 1], values[4 * c + 2], values[4 * c + 3]});
    chart.area = values[4 * c + 1];
  }
  flat->charts.chartOf = chartOf;
  product->charts = std::move(flat);
  return product;
}

ProductData AtlasProduct::save() const {
  ProductData data;
  data.meta =
      nlohmann::json{{"size", atlas->size},   {"gutter", atlas->gutter}, {"charts", atlas->chartCount},
                     {"l2", facts.l2},        {"l_inf", facts.lInf},     {"seam", facts.seam},
                     {"filled", facts.filled}}
          .dump();
  data.arrays["uv"] = rowsOf(atlas->uv);
  data.arrays["uv_triangles"] = rowsOf(atlas->uvTriangles);
  data.arrays["chart_of"] = listOf(atlas->chartOf);
  std::vector<double> places;
  for (const ChartPlacement& p : atlas->placements)
    places.insert(places.end(), {p.scale, p.angle, p.offset.x, p.offset.y, double(p.locked)});
  data.arrays["placements"] =
      Array::from<double>(std::span<const double>(places), {std::int64_t(atlas->placements.size()), 5});
  return data;
}

ProductPtr AtlasProduct::load(ProductData data) {
  auto atlas = std::make_shared<Atlas>();
  auto product = std::make_shared<AtlasProduct>();
  const nlohmann::json meta = nlohmann::json::parse(data.meta, nullptr, false);
  const double size = numberOf(meta, "size", "atlas"), gutter = numberOf(meta, "gutter", "atlas"),
               charts = numberOf(meta, "charts", "atlas");
  if (!(size >= 1 && size <= 65536 && gutter >= 0 && gutter <= 1024 && charts >= 0 && charts < 4e9))
    unfit("atlas");
  atlas->size = int(size);
  atlas->gutter = int(gutter);
  atlas->chartCount = std::uint32_t(charts);
  atlas->uv = readRows<Vec2>(data, "uv", "atlas");
  atlas->uvTriangles = readRows<UVec3>(data, "uv_triangles", "atlas");
  atlas->chartOf = readList<std::uint32_t>(data, "chart_of");
  if (atlas->chartOf.size() != atlas->uvTriangles.size()) unfit("atlas");
  for (std::size_t t = 0; t < atlas->uvTriangles.size(); ++t) {
    const UVec3& c = atlas->uvTriangles[t];
    if (std::max({c.x, c.y, c.z}) >= atlas->uv.size() || atlas->chartOf[t] >= atlas->chartCount)
      unfit("atlas");
  }
  for (const Vec2& p : atlas->uv)
    if (!(p.x >= 0 && p.y >= 0 && p.x <= 1 && p.y <= 1)) unfit("atlas");
  const Array& places = data.array("placements", DType::f64, 2);
  if (places.shape[1] != 5) unfit("atlas");
  const auto values = places.as<double>();
  for (std::size_t i = 0; i + 4 < values.size(); i += 5)
    atlas->placements.push_back(
        {values[i], values[i + 1], DVec2(values[i + 2], values[i + 3]), values[i + 4] != 0});
  product->facts = {atlas->chartCount, numberOf(meta, "l2", "atlas"), numberOf(meta, "l_inf", "atlas"),
                    numberOf(meta, "seam", "atlas"), numberOf(meta, "filled", "atlas")};
  product->atlas = std::move(atlas);
  return product;
}

std::vector<ChartPlacement> parsePlacements(const std::string& text, std::size_t charts) {
  std::vector<ChartPlacement> placements;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    begin = end + 1;
    if (part.find_first_not_of(' ') == std::string::npos) continue;
    std::vector<double> numbers;
    for (std::size_t i = 0; i < part.size();) {
      if (part[i] == ' ') {
        ++i;
        continue;
      }
      double value = 0;
      const auto [rest, error] = std::from_chars(part.data() + i, part.data() + part.size(), value);
      if (error != std::errc() || !std::isfinite(value)) break;
      numbers.push_back(value);
      i = std::size_t(rest - part.data());
      if (i < part.size() && part[i] != ' ') numbers.clear(), i = part.size();
    }
    if (numbers.size() != 5 || !(numbers[1] > 0))
      throw ValueError("'" + part + "' is no placement", "atlas.placements",
                       "write CHART SCALE DEGREES U V, parted by ';'");
    if (!(numbers[0] >= 1 && numbers[0] <= double(charts)))
      throw ValueError(
          "there is no chart " + std::to_string(std::int64_t(numbers[0])) + " of " + std::to_string(charts),
          "atlas.placements", "the charts were cut anew: place them again");
    placements.resize(charts);
    placements[std::size_t(numbers[0]) - 1] = {numbers[1], radians(numbers[2]), DVec2(numbers[3], numbers[4]),
                                               true};
  }
  return placements;
}

std::string placementsToText(const std::vector<ChartPlacement>& placements) {
  std::string text;
  for (std::size_t c = 0; c < placements.size(); ++c)
    if (const ChartPlacement& p = placements[c]; p.locked)
      text += fmt::format("{}{} {} {} {} {}", text.empty() ? "" : ";", c + 1, p.scale, degrees(p.angle),
                          p.offset.x, p.offset.y);
  return text;
}

}  // namespace prt
