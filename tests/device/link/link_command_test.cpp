#include "device/link/link_command.h"

#include <gtest/gtest.h>

#include <limits>

namespace hapticwall::device {
namespace {

constexpr std::int64_t kNowNs = 1'000'000'000;

LinkCommand pushing(double force_n) {
  LinkCommand command;
  command.made_ns = kNowNs;
  command.enable = true;
  command.force_n = {force_n, 0.0};
  command.limit_n = {5.0, 2.0};
  command.state_sequence = 321;
  return command;
}

TEST(LinkCommand, PushesTheOtherWayInAReport) {
  const hid::ForceReport report = force_report(pushing(1.5), 7, kNowNs);
  EXPECT_TRUE(report.enable);
  EXPECT_FALSE(report.clear_faults);
  EXPECT_EQ(report.sequence, 7);
  EXPECT_EQ(report.echoed_state_sequence, 321);
  EXPECT_EQ(report.time_to_live_ms, 20);
  EXPECT_EQ(report.force_n[0], -1.5);
  EXPECT_EQ(report.force_n[1], 0.0);
}

TEST(LinkCommand, WithoutEnableThereIsNoForce) {
  LinkCommand command = pushing(1.5);
  command.enable = false;
  const hid::ForceReport report = force_report(command, 7, kNowNs);
  EXPECT_FALSE(report.enable);
  EXPECT_EQ(report.force_n, (AxisValues{0.0, 0.0}));
}

TEST(LinkCommand, KeepsToTheLimitWhateverItIs) {
  LinkCommand command = pushing(-100.0);
  command.force_n[1] = 100.0;
  EXPECT_EQ(force_report(command, 1, kNowNs).force_n, (AxisValues{5.0, -2.0}));
  command.limit_n = {-3.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(force_report(command, 1, kNowNs).force_n, (AxisValues{0.0, 0.0}));
}

TEST(LinkCommand, AForceThatIsNoNumberOnEitherAxisTakesEnableAway) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    LinkCommand command = pushing(bad);
    EXPECT_FALSE(force_report(command, 1, kNowNs).enable);
    EXPECT_EQ(force_report(command, 1, kNowNs).force_n[0], 0.0);
    command.force_n = {1.0, bad};
    EXPECT_FALSE(force_report(command, 1, kNowNs).enable);
    EXPECT_EQ(force_report(command, 1, kNowNs).force_n[0], 0.0);
  }
}

TEST(LinkCommand, AnOldForceIsNoForce) {
  EXPECT_TRUE(force_report(pushing(1.0), 1, kNowNs + kLinkLostNs).enable);
  EXPECT_FALSE(force_report(pushing(1.0), 1, kNowNs + kLinkLostNs + 1).enable);
}

TEST(LinkCommand, ClearingAndEnablingAreNeverOne) {
  LinkCommand command = pushing(1.0);
  command.clear_faults = true;
  const hid::ForceReport report = force_report(command, 1, kNowNs);
  EXPECT_FALSE(report.enable);
  EXPECT_TRUE(report.clear_faults);
  EXPECT_EQ(report.force_n[0], 0.0);
}

TEST(SentCommands, KnowsWhatWasSentAndForgetsWhatIsLongAgo) {
  SentCommands sent;
  EXPECT_FALSE(sent.latch_us(0));
  EXPECT_FALSE(sent.latch_us(1));
  sent.note(1, 0);
  EXPECT_EQ(sent.latch_us(1), 0U);
  EXPECT_FALSE(sent.latch_us(0));
  EXPECT_FALSE(sent.latch_us(257));
  sent.note(257, 0xFFFFFFFFU);
  EXPECT_EQ(sent.latch_us(257), 0xFFFFFFFFU);
  EXPECT_FALSE(sent.latch_us(1));
  sent.note(0, 5);  // after a wrap
  EXPECT_EQ(sent.latch_us(0), 5U);
}

}  // namespace
}  // namespace hapticwall::device
