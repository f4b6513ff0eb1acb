#pragma once
// One windowless OpenGL context for all GL tests of a process.

#include "libprt/gl/headless_context.h"
#include "libprt/gl/objects.h"

#include <gtest/gtest.h>

namespace prt::test {

class GlTest : public testing::Test {
 protected:
  GlTest() {
    static gl::HeadlessContext context;
    context.makeCurrent();
  }
  void TearDown() override { EXPECT_NO_THROW(gl::checkErrors("end of the test")); }
};

}  // namespace prt::test
