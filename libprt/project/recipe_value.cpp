// One value of a recipe to and from JSON, checked against its line in the table.

#include "libprt/core/error.h"
#include "libprt/project/recipe_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace prt {
namespace {

using nlohmann::json;

template <class... Cases>
struct Overload : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overload(Cases...) -> Overload<Cases...>;

/// The double that prints as briefly as the float does: 0.3f becomes 0.3, not 0.30000001192092896.
double brief(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text) - 1, value).ptr;
  *end = 0;
  return std::strtod(text, nullptr);
}

std::string number(double value) {
  return json(value).dump();
}

std::string range(const Parameter& p) {
  if (p.low == p.high) return "use a finite number";
  if (p.type == ParameterType::Integer)
    return "use " + std::to_string(std::int64_t(p.low)) + " to " + std::to_string(std::int64_t(p.high));
  return "use " + number(p.low) + " to " + number(p.high);
}

[[noreturn]] void wrongType(const json& value, const std::string& where, const std::string& wanted) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  throw ValueError(text + " is not " + wanted, where, "give " + wanted);
}

double finiteNumber(const Parameter& p, const json& value, const std::string& where) {
  if (!value.is_number()) wrongType(value, where, "a number");
  const double x = value.get<double>();
  if (!std::isfinite(x) || (p.low != p.high && (x < p.low || x > p.high)))
    throw ValueError(value.dump() + " is out of range", where, range(p));
  return x;
}

double wholeNumber(const Parameter& p, const json& value, const std::string& where) {
  const double x = finiteNumber(p, value, where);
  if (x != std::floor(x)) wrongType(value, where, "a whole number");
  return x;
}

Vec3 vector(const Parameter& p, const json& value, const std::string& where) {
  const std::string wanted = p.type == ParameterType::Color ? "a colour [r, g, b]" : "a vector [x, y, z]";
  if (!value.is_array() || value.size() != 3) wrongType(value, where, wanted);
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = float(finiteNumber(p, value[std::size_t(i)], where));
  return v;
}

std::string text(const json& value, const std::string& where) {
  if (!value.is_string()) wrongType(value, where, "a text in quotes");
  const auto& s = value.get_ref<const std::string&>();
  const auto isControl = [](char c) { return (unsigned char)(c) < 0x20 || c == 0x7f; };
  if (s.size() > 4096 || std::any_of(s.begin(), s.end(), isControl))
    throw ValueError("text is too long or has control characters", where,
                     "give a plain text of up to 4096 bytes");
  requireUtf8(s, where);
  return s;
}

int choiceIndex(const Parameter& p, const json& value, const std::string& where) {
  const std::string name = text(value, where);
  const auto found = std::find(p.choices.begin(), p.choices.end(), name);
  if (found != p.choices.end()) return int(found - p.choices.begin());
  std::string fix;
  for (const std::string& c : p.choices) fix += (fix.empty() ? "use " : ", ") + c;
  const std::string nearest = nearestName(name, p.choices);
  throw ValueError("'" + name + "' is not one of the choices", where,
                   nearest.empty() ? fix : "did you mean " + nearest + "? " + fix);
}

}  // namespace

void requireUtf8(const std::string& text, const std::string& where) {
  try {
    json(text).dump();
  } catch (const json::exception&) {
    throw ValueError("text is not UTF-8", where, "rename the file, or write the text in UTF-8");
  }
}

json fieldToJson(const FieldRef& field, const Parameter& p) {
  return std::visit(
      Overload{[](const bool* v) { return json(*v); }, [](const int* v) { return json(*v); },
               [](const std::uint64_t* v) { return json(*v); },
               [](const float* v) { return json(brief(*v)); }, [](const std::string* v) { return json(*v); },
               [](const Vec3* v) {
                 return json{brief(v->x), brief(v->y), brief(v->z)};
               },
               [&](const ChoiceRef& v) { return json(p.choices.at(std::size_t(v.get()))); }},
      field);
}

void fieldFromJson(const FieldRef& field, const Parameter& p, const json& value, const std::string& where) {
  std::visit(Overload{[&](bool* v) {
                        if (!value.is_boolean()) wrongType(value, where, "true or false");
                        *v = value.get<bool>();
                      },
                      [&](int* v) { *v = int(wholeNumber(p, value, where)); },
                      [&](std::uint64_t* v) { *v = std::uint64_t(wholeNumber(p, value, where)); },
                      [&](float* v) { *v = float(finiteNumber(p, value, where)); },
                      [&](std::string* v) { *v = text(value, where); },
                      [&](Vec3* v) { *v = vector(p, value, where); },
                      [&](const ChoiceRef& v) { v.set(choiceIndex(p, value, where)); }},
             field);
}

}  // namespace prt
