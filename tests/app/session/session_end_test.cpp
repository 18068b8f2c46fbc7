// How a session begins and ends: in every state with zero force, joined threads and whole files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/session/live_session.h"
#include "app/session/loop/realtime_setup.h"
#include "tests/app/session/loop/fake_writer.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::eventually;
using test::expect_without_gap;
using test::FakeDevice;
using test::lines_of;
using test::repeated_rows;
using test::rows_reach;
using test::started;
using test::started_paused;
using test::TemporaryFolder;
using test::text_of;
using test::tick_of;
using test::ticks_reach;
using ::testing::HasSubstr;

TEST(SessionEnd, AnUnstoppedRecordingIsFinishedWhole) {
  const TemporaryFolder folder;
  auto session = started(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  ASSERT_TRUE(rows_reach(*session, 30));
  session.reset();
  const auto lines = lines_of(folder.file("a.csv"));
  ASSERT_GT(lines.size(), 30U);
  expect_without_gap(lines, tick_of(lines[1]));
  EXPECT_EQ(repeated_rows(folder.file("a.toml")).size() + 1, lines.size());
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.csv.partial")));
}

TEST(SessionEnd, ARecordingWithoutATickIsAnEmptyWholeFile) {
  const TemporaryFolder folder;
  auto session = started_paused(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  session.reset();
  EXPECT_EQ(lines_of(folder.file("a.csv")).size(), 1U);
}

// State of a device as seen from outside, also after the session has destroyed the device.
struct DeviceView {
  std::atomic<bool> unplugged{false};
  std::atomic<double> position_m{0.03};
  std::vector<std::string> log;  // set when the device is destroyed
};

class WatchedDevice : public FakeDevice {
 public:
  explicit WatchedDevice(std::shared_ptr<DeviceView> view) : view_(std::move(view)) {}
  ~WatchedDevice() override {
    if (!forces_n.empty()) log.push_back(std::to_string(forces_n.back()));
    view_->log = log;
  }
  [[nodiscard]] DeviceReading read() override {
    if (view_->unplugged) throw std::runtime_error("unplugged");
    position_m = view_->position_m;
    return FakeDevice::read();
  }

 private:
  std::shared_ptr<DeviceView> view_;
};

struct WatchedSession {
  explicit WatchedSession(SessionOptions options = {}) {
    auto device = std::make_unique<WatchedDevice>(view);
    options.allow_no_realtime = true;
    auto result = LiveSession::start_on(std::move(device), contact_scene(), options);
    if (result) session = std::move(*result);
  }
  void expect_safe_end() {
    session.reset();
    const std::vector<std::string>& log = view->log;
    ASSERT_GE(log.size(), 4U);
    EXPECT_EQ(log.front(), "open");
    EXPECT_EQ(log[log.size() - 3], "write");
    EXPECT_EQ(log[log.size() - 2], "close");
    EXPECT_EQ(log.back(), std::to_string(0.0)) << "the last force";
  }

  std::shared_ptr<DeviceView> view = std::make_shared<DeviceView>();
  std::unique_ptr<LiveSession> session;
};

TEST(SessionEnd, RunningItLeavesZeroForceAndAClosedDevice) {
  WatchedSession watched;
  constexpr double kFreeM = 0.03;
  constexpr double kInsideM = 0.051;
  // A delay by the machine disarms the loop: arm again.
  ASSERT_TRUE(eventually([&] {
    const Snapshot now = watched.session->snapshot();
    if (now.arming.state == ArmingState::kOff) {
      watched.view->position_m = kFreeM;
      watched.session->arm(true);
    }
    if (now.arming.state == ArmingState::kOn) watched.view->position_m = kInsideM;
    return now.newest.x().force_n > 0.0;
  }));
  watched.expect_safe_end();
}

TEST(SessionEnd, PausedItDoesToo) {
  SessionOptions options;
  options.start_paused = true;
  WatchedSession(options).expect_safe_end();
}

TEST(SessionEnd, AfterAFaultNothingHangsAndTheRecordingIsWhole) {
  const TemporaryFolder folder;
  WatchedSession watched;
  ASSERT_FALSE(watched.session->start_recording(folder.file("a.csv")));
  ASSERT_TRUE(rows_reach(*watched.session, 10));
  watched.view->unplugged = true;
  ASSERT_TRUE(eventually([&] { return watched.session->snapshot().ended_by_fault; }));
  EXPECT_FALSE(watched.session->stop_recording());
  EXPECT_GT(lines_of(folder.file("a.csv")).size(), 10U);
  EXPECT_THAT(text_of(folder.file("a.toml")), HasSubstr("repeatable = false"));
  ASSERT_FALSE(watched.session->start_recording(folder.file("b.csv")));
  watched.session->reset();
  watched.session->pause(true);
  watched.expect_safe_end();
}

TEST(SessionStart, RefusesAnInvalidSceneAndADeviceThatDoesNotOpen) {
  Scene scene = contact_scene();
  scene.x().device.mass_kg = -1.0;
  const auto invalid = LiveSession::start(scene);
  ASSERT_FALSE(invalid);
  EXPECT_EQ(invalid.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(invalid.error().message, HasSubstr("device.mass_kg"));

  auto device = std::make_unique<FakeDevice>();
  device->open_failure = Error{ErrorKind::kDevice, "no such device"};
  const auto closed = LiveSession::start_on(std::move(device), contact_scene());
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().kind, ErrorKind::kDevice);
}

// A late force is a wrong force: only who asks for it gets a device without real-time priority.
TEST(SessionStart, HardwareWithoutRealtimePriorityIsRefusedUnlessAllowed) {
  RealtimeStatus status;
  status.text = "no real-time priority (Operation not permitted)";
  status.advice = "allow it";
  const device::DeviceInfo hardware{"paddle", false};
  const Failure refused = refuse_without_realtime(hardware, status, false);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->kind, ErrorKind::kDevice);
  EXPECT_THAT(refused->message, HasSubstr("paddle: no real-time priority"));
  EXPECT_THAT(refused->message, HasSubstr("--allow-no-realtime"));
  EXPECT_FALSE(refuse_without_realtime(hardware, status, true));
  EXPECT_FALSE(refuse_without_realtime({"simulator", true}, status, false));
  status.fifo_priority = true;
  EXPECT_FALSE(refuse_without_realtime(hardware, status, false));
}

// The device's own values hold, but it cannot allow more force than the scene does.
TEST(SessionStart, TheDevicesResolutionAndSmallerLimitTakeThePlaceOfTheScenes) {
  for (const auto& [device_limit_n, expected_n] :
       {std::pair{5.0, 5.0}, std::pair{20.0, 8.9}, std::pair{0.0, 8.9}}) {
    auto device = std::make_unique<FakeDevice>();
    device->encoder_m = 1e-5;
    device->force_limit_n = device_limit_n;
    SessionOptions options;
    options.allow_no_realtime = true;
    const auto session = LiveSession::start_on(std::move(device), contact_scene(), options);
    ASSERT_TRUE(session);
    EXPECT_EQ((*session)->scene().x().device.encoder_m, 1e-5);
    EXPECT_EQ((*session)->scene().x().device.force_limit_n, expected_n);
    Scene wanted = contact_scene();
    wanted.x().device.force_limit_n = 100.0;
    wanted.x().device.encoder_m = 1e-3;
    EXPECT_FALSE((*session)->change_scene(wanted));
    EXPECT_EQ((*session)->scene().x().device.encoder_m, 1e-5);
    EXPECT_EQ((*session)->scene().x().device.force_limit_n,
              device_limit_n > 0.0 ? device_limit_n : 100.0);
  }
}

TEST(SessionStart, ACoreThatIsNotThereIsSaidAndTheLoopRunsAllTheSame) {
  SessionOptions options;
  options.affinity_core = 1000;
  const auto session = started(contact_scene(), options);
  EXPECT_FALSE(session->realtime_status().affinity_set);
  EXPECT_THAT(session->realtime_status().text, HasSubstr("not on core 1000"));
  EXPECT_TRUE(ticks_reach(*session, 10));
}

}  // namespace
}  // namespace hapticwall::session
