// A link in virtual time: coming up, stats, stalls, losses and the end.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/device/link/link_rig.h"

namespace hapticwall::device {
namespace {

using hid::FaultKind;
using testing::kMillisecondUs;
using testing::Rig;

hid::ForceReport decoded(const hid::ReportBytes& bytes) {
  const auto report = hid::decode_force(bytes);
  EXPECT_NE(report.report(), nullptr);
  return report.report() == nullptr ? hid::ForceReport{} : *report.report();
}

TEST(LinkHost, BeginsWithACommandWithoutEnableAndSequenceOne) {
  Rig rig;
  std::vector<hid::ForceReport> reports;
  rig.host.on_report = [&](const hid::ReportBytes& bytes) { reports.push_back(decoded(bytes)); };
  rig.drive_until_ms(200);
  ASSERT_GT(reports.size(), 100U);
  EXPECT_EQ(reports.front().force_n[0], 0.0);
  EXPECT_FALSE(reports.front().enable);
  for (std::size_t i = 0; i < reports.size(); ++i) {
    EXPECT_EQ(reports[i].sequence, i + 1);
    EXPECT_EQ(reports[i].time_to_live_ms, 20);
  }
  EXPECT_TRUE(reports.back().enable);
  EXPECT_EQ(reports.back().echoed_state_sequence, 200);  // the tick that it was computed from
  EXPECT_EQ(reports.back().force_n[0], -testing::kPushN);
}

TEST(LinkHost, TellsPositionTimesAndDelay) {
  Rig rig;
  rig.drive_until_ms(500);
  const LinkStats stats = rig.host.stats();
  EXPECT_TRUE(stats.connected);
  EXPECT_TRUE(stats.calibrated);
  EXPECT_TRUE(stats.enabled);
  EXPECT_EQ(stats.trouble, Trouble::kNone);
  EXPECT_EQ(stats.missing_states + stats.void_reports + stats.repeated_states, 0U);
  EXPECT_EQ(stats.losses, 0U);
  EXPECT_NEAR(stats.device_period_s, 1e-3, 1e-12);
  EXPECT_NEAR(stats.age_s, 300e-6, 1e-12);         // the loop runs 300 µs after the tick
  EXPECT_NEAR(stats.round_trip_s, 350e-6, 1e-12);  // the loop writes 50 µs later
  EXPECT_NEAR(stats.maximum_round_trip_s, 350e-6, 1e-12);
  EXPECT_NEAR(stats.delay_s, 1e-3, 1e-12);  // the command acts at the next tick
  EXPECT_NEAR(stats.maximum_delay_s, 1e-3, 1e-12);
  EXPECT_NEAR(rig.host.last.device_time_s, 0.5, 1e-9);
  const double counts = rig.plug.device.state().position_counts[0];
  // The encoder as the device tells it: a whole number of counts per metre.
  EXPECT_DOUBLE_EQ(rig.host.last.position_m[0], counts / 3937.0);
}

TEST(LinkHost, SpoiltReportsNowAndThenAreCountedAndDoNoHarm) {
  for (const FaultKind kind : {FaultKind::kEmpty, FaultKind::kShort, FaultKind::kOverLong,
                               FaultKind::kWrongId, FaultKind::kWrongMajor, FaultKind::kBadCrc,
                               FaultKind::kAllZero, FaultKind::kSkipped, FaultKind::kRepeated}) {
    SCOPED_TRACE(static_cast<int>(kind));
    constexpr std::uint64_t kStruck = 250;
    Rig rig({{kind, 300 * kMillisecondUs, 1000 * kMillisecondUs, 4}});
    rig.plug.tells_empty = true;
    rig.drive_until_ms(299);
    bool held = true;
    rig.host.after_tick = [&] { held = held && rig.pushes(); };
    rig.tick_until_ms(1500);
    EXPECT_TRUE(held);
    EXPECT_TRUE(rig.host.troubles.empty());
    const LinkStats& stats = rig.host.stats();
    const bool is_void = kind != FaultKind::kSkipped && kind != FaultKind::kRepeated;
    EXPECT_EQ(stats.void_reports, is_void ? kStruck : 0U);
    EXPECT_EQ(stats.repeated_states, kind == FaultKind::kRepeated ? kStruck : 0U);
    EXPECT_EQ(stats.missing_states, kStruck);
    EXPECT_EQ(stats.losses, 0U);
    EXPECT_NEAR(stats.device_period_s, 1e-3, 1e-12);
    // One tick older than usual if the newest report is corrupt.
    EXPECT_NEAR(stats.maximum_age_s, 1300e-6, 1e-12);
  }
}

TEST(LinkHost, AnEmptyPacketMayLookLikeSilence) {
  Rig rig({{FaultKind::kEmpty, 300 * kMillisecondUs, 1000 * kMillisecondUs, 4}});
  rig.drive_until_ms(1500);
  EXPECT_EQ(rig.host.stats().void_reports, 0U);
  EXPECT_EQ(rig.host.stats().missing_states, 250U);
}

TEST(LinkHost, AReaderThatWasAwayForALittleTakesTheNewest) {
  Rig rig;
  rig.drive_until_ms(300);
  rig.host.reader_stalled = true;
  rig.host.ticks(15);
  EXPECT_NEAR(rig.host.stats().age_s, 15.3e-3, 1e-9);
  rig.host.reader_stalled = false;
  rig.host.tick();
  EXPECT_NEAR(rig.host.stats().age_s, 0.3e-3, 1e-9);
  EXPECT_NEAR(rig.host.last.device_time_s, 0.316, 1e-9);
  EXPECT_TRUE(rig.host.troubles.empty());
  EXPECT_EQ(rig.host.stats().missing_states, 0U);
}

// The kernel's queue holds the oldest 63 reports: a reader that returns after a second finds old
// ones.
TEST(LinkHost, AHostThatStallsForASecondActsOnNothingOld) {
  Rig rig;
  rig.drive_until_ms(300);
  rig.host.stalled = true;
  rig.host.ticks(1000);
  EXPECT_LE(rig.last_force_us, 322 * kMillisecondUs);  // the time to live
  rig.host.stalled = false;
  rig.host.tick();
  EXPECT_EQ(rig.host.last.state, DeviceState::kFault);
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kHeldUp);
  rig.host.ticks(1000);
  EXPECT_TRUE(rig.saw(Trouble::kWatchdog));  // the device says so when it is heard again
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kNone);
  EXPECT_EQ(rig.host.stats().losses, 1U);
  EXPECT_LE(rig.last_force_us, 322 * kMillisecondUs);
  rig.host.rearm();
  rig.host.ticks(5);
  EXPECT_TRUE(rig.pushes());
}

