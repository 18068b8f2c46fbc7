// Real recordings in a temporary folder, replayed in the window with a manual clock.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/session/live_session.h"
#include "app/session/replay_session.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {

class ReplayGuiTest : public GuiTest {
 protected:
  class Clock final : public session::Clock {
   public:
    explicit Clock(const std::int64_t& now_ns) : now_ns_(now_ns) {}
    [[nodiscard]] std::int64_t now_ns() override { return now_ns_; }
    void sleep_until_ns(std::int64_t /*deadline_ns*/) override {}

   private:
    const std::int64_t& now_ns_;
  };

  void SetUp() override {
    open_recording = [this](const std::string& csv_path, const file::ReadProgress& progress)
        -> Result<std::unique_ptr<session::ReplaySession>> {
      auto reader = file::RecordingReader::open(csv_path, progress);
      if (!reader) return reader.error();
      return std::make_unique<session::ReplaySession>(std::move(*reader),
                                                      std::make_unique<Clock>(now_ns_));
    };
    options.recording_folder = path("");
    GuiTest::SetUp();
  }

  // Records with a real loop and recorder from tick 0 on; the marks are evenly spaced.
  void record(const std::string& name, std::uint64_t ticks,
              const std::vector<std::string>& marks = {}) {
    session::SessionOptions paused;
    paused.start_paused = true;
    auto session = session::LiveSession::start(session::test::contact_scene(), paused);
    ASSERT_TRUE(session) << session.error().message;
    ASSERT_FALSE((*session)->start_recording(path(name)));
    const std::uint64_t leg = ticks / (marks.size() + 1);
    std::uint64_t done = 0;
    const auto go_on = [&](std::uint64_t more) {
      (*session)->step(static_cast<std::uint32_t>(more));
      done += more;
      return session::test::eventually([&] { return (*session)->snapshot().timing.ticks >= done; });
    };
    for (const std::string& mark : marks) {
      ASSERT_TRUE(go_on(leg));
      ASSERT_FALSE((*session)->mark(mark));
    }
    ASSERT_TRUE(go_on(ticks - done));
    ASSERT_FALSE((*session)->stop_recording());
  }

  [[nodiscard]] bool replaying() { return application_->replay() != nullptr; }
  [[nodiscard]] session::ReplaySession& replay() { return *application_->replay(); }
  void pass_ms(std::int64_t milliseconds) {
    now_ns_ += milliseconds * 1'000'000;
    frames(2);
  }

  std::int64_t now_ns_ = 1;
};

}  // namespace hapticwall::test
