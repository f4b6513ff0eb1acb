#pragma once
// Words and numbers of a text held in memory, with line numbers for messages. Never reads past its end.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace prt {

/// A number as C prints and scans it, whatever the locale: sign, digits, point, exponent, inf, nan and
/// Microsoft's "1.#QNAN" spellings (nan); too large becomes infinite. Empty unless the whole word is one.
std::optional<double> parseNumber(std::string_view word);
/// A decimal integer; empty unless the whole word is one that fits.
std::optional<std::int64_t> parseInteger(std::string_view word);
/// A word for a message: in quotes, printable, short.
std::string inQuotes(std::string_view word);
/// ASCII letters made small.
std::string lowerCase(std::string_view text);

class TextScanner {
 public:
  /// `name` is what error messages call the text. A comment runs from a word that begins with
  /// `comment` to the end of its line; '\0' means that there are none.
  TextScanner(std::string_view text, std::string name, char comment = '\0');

  /// Next word on this or a later line; empty at the end.
  std::string_view word();
  /// Next word on this line; empty when there is none left.
  std::string_view wordOnLine();
  /// Goes to the start of the next line.
  void skipLine();
  /// Rest of this line without its end and outer blanks; goes to the start of the next.
  std::string_view restOfLine();
  bool atEnd();

  /// Next word as a number; fails when it is none.
  double number();
  std::int64_t integer();

  std::size_t position() const { return position_; }
  std::size_t remaining() const { return text_.size() - position_; }
  int line() const { return line_; }
  /// Throws FileError naming the file and the line.
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  void skipBlanks(bool acrossLines);

  std::string_view text_;
  std::string name_;
  std::size_t position_ = 0;
  int line_ = 1;
  char comment_;
};

}  // namespace prt