TEST(LinkHost, ALoopThatStallsTripsTheWatchdogAndIsToldOfIt) {
  Rig rig;
  rig.drive_until_ms(300);
  rig.host.loop_stalled = true;
  rig.host.ticks(60);
  EXPECT_LE(rig.last_force_us, 322 * kMillisecondUs);
  rig.host.loop_stalled = false;
  rig.host.tick();
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kWatchdog);
  EXPECT_EQ(rig.host.last.state, DeviceState::kFault);
  EXPECT_LT(rig.host.last.age_s, 1e-3);
  rig.host.ticks(100);
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kNone);  // cleared, and still off
  EXPECT_EQ(rig.force_n(), 0.0);
  EXPECT_EQ(rig.host.stats().losses, 0U);
}

// The hanging command arrives with an echo of 300 ms: the device rejects it.
TEST(LinkHost, AWriteThatHangsBringsNoOldForceBack) {
  Rig rig({{FaultKind::kNoOutput, 300 * kMillisecondUs, 400 * kMillisecondUs}});
  rig.drive_until_ms(299);
  rig.tick_until_ms(1000);
  EXPECT_LE(rig.last_force_us, 322 * kMillisecondUs);
  EXPECT_TRUE(rig.saw(Trouble::kWatchdog));
  EXPECT_NEAR(rig.host.stats().maximum_write_time_s, 0.4, 2e-3);
  EXPECT_LT(rig.host.stats().write_time_s, 1e-3);
  EXPECT_EQ(rig.host.stats().rejected_commands, 1U);
  EXPECT_EQ(rig.host.stats().losses, 0U);
}

