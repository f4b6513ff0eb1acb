// Painted strokes, wishes and spots of layers as text in the recipe.

#include "libprt/core/error.h"
#include "libprt/project/synthesis_stages.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace prt {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    if (const auto part = text.substr(begin, end - begin); part.find_first_not_of(' ') != part.npos)
      parts.push_back(part);
    begin = end + 1;
  }
  return parts;
}

/// "1,2,3" as that many finite numbers; false when it is something else.
bool readNumbers(std::string_view text, std::span<float> out) {
  const auto parts = split(text, ',');
  if (parts.size() != out.size()) return false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto [rest, error] = std::from_chars(parts[i].data(), parts[i].data() + parts[i].size(), out[i]);
    if (error != std::errc() || rest != parts[i].data() + parts[i].size() || !std::isfinite(out[i]))
      return false;
  }
  return true;
}

[[noreturn]] void refuse(std::string_view text, const char* path, const char* form) {
  throw ValueError("'" + std::string(text.substr(0, 60)) + "' is not of the right form", path, form);
}

}  // namespace

std::vector<FieldStroke> parseStrokes(const std::string& text) {
  std::vector<FieldStroke> strokes;
  for (const std::string_view part : split(text, ';')) {
    FieldStroke& stroke = strokes.emplace_back();
    for (const std::string_view point : split(part, ' '))
      if (!readNumbers(point, std::span(&stroke.points.emplace_back()[0], 3))) stroke.points.clear();
    if (stroke.points.size() < 2)
      refuse(part, "field.strokes", "write at least two points x,y,z parted by blanks");
  }
  return strokes;
}

std::string strokesToText(const std::vector<FieldStroke>& strokes) {
  std::string text;
  for (const FieldStroke& stroke : strokes) {
    if (!text.empty()) text += ';';
    for (std::size_t i = 0; i < stroke.points.size(); ++i) {
      const Vec3& p = stroke.points[i];
      text += fmt::format("{}{},{},{}", i == 0 ? "" : " ", p.x, p.y, p.z);
    }
  }
  return text;
}

std::vector<PatchWish> parseWishes(const std::string& text) {
  std::vector<PatchWish> wishes;
  for (const std::string_view part : split(text, ';')) {
    const auto words = split(part, ' ');
    PatchWish& wish = wishes.emplace_back();
    if (words.size() != 4 || !readNumbers(words[0], std::span(&wish.centre[0], 3)) ||
        !readNumbers(words[1], std::span(&wish.radius, 1)) ||
        !readNumbers(words[2], std::span(&wish.place[0], 2)) ||
        !readNumbers(words[3], std::span(&wish.extent, 1)) || !(wish.radius > 0) || wish.extent < 0)
      refuse(part, "synthesis.wishes", "write x,y,z radius u,v extent");
  }
  return wishes;
}

std::vector<LayerSpot> parseSpots(const std::string& text) {
  std::vector<LayerSpot> spots;
  for (const std::string_view part : split(text, ';')) {
    const auto words = split(part, ' ');
    LayerSpot& spot = spots.emplace_back();
    if (words.size() != 3 || !readNumbers(words[0], std::span(&spot.centre[0], 3)) ||
        !readNumbers(words[1], std::span(&spot.radius, 1)) ||
        !readNumbers(words[2], std::span(&spot.strength, 1)) || !(spot.radius > 0) || spot.strength < 0 ||
        spot.strength > 1)
      refuse(part, "layers[].spots", "write x,y,z radius strength, strength from 0 to 1");
  }
  return spots;
}

std::string spotsToText(const std::vector<LayerSpot>& spots) {
  std::string text;
  for (const LayerSpot& s : spots)
    text += fmt::format("{}{},{},{} {} {}", text.empty() ? "" : ";", s.centre.x, s.centre.y, s.centre.z,
                        s.radius, s.strength);
  return text;
}

std::string wishesToText(const std::vector<PatchWish>& wishes) {
  std::string text;
  for (const PatchWish& w : wishes)
    text += fmt::format("{}{},{},{} {} {},{} {}", text.empty() ? "" : ";", w.centre.x, w.centre.y, w.centre.z,
                        w.radius, w.place.x, w.place.y, w.extent);
  return text;
}

}  // namespace prt
