#include "libprt/gl/headless_context.h"

#include "tests/gl/gl_test_support.h"

namespace prt::gl {
namespace {

using HeadlessContextTest = test::GlTest;

TEST_F(HeadlessContextTest, IsOpenGl45Core) {
  EXPECT_TRUE(contextIsSufficient());
  EXPECT_EQ(describeContext().substr(0, 2), "4.") << describeContext();
}

TEST_F(HeadlessContextTest, CanBeMadeAgainAndAgain) {
  for (int i = 0; i < 3; ++i) {
    HeadlessContext other;
    EXPECT_TRUE(contextIsSufficient());
  }
}

TEST_F(HeadlessContextTest, TellsSoftwareFromCards) {
  EXPECT_EQ(contextIsSoftware(), describeContext().find("llvmpipe") != std::string::npos ||
                                     describeContext().find("softpipe") != std::string::npos);
}

}  // namespace
}  // namespace prt::gl