TEST(LinkHost, AnUnpluggedDeviceWhoseWriteHangsComesBackOnFreshHandles) {
  Rig rig;
  rig.drive_until_ms(300);
  rig.plug.writes_hang = true;
  rig.host.ticks(5);
  rig.plug.hidden = true;
  rig.host.ticks(300);
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kUnplugged);
  EXPECT_EQ(rig.bus.open_handles(), 1U);  // that of the write
  rig.plug.hidden = false;
  ASSERT_TRUE(rig.host.ticks_until([&] { return rig.host.stats().connected; }, 1500));
  EXPECT_EQ(rig.bus.open_handles(), 3U);
  EXPECT_EQ(rig.force_n(), 0.0);
  rig.plug.writes_hang = false;
  rig.host.ticks(10);
  EXPECT_EQ(rig.bus.open_handles(), 2U);
  rig.host.rearm();
  rig.host.ticks(20);
  EXPECT_TRUE(rig.pushes());
}

TEST(LinkHost, WritesThatHangOneAfterTheOtherDoNotPileUp) {
  Rig rig;
  ASSERT_TRUE(rig.host.come_up());
  rig.plug.writes_hang = true;
  std::size_t most = 0;
  rig.host.after_tick = [&] { most = std::max(most, rig.bus.open_handles()); };
  for (int i = 0; i < 40; ++i) {
    rig.plug.hidden = i % 2 == 0;
    rig.host.ticks(100);
  }
  EXPECT_LE(most, 6U);  // four that hang, and two
  rig.plug.writes_hang = false;
  rig.plug.hidden = false;
  EXPECT_TRUE(rig.host.ticks_until([&] { return rig.host.stats().connected; }, 3000));
  rig.host.ticks(10);
  EXPECT_EQ(rig.bus.open_handles(), 2U);
}

TEST(LinkHost, LooksAgainWithABackOff) {
  Rig rig;
  rig.drive_until_ms(300);
  rig.plug.hidden = true;
  std::vector<std::uint64_t> looked_ms;
  int lists = rig.bus.lists;
  rig.host.after_tick = [&] {
    if (rig.bus.lists != lists) looked_ms.push_back(rig.host.now_us() / kMillisecondUs);
    lists = rig.bus.lists;
  };
  rig.host.ticks(5000);
  ASSERT_GE(looked_ms.size(), 7U);
  EXPECT_NEAR(static_cast<double>(looked_ms[0]), 300.0 + 20.0 + 50.0, 7.0);
  const std::vector<std::uint64_t> waits_ms{50, 100, 200, 400, 800, 1000, 1000};
  for (std::size_t i = 0; i + 1 < looked_ms.size() && i < waits_ms.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(looked_ms[i + 1] - looked_ms[i]),
                static_cast<double>(waits_ms[i]), 1.0);
  }
  EXPECT_EQ(rig.host.owner.words(),
            "/dev/hidraw0 is no longer connected: plug the device in again");
  EXPECT_EQ(rig.bus.open_handles(), 0U);
}

TEST(LinkHost, ALossAndAReturnBetweenTwoLooksOfTheLoopIsNoSecret) {
  for (const bool armed : {false, true}) {
    Rig rig;
    rig.host.behaviour.disarms = false;  // asks all the time
    ASSERT_TRUE(rig.host.come_up());
    rig.host.armed = armed;
    rig.tick_until_ms(300);
    rig.host.loop_stalled = true;
    rig.plug.hidden = true;
    rig.host.ticks(40);
    rig.plug.hidden = false;
    rig.host.ticks(200);
    rig.host.loop_stalled = false;
    rig.host.tick();
    EXPECT_EQ(rig.host.last.state, DeviceState::kFault);
    EXPECT_EQ(rig.host.stats().trouble, armed ? Trouble::kWatchdog : Trouble::kUnplugged);
    EXPECT_TRUE(rig.host.stats().connected);
    rig.host.ticks(100);
    EXPECT_EQ(rig.force_n(), 0.0);
    EXPECT_EQ(rig.host.last.state, armed ? DeviceState::kFault : DeviceState::kOk);
  }
}

