// Every fault of device, bus and host in virtual time: the force ends within the promised time, the
// message is right, and the force returns only on a new request.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/device/link/link_rig.h"

namespace hapticwall::device {
namespace {

using hid::FaultKind;
using testing::kMillisecondUs;
using testing::Rig;
using testing::VirtualHost;

constexpr std::uint64_t kBeginMs = 300;
constexpr std::uint64_t kBeginUs = kBeginMs * kMillisecondUs;
constexpr std::uint64_t kDurationMs = 1000;

// Time limits of the mechanisms that end the force, plus one tick of the device and one for a
// command in flight.
constexpr std::uint64_t kAtOnce = 0;                        // the device itself
constexpr std::uint64_t kBusLoss = 3 * kMillisecondUs;      // no start of frame
constexpr std::uint64_t kTimeToLive = 20 * kMillisecondUs;  // of the last command
constexpr std::uint64_t kLinkLost = 22 * kMillisecondUs;    // 20 ms of silence, a tick of the loop
constexpr std::uint64_t kWatchdog = 50 * kMillisecondUs;    // of the device's hardware
constexpr std::uint64_t kTick = 2 * kMillisecondUs;

struct Promise {
  FaultKind kind;
  std::uint64_t within_us;
  Trouble trouble;
};
constexpr Promise kPromises[] = {
    {FaultKind::kEmpty, kLinkLost, Trouble::kSilent},
    {FaultKind::kShort, kLinkLost, Trouble::kVoid},
    {FaultKind::kOverLong, kLinkLost, Trouble::kVoid},
    {FaultKind::kWrongId, kLinkLost, Trouble::kVoid},
    {FaultKind::kWrongMajor, kLinkLost, Trouble::kVoid},
    {FaultKind::kBadCrc, kLinkLost, Trouble::kVoid},
    {FaultKind::kAllZero, kLinkLost, Trouble::kVoid},
    {FaultKind::kSkipped, kLinkLost, Trouble::kSilent},
    {FaultKind::kRepeated, kLinkLost, Trouble::kSilent},
    {FaultKind::kSilent, kLinkLost, Trouble::kSilent},
    {FaultKind::kNotPolled, kLinkLost, Trouble::kSilent},
    {FaultKind::kNoOutput, kTimeToLive, Trouble::kWatchdog},
    {FaultKind::kUnplugged, kBusLoss, Trouble::kUnplugged},
    {FaultKind::kFrozen, kWatchdog, Trouble::kSilent},
    {FaultKind::kRestart, kAtOnce, Trouble::kUnplugged},
    {FaultKind::kEmergencyStop, kAtOnce, Trouble::kEmergencyStop},
    {FaultKind::kOverTemperature, kAtOnce, Trouble::kOverTemperature},
    {FaultKind::kOverCurrent, kAtOnce, Trouble::kOverCurrent},
    {FaultKind::kEncoderFault, kAtOnce, Trouble::kEncoder},
};

struct Case {
  Promise promise;
  bool disarms;

  [[nodiscard]] std::string name() const {
    return "Kind" + std::to_string(static_cast<int>(promise.kind)) +
           (disarms ? "AndALoopThatDisarms" : "AndALoopThatGoesOnAsking");
  }
};
std::ostream& operator<<(std::ostream& out, const Case& tested) { return out << tested.name(); }

class LinkFault : public ::testing::TestWithParam<Case> {};

TEST_P(LinkFault, TakesTheForceAwayInTimeAndForGood) {
  const auto [promise, disarms] = GetParam();
  Rig rig({{promise.kind, kBeginUs, kDurationMs * kMillisecondUs}});
  VirtualHost& host = rig.host;
  host.behaviour.disarms = disarms;
  rig.drive_until_ms(kBeginMs - 1);

  // Longer than the fault, the longest back-off and a blocked write's last chance.
  rig.tick_until_ms(kBeginMs + kDurationMs + 2500);
  EXPECT_LE(rig.last_force_us, kBeginUs + promise.within_us + kTick);
  // It does not end much earlier: this tests the promised time, not another one.
  EXPECT_GE(rig.last_force_us + 4 * kMillisecondUs, kBeginUs + promise.within_us);
  EXPECT_TRUE(rig.saw(promise.trouble));

  // Everything recovers except the force; a host that keeps asking keeps its fault.
  EXPECT_EQ(rig.force_n(), 0.0);
  if (disarms) {
    EXPECT_EQ(host.stats().trouble, Trouble::kNone) << trouble_text(host.stats().trouble);
  }
  host.rearm();
  host.ticks(20);
  if (!disarms) {
    host.rearm();  // the first time cleared the fault
    host.ticks(20);
  }
  EXPECT_TRUE(rig.pushes()) << trouble_text(host.stats().trouble);
  EXPECT_EQ(host.owner.words(), "");
  EXPECT_EQ(host.port->never_listed, 0);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Promise& promise : kPromises) {
    all.push_back({promise, true});
    all.push_back({promise, false});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Matrix, LinkFault, ::testing::ValuesIn(cases()),
                         [](const auto& tested) { return tested.param.name(); });

}  // namespace
}  // namespace hapticwall::device
