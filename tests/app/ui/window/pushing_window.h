// The real window on a pushing device.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>

#include "app/ui/window/window.h"
#include "tests/app/session/loop/child_support.h"

namespace hapticwall::test {

using session::test::Shared;
using session::test::SharedDevice;

// The window on a test device that pushes before the first frame.
struct PushingWindow {
  explicit PushingWindow(Shared& shared) : heard(shared) {
    options.scene = session::test::contact_scene();
    options.start_on_device =
        [this](const Scene& /*scene*/,
               BorrowedAlgorithm* /*borrowed*/) -> Result<std::unique_ptr<session::LiveSession>> {
      auto device = std::make_unique<SharedDevice>(*heard);
      device->on_words = in_a_panel;
      device->on_read = in_a_tick;
      return session::test::pushing_session(*heard, std::move(device));
    };
    hooks.painted_of = 10;
  }

  void expect_safe_end() const {
    EXPECT_TRUE(heard->pushed());
    EXPECT_EQ(heard->newest_n, 0.0);
    EXPECT_FALSE(heard->enabled);
    EXPECT_TRUE(heard->closed);
  }

  Shared& heard;
  session::WindowOptions options;
  ui::WindowHooks hooks;
  std::function<void()> in_a_panel;  // called in the middle of every frame
  std::function<void()> in_a_tick;   // called in every tick, on the loop's thread
};

}  // namespace hapticwall::test