TEST(LinkHost, ARestartBehindABridgeBringsTheLinkUpAnewAtTheStart) {
  ImpulseEngineOptions options;
  options.start_m = {0.07, 0.0};
  Rig rig({{FaultKind::kRestart, 300 * kMillisecondUs, 5 * kMillisecondUs}}, options);
  rig.plug.bridged = true;
  rig.drive_until_ms(299);
  EXPECT_NEAR(rig.host.last.position_m[0], 0.03, 0.02);  // calibrated: the device's own
  rig.tick_until_ms(320);
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kRestarted);
  EXPECT_EQ(rig.host.owner.words(),
            "/dev/hidraw0: the device has restarted: its clock or its sequence jumped");
  ASSERT_TRUE(rig.host.come_up());
  EXPECT_FALSE(rig.host.stats().calibrated);
  EXPECT_DOUBLE_EQ(rig.host.last.position_m[0], 0.07);
  EXPECT_EQ(rig.host.stats().losses, 1U);
  rig.host.ticks(100);
  EXPECT_EQ(rig.force_n(), 0.0);
}

TEST(LinkHost, StopTakesTheForceAwayAndClosesAll) {
  Rig rig;
  std::vector<hid::ForceReport> reports;
  rig.drive_until_ms(300);
  rig.host.on_report = [&](const hid::ReportBytes& bytes) { reports.push_back(decoded(bytes)); };
  rig.host.owner.stop();
  rig.host.ticks(10);
  EXPECT_EQ(rig.host.owner.ending(), Ending::kEnded);
  EXPECT_EQ(rig.bus.open_handles(), 0U);
  ASSERT_FALSE(reports.empty());
  EXPECT_FALSE(reports.back().enable);
  EXPECT_EQ(rig.force_n(), 0.0);
  rig.host.ticks(100);
  EXPECT_EQ(rig.bus.open_handles(), 0U);
  EXPECT_EQ(rig.host.last.state, DeviceState::kFault);
}

TEST(LinkHost, StopWaitsForNoWriteThatHangs) {
  Rig rig;
  rig.drive_until_ms(300);
  rig.plug.writes_hang = true;
  rig.host.ticks(2);
  rig.host.owner.stop();
  rig.host.ticks(110);
  EXPECT_EQ(rig.host.owner.ending(), Ending::kLeftAlone);
  rig.host.ticks(5000);  // as long as the kernel waits
  EXPECT_EQ(rig.host.owner.ending(), Ending::kEnded);
  EXPECT_EQ(rig.bus.open_handles(), 0U);
}

TEST(LinkHost, TwoAxesAllTheWay) {
  Rig rig({}, {}, hid::testing::two_axes());
  rig.host.behaviour.force_n = {1.0, -7.0};  // more than the second axis may
  ASSERT_TRUE(rig.host.come_up());
  EXPECT_DOUBLE_EQ(rig.host.last.position_m[0], 118 / 3937.0);  // 30 mm, rounded to counts
  EXPECT_DOUBLE_EQ(rig.host.last.position_m[1], -79 / 3937.0);  // -20 mm, rounded to counts
  rig.host.arm();
  rig.tick_until_ms(300);
  const auto force_n = rig.plug.device.amplifier_force_n();
  EXPECT_EQ(force_n[0], -1.0);
  EXPECT_EQ(force_n[1], 5.0);
  EXPECT_FALSE((rig.plug.device.state().status & hid::kStatusSaturated) != 0);
}

TEST(LinkHost, AForceThatIsNoNumberIsNoForce) {
  Rig rig;
  rig.drive_until_ms(300);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    rig.host.behaviour.force_n = {bad, 0.0};
    rig.host.ticks(2);
    EXPECT_EQ(rig.force_n(), 0.0);
    EXPECT_EQ(rig.plug.device.state().status & hid::kStatusEnabled, 0);
    rig.host.behaviour.force_n = {testing::kPushN, bad};
    rig.host.ticks(2);
    EXPECT_EQ(rig.force_n(), 0.0);
  }
}

TEST(LinkHost, AForceBeyondTheLimitIsTheLimit) {
  ImpulseEngineOptions options;
  options.axes[0] = AxisDescription{0.0, 3.4567};
  Rig rig({}, options);
  rig.host.behaviour.force_n = {-1e6, 0.0};
  ASSERT_TRUE(rig.host.come_up());
  rig.host.arm();
  rig.host.ticks(5);
  EXPECT_DOUBLE_EQ(rig.force_n(), 3.456);  // never more, in whole millinewtons
}

}  // namespace
}  // namespace hapticwall::device
