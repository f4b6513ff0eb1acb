#include "libprt/mesh/text_scanner.h"

#include "libprt/core/error.h"

#include <charconv>
#include <cstdlib>
#include <limits>

namespace prt {
namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

}  // namespace

std::string inQuotes(std::string_view word) {
  std::string shown(1, '\'');
  for (char c : word.substr(0, 40)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown.append(word.size() > 40 ? "...'" : "'");
}

std::optional<double> parseNumber(std::string_view word) {
  if (!word.empty() && word[0] == '+') {
    word.remove_prefix(1);
    if (!word.empty() && word[0] == '-') return {};
  }
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc::result_out_of_range && stop == end)
    return std::strtod(std::string(word).c_str(), nullptr);
  if (error != std::errc()) return {};
  if (stop == end) return value;
  if (*stop == '#' && end - stop > 1) return std::numeric_limits<double>::quiet_NaN();
  return {};
}

std::optional<std::int64_t> parseInteger(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lower;
}

TextScanner::TextScanner(std::string_view text, std::string name, char comment)
    : text_(text), name_(std::move(name)), comment_(comment) {}

void TextScanner::skipBlanks(bool acrossLines) {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (comment_ != '\0' && c == comment_) {
      while (position_ < text_.size() && text_[position_] != '\n') ++position_;
    } else if (c == '\n') {
      if (!acrossLines) return;
      ++line_;
      ++position_;
    } else if (isBlank(c)) {
      ++position_;
    } else {
      return;
    }
  }
}

std::string_view TextScanner::wordOnLine() {
  skipBlanks(false);
  const std::size_t begin = position_;
  while (position_ < text_.size() && !isBlank(text_[position_]) && text_[position_] != '\n') ++position_;
  return text_.substr(begin, position_ - begin);
}

std::string_view TextScanner::word() {
  skipBlanks(true);
  return wordOnLine();
}

void TextScanner::skipLine() {
  restOfLine();
}

std::string_view TextScanner::restOfLine() {
  const std::size_t newline = text_.find('\n', position_);
  const std::size_t end = newline == std::string_view::npos ? text_.size() : newline;
  std::string_view rest = text_.substr(position_, end - position_);
  while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && isBlank(rest.back())) rest.remove_suffix(1);
  position_ = end;
  if (newline != std::string_view::npos) {
    ++position_;
    ++line_;
  }
  return rest;
}

bool TextScanner::atEnd() {
  skipBlanks(true);
  return position_ >= text_.size();
}

double TextScanner::number() {
  const std::string_view text = word();
  if (text.empty()) fail("the file ends where a number should stand");
  const auto value = parseNumber(text);
  if (!value) fail(inQuotes(text) + " is not a number");
  return *value;
}

std::int64_t TextScanner::integer() {
  const std::string_view text = word();
  if (text.empty()) fail("the file ends where a whole number should stand");
  const auto value = parseInteger(text);
  if (!value) fail(inQuotes(text) + " is not a whole number");
  return *value;
}

void TextScanner::fail(const std::string& problem) const {
  throw FileError(problem, name_ + ", line " + std::to_string(line_), "export the file again");
}

}  // namespace prt
