#include "libprt/atlas/chart_settings.h"

#include "libprt/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>

namespace prt {
namespace {

constexpr double kLeastWeight = 1e-3, kMostWeight = 1e3;
constexpr int kLeastCorners = 3, kMostCorners = 64;

[[noreturn]] void refuse(const std::string& part, const std::string& fix) {
  throw ValueError("'" + part.substr(0, 60) + "' is no setting of a chart", "objects[].charts", fix);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    if (end > begin) parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::optional<double> numberOf(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::vector<double> numbersOf(const std::string& word, const std::string& text) {
  std::vector<double> values;
  for (const std::string& each : split(text, ',')) {
    const auto value = numberOf(each);
    if (!value) refuse(word, "give numbers parted by ','");
    values.push_back(*value);
  }
  return values;
}

void readCorners(const std::string& word, const std::string& text, ChartSettings& chart) {
  const std::vector<double> values = numbersOf(word, text);
  if (values.size() == 1) {
    if (values[0] != std::floor(values[0]) || values[0] < kLeastCorners || values[0] > kMostCorners)
      refuse(word, "give 3 to 64 corners");
    chart.cornerCount = int(values[0]);
    return;
  }
  const bool rising =
      std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
  if (values.size() < kLeastCorners || values.size() > kMostCorners || !rising || values.front() < 0 ||
      values.back() >= 1)
    refuse(word, "give 3 to 64 rising places from 0 to below 1");
  chart.corners = values;
}

void readWord(const std::string& word, ChartSettings& chart) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const std::string text = equals == std::string::npos ? std::string() : word.substr(equals + 1);
  if (word == "locked") {
    chart.locked = true;
  } else if (name == "weight") {
    const auto weight = numberOf(text);
    if (!weight || !(*weight >= kLeastWeight && *weight <= kMostWeight))
      refuse(word, "give a weight from 0.001 to 1000");
    chart.weight = *weight;
  } else if (name == "corners") {
    readCorners(word, text, chart);
  } else if (name == "place") {
    const std::vector<double> v = numbersOf(word, text);
    if (v.size() != 4 || !(v[3] > 0)) refuse(word, "write place=U,V,DEGREES,SCALE");
    chart.place = ChartPlacement{v[3], radians(v[2]), DVec2(v[0], v[1]), true};
  } else {
    refuse(word, "use weight=, corners=, place= or locked");
  }
}

double lengthOf(std::span<const double> lengths) {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

}  // namespace

bool ChartSettings::operator==(const ChartSettings& b) const {
  const auto same = [](const ChartPlacement& p, const ChartPlacement& q) {
    return p.scale == q.scale && p.angle == q.angle && p.offset == q.offset;
  };
  return face == b.face && weight == b.weight && cornerCount == b.cornerCount && corners == b.corners &&
         locked == b.locked && place.has_value() == b.place.has_value() && (!place || same(*place, *b.place));
}

std::vector<ChartSettings> chartSettingsFromText(const std::string& text) {
  std::vector<ChartSettings> all;
  for (const std::string& part : split(text, ';')) {
    const std::vector<std::string> words = split(part, ' ');
    if (words.empty()) continue;
    ChartSettings& chart = all.emplace_back();
    const char* end = words[0].data() + words[0].size();
    const auto [stop, error] = std::from_chars(words[0].data(), end, chart.face);
    if (error != std::errc() || stop != end || chart.face == kNowhere)
      refuse(part, "begin with the number of a triangle of the chart");
    for (std::size_t i = 1; i < words.size(); ++i) readWord(words[i], chart);
  }
  return all;
}

std::string chartSettingsToText(std::span<const ChartSettings> settings) {
  std::string text;
  for (const ChartSettings& chart : settings) {
    if (chart.plain()) continue;
    text += fmt::format("{}{}", text.empty() ? "" : ";", chart.face);
    if (chart.weight != 1) text += fmt::format(" weight={}", chart.weight);
    if (!chart.corners.empty())
      text += fmt::format(" corners={}", fmt::join(chart.corners, ","));
    else if (chart.cornerCount > 0)
      text += fmt::format(" corners={}", chart.cornerCount);
    if (const auto& p = chart.place) {
      // Degrees as people wrote them: a millionth is far below a texel.
      const double turn = std::round(degrees(p->angle) * 1e6) / 1e6;
      text += fmt::format(" place={},{},{},{}", p->offset.x, p->offset.y, turn, p->scale);
    }
    if (chart.locked) text += " locked";
  }
  return text;
}

std::vector<ChartSettings> settingsOfCharts(const Charts& charts, std::span<const ChartSettings> settings) {
  std::vector<ChartSettings> all(charts.charts.size());
  for (const ChartSettings& each : settings) {
    if (each.face >= charts.chartOf.size()) continue;
    ChartSettings& own = all[charts.chartOf[each.face]];
    if (own.face == kNowhere) own = each;
  }
  for (std::size_t c = 0; c < all.size(); ++c)
    if (all[c].face == kNowhere) all[c].face = charts.charts[c].faces.front();
  return all;
}

std::vector<std::uint32_t> cornersAt(std::span<const double> lengths, std::span<const double> places) {
  const double total = lengthOf(lengths);
  std::set<std::uint32_t> corners;
  for (const double place : places) {
    double at = 0, least = total;
    std::uint32_t nearest = 0;
    for (std::uint32_t v = 0; v < lengths.size(); at += lengths[v++]) {
      const double away = std::abs(place * total - at), round = std::min(away, total - away);
      if (round < least) least = round, nearest = v;
    }
    corners.insert(nearest);
  }
  return {corners.begin(), corners.end()};
}

std::vector<double> placesOf(std::span<const double> lengths, std::span<const std::uint32_t> corners) {
  const double total = lengthOf(lengths);
  std::vector<double> before(lengths.size(), 0.0);
  for (std::size_t v = 1; v < before.size(); ++v) before[v] = before[v - 1] + lengths[v - 1];
  std::vector<double> places;
  for (const std::uint32_t corner : corners) places.push_back(total > 0 ? before[corner] / total : 0);
  return places;
}

FlattenOptions flattenOptionsFor(const FlatChart& chart, const ChartSettings& settings,
                                 FlattenOptions options) {
  if (!settings.hasCorners()) return options;
  options.boundary = ChartBoundary::Polygon;
  options.corners = cornersAt(chart.rimLengths, settings.corners);
  if (settings.cornerCount > 0) options.cornerCount = settings.cornerCount;
  return options;
}

FlatCharts flattenCharts(const Surface& surface, const Seams& seams, const FlattenOptions& options,
                         std::span<const ChartSettings> settings, Job& job) {
  Charts charts = makeCharts(surface, seams, job);
  const std::vector<ChartSettings> own = settingsOfCharts(charts, settings);
  return flattenCharts(
      surface, seams, std::move(charts),
      [&](std::size_t c, const FlatChart& flat) { return flattenOptionsFor(flat, own[c], options); }, job);
}

Seams seamsOfCoordinates(const Surface& surface, std::span<const UVec3> uvTriangles) {
  Seams seams(surface);
  const auto at = [&](std::uint32_t half) { return uvTriangles[half / 3][int(half % 3)]; };
  for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) {
    const std::uint32_t half = surface.halfOf[e], other = surface.twin[half];
    if (other == kNowhere) continue;
    if (at(half) != at(nextHalf(other)) || at(nextHalf(half)) != at(other)) seams.set(e);
  }
  return seams;
}

std::vector<PlacementProblem> placementProblems(std::span<const std::vector<DVec2>> outlines,
                                                std::span<const ChartPlacement> placements, int size) {
  std::vector<PlacementProblem> problems;
  // One owner per texel whose centre region a chart covers: charts that only touch share none.
  std::vector<std::uint32_t> owner(std::size_t(size) * std::size_t(size), kNowhere);
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  constexpr double kSlack = 1e-6;
  for (std::size_t c = 0; c < outlines.size(); ++c) {
    std::vector<DVec2> at;
    bool outside = false;
    for (const DVec2& p : outlines[c]) {
      const DVec2 q = placements[c](p);
      outside = outside || q.x < -kSlack || q.y < -kSlack || q.x > 1 + kSlack || q.y > 1 + kSlack;
      at.push_back(q * double(size));
    }
    if (outside) problems.push_back({c, c});
    // Even-odd along rows through texel centres.
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(size));
    for (std::size_t i = 0; i < at.size(); ++i) {
      DVec2 a = at[i], b = at[(i + 1) % at.size()];
      if (a.y > b.y) std::swap(a, b);
      const int first = std::max(0, int(std::ceil(a.y - 0.5))),
                last = std::min(size - 1, int(std::ceil(b.y - 0.5)) - 1);
      for (int y = first; y <= last; ++y)
        crossings[std::size_t(y)].push_back(a.x + (b.x - a.x) * (y + 0.5 - a.y) / (b.y - a.y));
    }
    for (int y = 0; y < size; ++y) {
      std::vector<double>& xs = crossings[std::size_t(y)];
      std::sort(xs.begin(), xs.end());
      for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
        const int first = std::max(0, int(std::ceil(xs[i] - 0.5))),
                  last = std::min(size, int(std::ceil(xs[i + 1] - 0.5)));
        for (int x = first; x < last; ++x) {
          std::uint32_t& texel = owner[std::size_t(y) * std::size_t(size) + std::size_t(x)];
          if (texel != kNowhere && texel != c) pairs.insert({texel, c});
          texel = std::uint32_t(c);
        }
      }
    }
  }
  for (const auto& [a, b] : pairs) problems.push_back({a, b});
  std::sort(problems.begin(), problems.end(), [](const PlacementProblem& a, const PlacementProblem& b) {
    return a.chart != b.chart ? a.chart < b.chart : a.other < b.other;
  });
  return problems;
}

}  // namespace prt
