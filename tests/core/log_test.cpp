#include "libprt/core/log.h"
#include "libprt/core/error.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace prt {
namespace {

class Log : public testing::Test {
 protected:
  void TearDown() override { setLogHandler(LogLevel::Warning, {}); }
};

TEST_F(Log, HandlerGetsItsLevelAndWorse) {
  std::vector<std::pair<LogLevel, std::string>> seen;
  setLogHandler(LogLevel::Info,
                [&](LogLevel level, std::string_view text) { seen.emplace_back(level, text); });
  logDebug("no");
  logInfo("two\nlines");
  logWarning("w");
  logError("e");
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_EQ(seen[0], std::pair(LogLevel::Info, std::string("two lines")));
  EXPECT_EQ(seen[2], std::pair(LogLevel::Error, std::string("e")));
  setLogLevel(LogLevel::Off);
  logError("nothing passes");
  EXPECT_EQ(seen.size(), 3u);
}

TEST_F(Log, DefaultGoesToStderrInOneLine) {
  testing::internal::CaptureStderr();
  logInfo("quiet by default");
  logWarning("12 duplicate vertices merged");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "prt: warning: 12 duplicate vertices merged\n");
}

TEST_F(Log, ThreadsTakeTurns) {
  int inside = 0, count = 0;
  bool overlapped = false;
  setLogHandler(LogLevel::Debug, [&](LogLevel, std::string_view) {
    overlapped = overlapped || ++inside != 1;
    ++count;
    --inside;
  });
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([] {
      for (int i = 0; i < 250; ++i) logDebug("x");
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(count, 1000);
  EXPECT_FALSE(overlapped);
}

TEST_F(Log, LevelsHaveNames) {
  for (LogLevel level : {LogLevel::Debug, LogLevel::Info, LogLevel::Warning, LogLevel::Error, LogLevel::Off})
    EXPECT_EQ(logLevelFromString(toString(level)), level);
  EXPECT_THROW(logLevelFromString("loud"), ValueError);
}

}  // namespace
}  // namespace prt
