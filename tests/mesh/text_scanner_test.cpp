#include "libprt/mesh/text_scanner.h"

#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

TEST(ParseNumber, ReadsWhatProgramsWrite) {
  EXPECT_EQ(parseNumber("1"), 1.0);
  EXPECT_EQ(parseNumber("+2.5"), 2.5);
  EXPECT_EQ(parseNumber("-2."), -2.0);
  EXPECT_EQ(parseNumber(".5"), 0.5);
  EXPECT_EQ(parseNumber("-1.25e-2"), -0.0125);
  EXPECT_EQ(parseNumber("1E+2"), 100.0);
  EXPECT_EQ(parseNumber("0.1"), 0.1) << "correctly rounded";
  EXPECT_TRUE(std::isnan(*parseNumber("nan")));
  EXPECT_TRUE(std::isnan(*parseNumber("-nan(ind)")));
  EXPECT_TRUE(std::isnan(*parseNumber("1.#QNAN")));
  EXPECT_TRUE(std::isinf(*parseNumber("-inf")));
  EXPECT_TRUE(std::isinf(*parseNumber("1e999")));
  EXPECT_EQ(parseNumber("1e-999"), 0.0);
}

TEST(ParseNumber, RefusesTheRest) {
  for (const char* word :
       {"", "+", "-", ".", "e5", "1e", "1e+", "3.1+e2", "+-1", "--1", "1,5", "0x10", "1 ", "abc", "1#"})
    EXPECT_FALSE(parseNumber(word)) << word;
}

TEST(ParseInteger, IsStrict) {
  EXPECT_EQ(parseInteger("-12"), -12);
  EXPECT_EQ(parseInteger("+12"), 12);
  for (const char* word : {"", "+", "+-1", "1.0", "1e3", "99999999999999999999", "x"})
    EXPECT_FALSE(parseInteger(word)) << word;
}

TEST(TextScanner, WalksWordsAndLines) {
  TextScanner text(" one two # rest\r\n\n three\tfour", "file", '#');
  EXPECT_EQ(text.word(), "one");
  EXPECT_EQ(text.wordOnLine(), "two");
  EXPECT_EQ(text.wordOnLine(), "");
  EXPECT_EQ(text.word(), "three");
  EXPECT_EQ(text.line(), 3);
  EXPECT_EQ(text.restOfLine(), "four");
  EXPECT_TRUE(text.atEnd());
  EXPECT_EQ(text.word(), "");
}

TEST(TextScanner, SaysWhere) {
  TextScanner text("1\n2 x", "file");
  EXPECT_EQ(text.number(), 1);
  EXPECT_EQ(text.integer(), 2);
  try {
    text.number();
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.where(), "file, line 2");
    EXPECT_EQ(error.problem(), "'x' is not a number");
  }
  EXPECT_THROW(text.number(), FileError) << "at the end";
}

TEST(InQuotes, StaysPrintableAndShort) {
  EXPECT_EQ(inQuotes("a\nb"), "'a?b'");
  EXPECT_LT(inQuotes(std::string(1000, 'x')).size(), 50u);
}

}  // namespace
}  // namespace prt
