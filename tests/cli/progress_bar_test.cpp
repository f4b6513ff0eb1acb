#include "app/cli/progress_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace prt::cli {
namespace {

using testing::HasSubstr;

TEST(ProgressBar, TellsRateAndTimeLeft) {
  const Progress half{"direct transfer", 5e6, 1e7, "rays", 2.5};
  const std::string line = progressLine(half, 100);
  EXPECT_THAT(line, HasSubstr("direct transfer"));
  EXPECT_THAT(line, HasSubstr("50 %"));
  EXPECT_THAT(line, HasSubstr("2.00 M rays/s"));
  EXPECT_THAT(line, HasSubstr("0:03 left"));
  EXPECT_THAT(line, HasSubstr("[###############---------------]"));
}

TEST(ProgressBar, FitsNarrowTerminals) {
  const Progress p{"a rather long name of a phase", 5e6, 1e7, "rays", 2.5};
  for (int width = 0; width < 120; ++width) EXPECT_LE(int(progressLine(p, width).size()), width);
}

TEST(ProgressBar, KeepsQuietAboutWhatIsNotKnown) {
  const Progress p{"reading", 0, 0, "bytes", 3};
  EXPECT_EQ(progressLine(p, 80), "reading");
}

TEST(ProgressBar, NumbersAreShort) {
  EXPECT_EQ(shortNumber(0), "0");
  EXPECT_EQ(shortNumber(999), "999");
  EXPECT_EQ(shortNumber(12345), "12.3 k");
  EXPECT_EQ(shortNumber(6.5e6), "6.50 M");
  EXPECT_EQ(byteCount(512), "512 bytes");
  EXPECT_EQ(byteCount(1536), "1.50 KB");
  EXPECT_EQ(shortTime(0.2), "0:01");
  EXPECT_EQ(shortTime(61), "1:01");
  EXPECT_EQ(shortTime(3661), "1:01:01");
}

}  // namespace
}  // namespace prt::cli
