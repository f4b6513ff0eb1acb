#include "ui/model/expression.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

TEST(Expression, ReadsNumbersUnitsAndArithmetic) {
  const std::pair<const char*, double> cases[] = {
      {"1.5", 1.5},      {" 42 ", 42},  {"-3", -3},     {"1e-3", 1e-3},     {".5", 0.5},
      {"3*24", 72},      {"1+2*3", 7},  {"(1+2)*3", 9}, {"7/2", 3.5},       {"2^10", 1024},
      {"-2^2", -4},      {"2^-1", 0.5}, {"2^3^2", 512}, {"1.5k", 1500},     {"2M", 2e6},
      {"10 - 4 - 3", 3}, {"8/4/2", 1},  {"- - 5", 5},   {"3 \u00d7 4", 12}, {"\u22125", -5}};
  for (const auto& [text, value] : cases) {
    const auto result = evaluateExpression(QString::fromUtf8(text));
    ASSERT_TRUE(result) << text;
    EXPECT_DOUBLE_EQ(*result, value) << text;
  }
  EXPECT_EQ(evaluateExpression(QStringLiteral("45 deg"), QStringLiteral("degrees")), 45);
  EXPECT_EQ(evaluateExpression(QStringLiteral("90\u00b0"), QStringLiteral("degrees")), 90);
  EXPECT_EQ(evaluateExpression(QStringLiteral("90 deg"), QStringLiteral("\u00b0")), 90)
      << "the unit as fields show it";
  EXPECT_EQ(evaluateExpression(QStringLiteral("512 rays"), QStringLiteral("rays")), 512);
}

TEST(Expression, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"", " ", "abc", "1+", "(1", "1)", "1 2", "1..2", "--", "1/0", "0/0", "1e999", "*3", "k", "2^9999"})
    EXPECT_FALSE(evaluateExpression(QString::fromUtf8(text))) << text;
}

TEST(Expression, DeepNestingIsRefusedNotACrash) {
  EXPECT_FALSE(evaluateExpression(QString(100000, u'(') + u'1' + QString(100000, u')')));
  EXPECT_FALSE(evaluateExpression(QString(100000, u'-') + u'1'));
}

TEST(Format, NumbersHaveNoMoreDigitsThanTheyNeed) {
  EXPECT_EQ(formatNumber(0.5, 3), u"0.5");
  EXPECT_EQ(formatNumber(2, 3), u"2");
  EXPECT_EQ(formatNumber(1200, 0), u"1200");
  EXPECT_EQ(formatNumber(-0.0001, 2), u"0");
  EXPECT_EQ(formatNumber(0.1234, 3), u"0.123");
}

TEST(Format, CountsAreGrouped) {
  EXPECT_EQ(formatCount(7), u"7");
  EXPECT_EQ(formatCount(1234567), u"1\u202f234\u202f567");
  EXPECT_EQ(formatCount(-123), u"-123");
}

TEST(Format, SecondsAreSaidAsPeopleDo) {
  EXPECT_EQ(formatSeconds(0.2), u"< 1 s");
  EXPECT_EQ(formatSeconds(59.4), u"59 s");
  EXPECT_EQ(formatSeconds(200), u"3 min 20 s");
  EXPECT_EQ(formatSeconds(3900), u"1 h 5 min");
}

}  // namespace
}  // namespace prt::ui
