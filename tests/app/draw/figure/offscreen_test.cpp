// Contexts without a display do not disturb each other: a figure is drawn in one of its own.
#include "app/draw/figure/offscreen.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <gtest/gtest.h>

#include <future>

namespace hapticwall::draw {
namespace {

TEST(Offscreen, OneContextOutlivesAnother) {
  const auto context = OffscreenContext::create();
  ASSERT_TRUE(context.ok()) << context.error().message;
  std::async(std::launch::async, [] {
    const auto another = OffscreenContext::create();
    EXPECT_TRUE(another.ok());
  }).get();
  EGLint version = 0;
  EXPECT_EQ(eglQueryContext(eglGetCurrentDisplay(), eglGetCurrentContext(),
                            EGL_CONTEXT_CLIENT_VERSION, &version),
            EGL_TRUE);
  EXPECT_GE(version, 3);
}

}  // namespace
}  // namespace hapticwall::draw
