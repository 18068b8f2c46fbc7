// A device that is wrong but well-formed, in virtual time: 61 lies in five states of the loop. Each
// has its force at the device after the lie, the time until it is zero, the way that the handle is
// pushed, and the reason that the person reads.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <ostream>
#include <string>
#include <string_view>

#include "tests/app/session/loop/lie_rig.h"
#include "tests/emulator/program/emulator_options.h"

namespace hapticwall::session::test {
namespace {

constexpr std::uint64_t kArmMs = 50;
constexpr std::uint64_t kRampMs = 300;   // the force rises, in free space
constexpr std::uint64_t kWeakMs = 1000;  // in contact, before the handle has obeyed
constexpr std::uint64_t kBeginMs = 3000;
constexpr std::uint64_t kForMs = 1100;
constexpr double kRippleN = 0.5;  // force of one count in the wall
const double kUntriedN = device::DeviceInfo{}.untried_share * device::hid::testing::kLimitN;

constexpr ArmingNote kNone = ArmingNote::kNone;
constexpr ArmingNote kImplausible = ArmingNote::kImplausible;
constexpr ArmingNote kAcceleration = ArmingNote::kAcceleration;
constexpr ArmingNote kSlowerAnswer = ArmingNote::kSlowerAnswer;
constexpr ArmingNote kClockRate = ArmingNote::kClockRate;
constexpr ArmingNote kUnaskedForce = ArmingNote::kUnaskedForce;

struct Lie {
  std::string_view kind;
  double duration_s;
  // The note after it while armed, free and in contact; kNone: it does no harm and is no objection.
  ArmingNote free;
  ArmingNote in_contact;
  // The note of a request to arm 100 ms after its begin, with the handle outside the wall.
  ArmingNote refused;
  // The force at the device has gone after this time.
  std::uint64_t within_ms = 1;
  // The note while the force is off.
  ArmingNote disarmed = ArmingNote::kNone;
};

constexpr double kShort = 0.001;  // one report
constexpr double kLong = 0.4;

const Lie kLies[] = {
    // Rule 1: plausible motion.
    {"jump=1.5", kShort, kImplausible, kImplausible, kNone},
    {"jump=-1.5", kShort, kImplausible, kImplausible, kNone},
    {"jump=1.5", kLong, kImplausible, kImplausible, kImplausible},
    {"jump=-1.5", kLong, kImplausible, kImplausible, kImplausible},
    {"jump=0.9", kShort, kImplausible, kImplausible, kNone},
    {"jump=0.05", kShort, kImplausible, kImplausible, kNone},
    {"jump=0.05", kLong, kImplausible, kImplausible, ArmingNote::kInsideWall},
    {"jump=-0.05", kShort, kImplausible, kImplausible, kNone},
    {"jump=0.3", kLong, kImplausible, kImplausible, kImplausible},
    {"jump=0.012", kShort, kImplausible, kImplausible, kNone},
    {"jump=-0.012", kLong, kImplausible, kImplausible, kNone},
    {"jump=1e6", kLong, kImplausible, kImplausible, kImplausible},
    {"runaway=12", kLong, kImplausible, kImplausible, kImplausible, 2},
    {"runaway=-12", kLong, kImplausible, kImplausible, kImplausible, 2},
    {"runaway=500", kLong, kImplausible, kImplausible, kImplausible, 2},
    {"jump=0.009", kShort, kImplausible, kImplausible, kNone},
    {"jump=0.0045", kShort, kImplausible, kImplausible, kNone},
    // With counts of 0.25 mm, a speed of 2 m/s may begin within a tick. The force is weak as long
    // as the handle has not obeyed; the full force is gone after 16 ms.
    {"runaway=2", kLong, kImplausible, ArmingNote::kGivesWay, ArmingNote::kInsideWall, 137},
    {"runaway=-2", kLong, kImplausible, kImplausible, kNone, 3},
    {"noise", kLong, kAcceleration, kAcceleration, kNone, 60},
    {"noise=0.003", kLong, kImplausible, kImplausible, kAcceleration, 9},
    {"noise=0.000254", kLong, kNone, kNone, kNone},
    // Rule 2: delay.
    {"slow", kLong, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, ArmingNote::kSlowAnswer, 21},
    {"slow=0.03", kLong, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, ArmingNote::kSlowAnswer, 21},
    {"slow=0.045", kLong, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, ArmingNote::kSlowAnswer,
     21},
    {"slow=0.022", kLong, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, ArmingNote::kSlowAnswer,
     21},
    {"slow=0.018", kLong, kSlowerAnswer, kSlowerAnswer, ArmingNote::kSlowDevice, 41},
    {"slow=0.01", kLong, kSlowerAnswer, kSlowerAnswer, ArmingNote::kSlowDevice, 25},
    {"slow=0.005", kLong, kSlowerAnswer, kSlowerAnswer, kNone, 25},
    {"slow=0.002", kLong, kNone, kNone, kNone},
    {"withheld-answer", kLong, ArmingNote::kSlowAnswer, ArmingNote::kSlowAnswer,
     ArmingNote::kSlowAnswer},
    {"withheld-answer=150", kLong, ArmingNote::kSlowAnswer, ArmingNote::kSlowAnswer,
     ArmingNote::kSlowAnswer},
    // Rule 3: what was taken away stays away.
    {"no-answer", kLong, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, 21},
    {"no-answer", 0.03, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, kNone, 21},
    {"no-answer", 0.022, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, kNone, 21},
    {"no-answer", 0.01, kNone, kNone, kNone},
    {"no-output", 0.045, ArmingNote::kNoAnswer, ArmingNote::kNoAnswer, kNone, 21},
    {"no-output", 0.01, kNone, kNone, kNone},
    {"not-enabled", kShort, ArmingNote::kNotEnabled, ArmingNote::kNotEnabled, kNone},
    {"not-enabled", 0.01, ArmingNote::kNotEnabled, ArmingNote::kNotEnabled, kNone},
    {"not-enabled", kLong, ArmingNote::kNotEnabled, ArmingNote::kNotEnabled, kNone},
    {"no-force", kShort, kNone, ArmingNote::kNoForce, kNone},
    {"no-force", kLong, kNone, ArmingNote::kNoForce, kNone},
    // Rule 4: the device's word is compared.
    {"rejects", kShort, ArmingNote::kRejected, ArmingNote::kRejected, kNone, 2},
    {"rejects", 0.005, ArmingNote::kRejected, ArmingNote::kRejected, kNone, 5},
    {"rejects", kLong, ArmingNote::kRejected, ArmingNote::kRejected, ArmingNote::kRejected, 21},
    {"other-force", kLong, kNone, ArmingNote::kOtherForce, kNone, 5},
    {"other-force=1.1", kLong, kNone, ArmingNote::kOtherForce, kNone, 5},
    {"other-force=-1", kLong, kNone, ArmingNote::kOtherForce, kNone, 5},
    {"other-force=0.5", 0.003, kNone, kNone, kNone},
    {"foreign-force", 0.01, ArmingNote::kOtherForce, ArmingNote::kOtherForce, kNone, 5,
     kUnaskedForce},
    {"foreign-force", kLong, ArmingNote::kOtherForce, ArmingNote::kOtherForce, kUnaskedForce, 5,
     kUnaskedForce},
    {"foreign-force=-0.5", kLong, ArmingNote::kOtherForce, ArmingNote::kOtherForce, kUnaskedForce,
     5, kUnaskedForce},
    // Rule 5: the clock of the device.
    {"clock-rate", kLong, kClockRate, kClockRate, kClockRate, 200},
    {"clock-rate=1.1", kLong, kClockRate, kClockRate, kNone, 200},
    {"clock-rate=0.9", kLong, kClockRate, kClockRate, kNone, 200},
    {"clock-rate=1.03", kLong, kNone, kNone, kNone},
    {"clock-jump", kLong, ArmingNote::kClockJump, ArmingNote::kClockJump, kNone},
    {"clock-jump=0.5", kLong, ArmingNote::kClockJump, ArmingNote::kClockJump, kNone},
    // Rule 6: the handle obeys.
    {"wrong-sign", kLong, kNone, ArmingNote::kGivesWay, kNone, 300},
    {"no-push", kLong, kNone, kNone, kNone},
};

device::hid::FaultScript script_of(const Lie& lie, double begin_s = 1e-3 * kBeginMs) {
  const std::string text =
      std::string(lie.kind) + "@" + std::to_string(begin_s) + "+" + std::to_string(lie.duration_s);
  const auto fault = emulator::parse_fault(text);
  EXPECT_TRUE(fault.ok()) << text;
  return fault ? device::hid::FaultScript{*fault} : device::hid::FaultScript{};
}

std::ostream& operator<<(std::ostream& out, const Lie& lie) {
  return out << lie.kind << " for " << lie.duration_s << " s";
}

class DeviceLie : public ::testing::TestWithParam<Lie> {};

// The lie takes the force away in time, and for good.
void expect_taken_away(LieRig& rig, const Lie& lie, ArmingNote note, std::uint64_t begin_us,
                       std::uint64_t until_ms) {
  rig.until_ms(until_ms);
  EXPECT_EQ(arming_note_text(rig.arming().note), arming_note_text(note));
  if (note == kNone) {
    EXPECT_NE(rig.arming().state, ArmingState::kOff);
    return;
  }
  EXPECT_EQ(rig.arming().state, ArmingState::kOff);
  EXPECT_EQ(rig.arming().gain, 0.0);
  const std::uint64_t gone_us = rig.last_force_us < begin_us ? 0 : rig.last_force_us - begin_us;
  EXPECT_LE(gone_us, 1000 * lie.within_ms);
}

// The force rises where the amplifier gives more, and with a handle that moves into the wall.
double allowed_peak_n(const Lie& lie, double before_n) {
  constexpr std::string_view kMovesIn[] = {"wrong-sign", "no-push", "runaway=2"};
  if (std::ranges::find(kMovesIn, lie.kind) != std::end(kMovesIn))
    return before_n > 0.0 ? device::hid::testing::kLimitN : kUntriedN;
  const double gain = lie.kind.starts_with("other-force=1.1") ? 1.1 : 1.0;
  return gain * before_n + (lie.kind.starts_with("noise") ? 2.0 : 1.0) * kRippleN;
}

void expect_armed(const Lie& lie, bool in_contact) {
  LieRig rig(script_of(lie), in_contact);
  rig.until_ms(kArmMs);
  rig.arm();
  rig.until_ms(kBeginMs - 100);
  ASSERT_EQ(rig.arming().state, ArmingState::kOn);
  ASSERT_EQ(rig.arming().limit_share < 1.0, !in_contact);
  rig.peak_n = 0.0;
  rig.until_ms(kBeginMs - 1);
  const double before_n = rig.peak_n;
  if (in_contact) EXPECT_GT(before_n, 3.0);
  if (!in_contact) EXPECT_EQ(before_n, 0.0);
  rig.peak_n = 0.0;
  expect_taken_away(rig, lie, in_contact ? lie.in_contact : lie.free, rig.now_us() + 1000,
                    kBeginMs + kForMs);
  EXPECT_LE(rig.peak_n, allowed_peak_n(lie, before_n));
}

TEST_P(DeviceLie, TakesTheForceAwayInTimeAndForGood) {
  for (const bool in_contact : {false, true}) {
    SCOPED_TRACE(in_contact ? "in contact" : "free");
    expect_armed(GetParam(), in_contact);
  }
}

TEST_P(DeviceLie, TakesAForceAwayThatStillRises) {
  LieRig rig(script_of(GetParam(), 1e-3 * kRampMs), false);
  rig.until_ms(kArmMs);
  rig.arm();
  rig.until_ms(kRampMs - 1);
  ASSERT_EQ(rig.arming().state, ArmingState::kRamping);
  expect_taken_away(rig, GetParam(), GetParam().free, rig.now_us() + 1000, kRampMs + kForMs);
  EXPECT_LE(rig.peak_n, allowed_peak_n(GetParam(), 0.0));
}

// The handle has not obeyed since the last arming: whatever the device says, its force is weak.
TEST_P(DeviceLie, PushesWeaklyBeforeTheHandleHasObeyed) {
  const Lie& lie = GetParam();
  LieRig rig(script_of(lie, 1e-3 * kWeakMs), true);
  rig.until_ms(kArmMs);
  rig.arm();
  rig.until_ms(kWeakMs - 1);
  ASSERT_LT(rig.arming().limit_share, 1.0);
  rig.until_ms(kWeakMs + static_cast<std::uint64_t>(1000 * lie.duration_s));
  const double gain = lie.kind.starts_with("other-force=1.1") ? 1.1 : 1.0;
  EXPECT_LE(rig.peak_n, gain * kUntriedN + 1e-3);
  const bool off = rig.arming().state == ArmingState::kOff;
  EXPECT_EQ(off, rig.arming().note != kNone);
  if (lie.free != kNone) EXPECT_EQ(arming_note_text(rig.arming().note), arming_note_text(lie.free));
}

TEST_P(DeviceLie, GivesNoForceWhileDisarmed) {
  for (const bool in_contact : {false, true}) {
    LieRig rig(script_of(GetParam()), in_contact);
    rig.until_ms(kBeginMs + kForMs);
    EXPECT_EQ(rig.peak_n, 0.0);
    EXPECT_EQ(rig.arming().state, ArmingState::kOff);
    EXPECT_EQ(arming_note_text(rig.arming().note), arming_note_text(GetParam().disarmed));
  }
}

TEST_P(DeviceLie, RefusesToArmWhileItLasts) {
  const Lie& lie = GetParam();
  LieRig rig(script_of(lie), false);
  rig.until_ms(kBeginMs + 100);
  rig.arm();
  rig.tick();
  EXPECT_EQ(arming_note_text(rig.arming().note), arming_note_text(lie.refused));
  EXPECT_EQ(rig.arming().state, lie.refused == kNone ? ArmingState::kRamping : ArmingState::kOff);
  EXPECT_EQ(rig.arming().asked, 1U);
  // A lie about a force shows when there is one; a change shows when it happens.
  rig.until_ms(kBeginMs + 250);
  const bool is_change =
      lie.free == kImplausible || lie.free == kSlowerAnswer || lie.free == ArmingNote::kClockJump;
  if (lie.refused == kNone && lie.duration_s > 0.2 && !is_change) {
    EXPECT_EQ(arming_note_text(rig.arming().note), arming_note_text(lie.free));
  }
}

TEST_P(DeviceLie, IsForgottenWhenItIsOverAndThePersonArms) {
  const Lie& lie = GetParam();
  LieRig rig(script_of(lie), false);
  rig.until_ms(kArmMs);
  rig.arm();
  rig.until_ms(kBeginMs + kForMs);
  rig.arm();
  rig.until_ms(kBeginMs + kForMs + 700);
  EXPECT_EQ(rig.arming().state, ArmingState::kOn);
  EXPECT_EQ(rig.arming().note, kNone);
}

// Swapped leads of a motor: found while the force is weak.
TEST(SwappedLeads, AreFoundByAWeakForce) {
  LieRig rig(device::hid::FaultScript{{device::hid::FaultKind::kWrongSign, 0, 60'000'000}}, true);
  rig.until_ms(kArmMs);
  rig.arm();
  rig.until_ms(kBeginMs);
  EXPECT_EQ(arming_note_text(rig.arming().note), arming_note_text(ArmingNote::kWrongWay));
  EXPECT_LE(rig.peak_n, kUntriedN + 1e-3);
  EXPECT_LE(rig.last_force_us, 2'500'000U);
  RecordProperty("last_force_us", static_cast<int>(rig.last_force_us));
  RecordProperty("peak_mn", static_cast<int>(1e3 * rig.peak_n));
  const double deepest_m = rig.rig.plug.device.truth(0).position_m;
  EXPECT_LE(deepest_m, 0.07 + 0.005);  // 20 mm of the hand, 3.6 mm of the weak force
}

INSTANTIATE_TEST_SUITE_P(Table, DeviceLie, ::testing::ValuesIn(kLies));

}  // namespace
}  // namespace hapticwall::session::test
