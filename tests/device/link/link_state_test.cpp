// The reader's tracking of packets, one at a time.
#include "device/link/link_state.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>

namespace hapticwall::device {
namespace {

constexpr std::int64_t kMillisecondNs = 1'000'000;
constexpr double kCountM = 1e-3;

class LinkState : public ::testing::Test {
 protected:
  LinkState() {
    session.number = 1;
    session.device.axes = 1;
    session.device.axis[0] = {kCountM, 5.0};
    session.sent = sent;
    state.sequence = 100;
    state.time_us = 1'000'000;
    state.status = hid::kStatusCalibrated;
    tracker.begin(session);
  }

  // The next tick of the device, a millisecond later on both sides.
  void step(int ticks = 1) {
    state.sequence = static_cast<std::uint16_t>(state.sequence + ticks);
    state.time_us += static_cast<std::uint32_t>(1000 * ticks);
    now_ns += ticks * kMillisecondNs;
  }
  bool take() { return tracker.take(hid::encode_state(state), now_ns); }
  [[nodiscard]] const LinkStats& stats() const { return tracker.view().stats; }

  std::shared_ptr<SentCommands> sent = std::make_shared<SentCommands>();
  LinkSession session;
  StateTracker tracker;
  hid::StateReport state;
  std::int64_t now_ns = 5 * kMillisecondNs;
};

TEST_F(LinkState, KeepsTheNewest) {
  state.position_counts = {30, 7};
  ASSERT_TRUE(take());
  step();
  state.position_counts = {31, 7};
  ASSERT_TRUE(take());
  const LinkView& view = tracker.view();
  EXPECT_EQ(view.session, 1U);
  EXPECT_DOUBLE_EQ(view.position_m[0], 31 * kCountM);
  EXPECT_EQ(view.position_m[1], 0.0);  // there is no second axis
  EXPECT_EQ(view.limit_n, (AxisValues{5.0, 0.0}));
  EXPECT_EQ(view.received_ns, now_ns);
  EXPECT_EQ(view.device_time_us, 1'001'000);
  EXPECT_EQ(view.sequence, 101);
  EXPECT_EQ(stats().states, 2U);
}

TEST_F(LinkState, ARepeatIsCountedAndMakesNothingYounger) {
  ASSERT_TRUE(take());
  const std::int64_t received_ns = now_ns;
  now_ns += kMillisecondNs;
  EXPECT_FALSE(take());
  EXPECT_EQ(stats().repeated_states, 1U);
  EXPECT_EQ(tracker.view().received_ns, received_ns);
  now_ns += kLinkLostNs;
  EXPECT_FALSE(take());
  EXPECT_EQ(tracker.ended(), Trouble::kNone);  // the owner detects the loss by its clock
  step();
  EXPECT_FALSE(take());
  EXPECT_EQ(tracker.ended(), Trouble::kSilent);
}

TEST_F(LinkState, TwentyMillisecondsOfSilenceAreALossAndNotLess) {
  ASSERT_TRUE(take());
  step(20);
  EXPECT_TRUE(take());
  EXPECT_EQ(stats().missing_states, 19U);
  step(20);
  now_ns += 1;
  EXPECT_FALSE(take());
  EXPECT_EQ(tracker.ended(), Trouble::kSilent);
  EXPECT_EQ(tracker.view().trouble, Trouble::kSilent);
  step();
  EXPECT_FALSE(take()) << "nothing more of a link that is lost";
  EXPECT_EQ(stats().states, 2U);
}

TEST_F(LinkState, VoidReportsAreCountedAndNeverDecoded) {
  ASSERT_TRUE(take());
  step();
  state.position_counts = {1000, 0};
  hid::ReportBytes spoilt = hid::encode_state(state);
  spoilt[20] ^= 4U;
  EXPECT_FALSE(tracker.take(spoilt, now_ns));
  EXPECT_FALSE(tracker.take({}, now_ns));
  EXPECT_EQ(stats().void_reports, 2U);
  EXPECT_EQ(tracker.view().position_m[0], 0.0);
  EXPECT_EQ(tracker.view().received_ns, 5 * kMillisecondNs);
}

TEST_F(LinkState, SequenceAndClockWrap) {
  state.sequence = 65534;
  state.time_us = 0xFFFFFF00U;
  ASSERT_TRUE(take());
  const std::int64_t begin_us = tracker.view().device_time_us;
  for (int i = 0; i < 5; ++i) {
    step();
    ASSERT_TRUE(take());
  }
  EXPECT_EQ(tracker.view().sequence, 3);
  EXPECT_EQ(tracker.view().device_time_us, begin_us + 5000);
  EXPECT_EQ(stats().missing_states, 0U);
  EXPECT_DOUBLE_EQ(stats().device_period_s, 1e-3);
}

TEST_F(LinkState, AClockOrASequenceThatJumpsIsARestart) {
  const auto ends_with = [&](std::uint16_t sequence, std::uint32_t time_us) {
    tracker.begin(session);
    EXPECT_TRUE(take());
    const hid::StateReport before = state;
    state.sequence = sequence;
    state.time_us = time_us;
    now_ns += kMillisecondNs;
    EXPECT_FALSE(take());
    state = before;
    return tracker.ended();
  };
  EXPECT_EQ(ends_with(1, 1'001'000), Trouble::kRestarted);       // the sequence goes back
  EXPECT_EQ(ends_with(101, 999'000), Trouble::kRestarted);       // the clock goes back
  EXPECT_EQ(ends_with(101, 1'000'000), Trouble::kRestarted);     // the clock stands
  EXPECT_EQ(ends_with(101, 9'000'000), Trouble::kRestarted);     // the clock jumps
  EXPECT_EQ(ends_with(25'101, 1'001'000), Trouble::kRestarted);  // too many ticks for the time
}

TEST_F(LinkState, CalibrationThatChangesEndsTheLink) {
  for (const bool first : {true, false}) {
    tracker.begin(session);
    state.status = first ? hid::kStatusCalibrated : 0;
    step();
    ASSERT_TRUE(take());
    EXPECT_EQ(stats().calibrated, first);
    step();
    state.status = first ? 0 : hid::kStatusCalibrated;
    EXPECT_FALSE(take());
    EXPECT_EQ(tracker.ended(), Trouble::kCalibration);
  }
}

TEST_F(LinkState, AnUncalibratedHandleIsAtTheStartAtEveryLinkUp) {
  session.start_m = {0.03, 0.5};
  state.status = 0;
  state.position_counts = {-4000, 3};
  for (std::uint32_t number = 1; number <= 2; ++number) {
    session.number = number;
    tracker.begin(session);
    step();
    ASSERT_TRUE(take());
    EXPECT_DOUBLE_EQ(tracker.view().position_m[0], 0.03);
    EXPECT_EQ(tracker.view().position_m[1], 0.0);
    step();
    state.position_counts[0] += 5;
    ASSERT_TRUE(take());
    EXPECT_DOUBLE_EQ(tracker.view().position_m[0], 0.03 + 5 * kCountM);
  }
}

TEST_F(LinkState, EveryFaultIsATroubleByItsCodeOrItsBit) {
  constexpr std::pair<std::uint8_t, Trouble> kCodes[] = {
      {hid::kNoFault, Trouble::kNone},
      {hid::kFaultWatchdog, Trouble::kWatchdog},
      {hid::kFaultEmergencyStop, Trouble::kEmergencyStop},
      {hid::kFaultOverTemperature, Trouble::kOverTemperature},
      {hid::kFaultOverCurrent, Trouble::kOverCurrent},
      {hid::kFaultEncoder, Trouble::kEncoder},
      {hid::kFaultEncoder + 1, Trouble::kOwnFault},  // reserved: of a later minor version
      {hid::kFirstOwnFault - 1, Trouble::kOwnFault},
      {hid::kFirstOwnFault, Trouble::kOwnFault},
      {0xFF, Trouble::kOwnFault}};
  for (const auto& [code, trouble] : kCodes) {
    state.fault = code;
    EXPECT_EQ(fault_in(state), trouble);
    EXPECT_EQ(is_device_fault(trouble), trouble != Trouble::kNone);
  }
  state.fault = hid::kNoFault;
  constexpr std::pair<std::uint16_t, Trouble> kBits[] = {
      {hid::kStatusWatchdog, Trouble::kWatchdog},
      {hid::kStatusEmergencyStop, Trouble::kEmergencyStop},
      {hid::kStatusOverTemperature, Trouble::kOverTemperature},
      {hid::kStatusOverCurrent, Trouble::kOverCurrent},
      {hid::kStatusEncoderFault, Trouble::kEncoder},
      {hid::kStatusSaturated, Trouble::kNone},
      {hid::kStatusCommandRejected, Trouble::kNone},
      {hid::kStatusReportOverrun, Trouble::kNone}};
  for (const auto& [bit, trouble] : kBits) {
    state.status = bit;
    EXPECT_EQ(fault_in(state), trouble);
  }
  // The first fault is reported.
  state.status = hid::kStatusWatchdog | hid::kStatusEmergencyStop;
  state.fault = hid::kFaultWatchdog;
  EXPECT_EQ(fault_in(state), Trouble::kWatchdog);
}

TEST_F(LinkState, AFaultDoesNotEndTheLink) {
  ASSERT_TRUE(take());
  step();
  state.status |= hid::kStatusEmergencyStop;
  ASSERT_TRUE(take());
  EXPECT_EQ(tracker.view().trouble, Trouble::kEmergencyStop);
  EXPECT_EQ(tracker.ended(), Trouble::kNone);
  step();
  state.status = hid::kStatusCalibrated;
  ASSERT_TRUE(take());
  EXPECT_EQ(tracker.view().trouble, Trouble::kNone);
}

TEST_F(LinkState, RejectedCommandsAreThoseOfTheLinkAndWrap) {
  state.rejected_commands = 65535;  // of an earlier host
  ASSERT_TRUE(take());
  EXPECT_EQ(stats().rejected_commands, 0U);
  step();
  state.rejected_commands = 1;
  ASSERT_TRUE(take());
  EXPECT_EQ(stats().rejected_commands, 2U);
}

// State 101 is latched at 1 001 000 us; its command arrives 400 us later and acts at the next tick.
TEST_F(LinkState, RoundTripAndDelayAreByTheDevicesClock) {
  ASSERT_TRUE(take());
  sent->note(1, 1'001'000);
  step();
  ASSERT_TRUE(take());
  EXPECT_EQ(stats().delay_s, 0.0);
  step();
  state.acknowledged_sequence = 1;
  state.acknowledged_time_us = 1'001'400;
  ASSERT_TRUE(take());
  EXPECT_DOUBLE_EQ(stats().round_trip_s, 400e-6);
  EXPECT_DOUBLE_EQ(stats().delay_s, 1e-3);
  step();
  ASSERT_TRUE(take());  // a repetition is no new measurement
  sent->note(2, 1'003'000);
  step(2);
  state.acknowledged_sequence = 2;
  state.acknowledged_time_us = 1'003'900;
  ASSERT_TRUE(take());
  EXPECT_DOUBLE_EQ(stats().round_trip_s, 900e-6);
  EXPECT_DOUBLE_EQ(stats().maximum_round_trip_s, 900e-6);
  EXPECT_DOUBLE_EQ(stats().delay_s, 1e-3);  // the state of the tick at which it acted is missing
}

TEST_F(LinkState, CommandsOfAnotherSessionTellNoDelay) {
  state.acknowledged_sequence = 1;
  state.acknowledged_time_us = 900'000;
  ASSERT_TRUE(take());
  sent->note(1, 1'000'000);
  sent->note(2, 1'000'000);
  step();
  state.acknowledged_sequence = 2;  // of the previous session, before this link
  state.acknowledged_time_us = 999'999;
  ASSERT_TRUE(take());
  step();
  state.acknowledged_sequence = 77;  // never sent
  state.acknowledged_time_us = 1'001'500;
  ASSERT_TRUE(take());
  EXPECT_EQ(stats().round_trip_s, 0.0);
  step();
  state.acknowledged_sequence = 1;  // ours, at last
  state.acknowledged_time_us = 1'002'500;
  ASSERT_TRUE(take());
  EXPECT_DOUBLE_EQ(stats().round_trip_s, 2.5e-3);
}

TEST_F(LinkState, CountersGoOnOverLinksAndMeasurementsBeginAnew) {
  ASSERT_TRUE(take());
  sent->note(1, 1'000'000);
  step(3);
  state.acknowledged_sequence = 1;
  state.acknowledged_time_us = 1'000'700;
  ASSERT_TRUE(take());
  session.number = 2;
  session.sent = std::make_shared<SentCommands>();
  tracker.begin(session);
  EXPECT_EQ(tracker.view().session, 1U);  // stays 1 until the first state
  step(1000);
  state.time_us = 17;  // another life
  ASSERT_TRUE(take());
  EXPECT_EQ(tracker.view().session, 2U);
  EXPECT_EQ(tracker.view().device_time_us, 17);
  EXPECT_EQ(stats().states, 3U);
  EXPECT_EQ(stats().missing_states, 2U);
  EXPECT_EQ(stats().round_trip_s, 0.0);
  EXPECT_DOUBLE_EQ(stats().maximum_round_trip_s, 700e-6);
}

}  // namespace
}  // namespace hapticwall::device
