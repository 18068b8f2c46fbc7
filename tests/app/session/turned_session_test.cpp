// A session without a thread, which its owner turns.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "app/session/live_session.h"
#include "core/run/simulate.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using test::all_samples;
using test::contact_scene;
using test::FakeDevice;
using test::TemporaryFolder;
using test::TurnedSession;

// The bytes that a recording of them has.
std::string rows_of(const std::vector<Sample>& samples) {
  std::string rows;
  for (const Sample& sample : samples)
    file::append_csv_row(rows, {{sample}}, file::csv_columns(true));
  return rows;
}

TEST(TurnedSession, HasTheBitsOfAHeadlessRunUnderEveryAlgorithm) {
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    Scene scene = file::load_scene("press")->scene;
    scene.algorithm.index = i;
    std::vector<Sample> headless;
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) { headless.push_back(sample); };
    static_cast<void>(simulate(scene, options));
    TurnedSession session(scene);
    EXPECT_TRUE(rows_of(session.pass(headless.size())) == rows_of(headless))
        << algorithms()[i].name;
  }
}

TEST(TurnedSession, RunsNothingBeforeItIsDue) {
  TurnedSession session(contact_scene());
  EXPECT_TRUE(all_samples(*session).empty());
  session.clock().advance_ns(999'999);
  EXPECT_TRUE(all_samples(*session).empty());
  session.clock().advance_ns(1);
  EXPECT_EQ(all_samples(*session).size(), 1U);
  EXPECT_TRUE(all_samples(*session).empty()) << "it ran already";
}

TEST(TurnedSession, LeavesALongGapOutAndMissesNothing) {
  TurnedSession session(contact_scene());
  EXPECT_EQ(session.pass(10).size(), 10U);
  session.clock().advance_ns(kMaxTurnNs);
  EXPECT_EQ(all_samples(*session).size(), 100U) << "so much is made up for";
  session.clock().advance_ns(kMaxTurnNs + 5'000'000);
  EXPECT_EQ(all_samples(*session).size(), 101U) << "a window that is a little too slow";
  session.clock().advance_ns(10'000'000'000);
  const std::vector<Sample> after = all_samples(*session);
  ASSERT_EQ(after.size(), 101U);
  EXPECT_EQ(after.front().tick, 211U) << "the simulated time goes on where it stood";
  session.clock().advance_ns(16'000'000);
  EXPECT_EQ(all_samples(*session).size(), 16U);
  EXPECT_EQ(session->snapshot().timing.missed_ticks, 0U);
  EXPECT_EQ(session->snapshot().timing.maximum_wake_latency_s, 0.0);
}

TEST(TurnedSession, RecordsEveryRow) {
  const TemporaryFolder folder;
  TurnedSession session(contact_scene());
  const std::string csv = folder.file("a.csv");
  ASSERT_FALSE(session->start_recording(csv));
  EXPECT_EQ(session.pass(500).size(), 500U);
  ASSERT_FALSE(session->stop_recording());
  EXPECT_EQ(session->recording_status().dropped_rows, 0U);
  const std::vector<std::string> lines = test::lines_of(csv);
  ASSERT_GE(lines.size(), 500U);
  test::expect_repeated(lines, folder.file("a.toml"));
}

// A hand on a device must not wait for a window.
TEST(TurnedSession, IsRefusedToADevice) {
  SessionOptions options;
  options.driver = Driver::kTurnedByOwner;
  const auto session =
      LiveSession::start_on(std::make_unique<FakeDevice>(), contact_scene(), options);
  ASSERT_FALSE(session);
  EXPECT_THAT(session.error().message, ::testing::HasSubstr("its own thread"));
}

// A simulator never throws; the driver keeps its promise for all that.
TEST(TurnedSession, EndsWithoutForceWhenADeviceThrows) {
  auto device = std::make_unique<FakeDevice>();
  device->throw_at_read = 5;
  FakeDevice& seen = *device;
  test::FakeClock clock;
  SessionOptions options;
  options.driver = Driver::kTurnedByOwner;
  options.clock = &clock;
  LoopSession session(test::one_device(std::move(device)), scene_on(contact_scene(), seen.info()),
                      options);
  clock.advance_ns(20'000'000);
  EXPECT_EQ(all_samples(session).size(), 3U) << "a start reads the device, too";
  EXPECT_TRUE(session.snapshot().ended_by_fault);
  EXPECT_EQ(seen.forces_n.back(), 0.0);
  EXPECT_FALSE(seen.enabled);
  EXPECT_EQ(seen.log.back(), "close");
  clock.advance_ns(20'000'000);
  EXPECT_TRUE(all_samples(session).empty());
}

}  // namespace
}  // namespace hapticwall::session
