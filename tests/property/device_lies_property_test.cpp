// A device that lies by a random script, on the whole link and the loop of a session: the force at
// the device stays within limit and ramp, it is zero while disarmed, and every disarming has a
// reason.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/app/runtime/loop/lie_rig.h"

namespace hapticwall::runtime::test {
namespace {

using device::hid::Fault;
using device::hid::FaultKind;

constexpr std::uint64_t kLieRunMs = 1400;
// A late command acts while its echo and its time to live hold, 20 ms each, and a tick for both
// clocks.
constexpr std::uint64_t kMaxGoneUs = 42'000;

device::hid::FaultScript random_lies() {
  std::vector<Fault> faults(*rc::gen::inRange<std::size_t>(0, 5));
  for (Fault& fault : faults) {
    // A lie more often than a classic fault.
    const bool lies = *rc::gen::inRange(0, 4) != 0;
    fault.kind = static_cast<FaultKind>(*rc::gen::inRange(
        lies ? static_cast<int>(FaultKind::kJump) : 0, static_cast<int>(device::hid::kFaultKinds)));
    fault.begin_us = *rc::gen::inRange<std::uint64_t>(300'000, 1'200'000);
    fault.duration_us = *rc::gen::inRange<std::uint64_t>(0, 200'000);
    fault.every = *rc::gen::inRange<std::uint32_t>(1, 5);
    // An amplifier that gives more than it is commanded is beyond any host.
    const double most = fault.kind == FaultKind::kOtherForce ? 1.0 : 2.0;
    if (*rc::gen::arbitrary<bool>()) {
      fault.amount =
          most * device::hid::usual_amount(fault.kind) * *rc::gen::inRange(0, 1000) / 1e3;
    }
  }
  return device::hid::FaultScript(faults);
}

RC_GTEST_PROP(DeviceLiesProperty, NoScriptPushesWhileDisarmedOrDisarmsInSilence, ()) {
  LieRig rig(random_lies(), *rc::gen::arbitrary<bool>());
  rig.tick();
  ArmingStatus before = rig.arming();
  double max_gain = 0.0;
  std::uint64_t off_since_us = 0;
  int disarmings = 0;
  rig.on_tick = [&] {
    const ArmingStatus now = rig.arming();
    const bool off = now.state == ArmingState::kOff;
    const bool was_off = before.state == ArmingState::kOff;
    if (off && !was_off) {
      ++disarmings;
      off_since_us = rig.now_us();
      max_gain = 0.0;
      RC_ASSERT(now.note != ArmingNote::kNone);
      RC_ASSERT(now.note != ArmingNote::kAsked);
      RC_ASSERT(!arming_note_text(now.note).empty());
    }
    if (off && now.asked != before.asked) RC_ASSERT(now.note != ArmingNote::kNone);
    const double force_n = std::abs(rig.rig.force_n());
    RC_ASSERT(force_n <= device::hid::testing::kLimitN);
    if (off && rig.now_us() - off_since_us > kMaxGoneUs) RC_ASSERT(force_n == 0.0);
    if (!off) {
      max_gain = std::max(max_gain, now.gain);
      const bool fresh = rig.now_us() - off_since_us > kMaxGoneUs;
      if (fresh) RC_ASSERT(force_n <= max_gain * device::hid::testing::kLimitN + 1e-3);
    }
    before = now;
  };
  while (rig.now_us() < 1000 * kLieRunMs) {
    if (rig.now_us() % 100'000 < 1000 || *rc::gen::inRange(0, 40) == 0) rig.arm();
    for (int i = 0; i < 10; ++i) rig.tick();
  }
  RC_CLASSIFY(disarmings == 0, "never disarmed");
  RC_CLASSIFY(disarmings > 1, "disarmed again");
}

}  // namespace
}  // namespace hapticwall::runtime::test
