#pragma once
// The text of an OBJ file made safe for tinyobjloader, which turns what it cannot read into zeros: only
// lines that matter, every number checked, lines joined that end in a backslash, UTF-16 turned to UTF-8.

#include "libprt/core/job.h"

#include <exception>
#include <streambuf>
#include <string>
#include <string_view>

namespace prt {

/// UTF-8 from UTF-8, UTF-16 with or without a byte order mark, or anything else unchanged.
std::string toUtf8(std::string_view bytes);

/// A stream over checked lines, made a block at a time. Errors found in the text end the stream and are
/// kept: the streams between here and the parser would swallow them.
class ObjText : public std::streambuf {
 public:
  ObjText(std::string_view text, std::string name, Job& job);

  /// Rethrows what ended the stream early, if anything did.
  void rethrow() const;

  std::size_t ignoredElements() const { return ignoredElements_; }  ///< points, lines, curves, surfaces

 private:
  int_type underflow() override;
  void fillBlock();
  std::string_view logicalLine();
  void checkedLine(std::string_view line);
  void numbers(std::string_view keyword, std::string_view rest, int atLeast, int atMost);
  void face(std::string_view rest);
  [[noreturn]] void fail(const std::string& problem) const;

  std::string_view text_;
  std::string name_;
  Job& job_;
  std::size_t position_ = 0;
  int line_ = 0;  // of the line being checked
  int nextLine_ = 1;
  std::string joined_;  // a line put together from several
  std::string block_;
  std::size_t ignoredElements_ = 0;
  std::exception_ptr failure_;
};

}  // namespace prt
