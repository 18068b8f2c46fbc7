// A device that lies by a random script, on the whole link and the loop of a session: the force
// stays within limit, rate and ramp, it is zero while disarmed, and every disarming has a reason.
// So it is while a blind trial switches its walls.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>

#include "core/environment/environment.h"
#include "tests/app/session/loop/lie_rig.h"

namespace hapticwall::session::test {
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

// 0: at any rate; else the force needs 9 ms to 9 s from zero to its limit.
double random_force_rate() {
  return *rc::gen::arbitrary<bool>() ? *rc::gen::inRange(1, 1000) : 0.0;
}

device::ImpulseEngineOptions rising_at(double force_rate_n_per_s) {
  device::AxisDescription axis;
  axis.force_limit_n = device::hid::testing::kLimitN;
  axis.max_force_rate_n_per_s = force_rate_n_per_s;
  device::ImpulseEngineOptions options;
  options.axes[0] = axis;
  return options;
}

// Promises that hold at every tick.
class Promises {
 public:
  Promises(LieRig& rig, double force_rate_n_per_s)
      : rig_(rig),
        max_rise_n_(force_rate_n_per_s > 0.0 ? 1e-3 * force_rate_n_per_s : kLimitN),
        before_(rig.arming()) {}

  void check() {
    const Snapshot now = rig_.snapshot();
    off_ = now.arming.state == ArmingState::kOff;
    const bool disarmed = off_ && before_.state != ArmingState::kOff;
    if (disarmed) check_disarming(now.arming.note);
    // A wall over the handle: zero follows the command of this tick, which the sample has.
    const bool replaced = disarmed && now.arming.note == ArmingNote::kWallMoved;
    if (off_ && now.arming.asked != before_.asked) RC_ASSERT(now.arming.note != ArmingNote::kNone);
    if (!off_) max_gain_ = std::max(max_gain_, now.arming.gain);
    before_ = now.arming;
    check_commanded(replaced ? 0.0 : now.newest.x().force_n);
    check_applied(std::abs(rig_.rig.force_n()));
  }
  [[nodiscard]] int disarmings() const { return disarmings_; }

 private:
  static constexpr double kLimitN = device::hid::testing::kLimitN;
  static constexpr double kRoundingN = 2e-3;  // of a command and of a report, 1 mN each

  void check_disarming(ArmingNote why) {
    ++disarmings_;
    off_since_us_ = rig_.now_us();
    max_gain_ = 0.0;
    RC_ASSERT(why != ArmingNote::kNone);
    RC_ASSERT(why != ArmingNote::kAsked);
    RC_ASSERT(!arming_note_text(why).empty());
  }
  void check_commanded(double force_n) {
    RC_ASSERT(std::abs(force_n) <= kLimitN);
    if (off_) RC_ASSERT(force_n == 0.0);
    const double from_n = force_n * commanded_n_ > 0.0 ? std::abs(commanded_n_) : 0.0;
    RC_ASSERT(std::abs(force_n) <= from_n + max_rise_n_ + 1e-12);
    commanded_n_ = force_n;
    recent_n_.at(rig_.now_us() / 1000 % recent_n_.size()) = std::abs(force_n);
  }
  void check_applied(double force_n) {
    RC_ASSERT(force_n <= kLimitN);
    RC_ASSERT(force_n <= std::ranges::max(recent_n_) + kRoundingN);
    if (rig_.now_us() - off_since_us_ <= kMaxGoneUs) return;
    if (off_) RC_ASSERT(force_n == 0.0);
    if (!off_) RC_ASSERT(force_n <= max_gain_ * kLimitN + kRoundingN);
  }

  LieRig& rig_;
  double max_rise_n_;  // per tick
  ArmingStatus before_;
  bool off_ = true;
  double max_gain_ = 0.0;
  double commanded_n_ = 0.0;
  std::array<double, kMaxGoneUs / 1000> recent_n_{};  // commanded forces: a late one still acts
  std::uint64_t off_since_us_ = 0;
  int disarmings_ = 0;
};

// Two walls of a blind trial: the stiffer one is unstable, the nearer one may be over the handle.
WallSettings random_wall() {
  return {kLieWallM - 1e-3 * *rc::gen::inRange(0, 8),
          kLieStiffness * *rc::gen::inRange(0, 50) / 10.0, 0.0};
}

// A wall of those, or another environment with the forces of its defaults.
struct Touched {
  WallSettings wall;
  std::size_t environment = 0;
};
Touched random_touched() {
  const bool is_wall = *rc::gen::arbitrary<bool>();
  return {random_wall(), is_wall ? 0 : *rc::gen::inRange<std::size_t>(1, environments().size())};
}

void run_script() {
  const double force_rate_n_per_s = random_force_rate();
  LieRig rig(random_lies(), *rc::gen::arbitrary<bool>(), rising_at(force_rate_n_per_s));
  rig.tick();
  Promises promises(rig, force_rate_n_per_s);
  rig.on_tick = [&] { promises.check(); };
  const bool switches = *rc::gen::arbitrary<bool>();
  const std::array all{random_touched(), random_touched()};
  while (rig.now_us() < 1000 * kLieRunMs) {
    if (rig.now_us() % 100'000 < 1000 || *rc::gen::inRange(0, 40) == 0) rig.arm();
    if (switches && *rc::gen::inRange(0, 5) == 0) {
      const Touched& next = all.at(*rc::gen::inRange<std::size_t>(0, all.size()));
      rig.change_touched(next.wall, next.environment);
    }
    for (int i = 0; i < 10; ++i) rig.tick();
  }
  RC_CLASSIFY(promises.disarmings() == 0, "never disarmed");
  RC_CLASSIFY(promises.disarmings() > 1, "disarmed again");
  const bool others = std::ranges::any_of(all, &Touched::environment);
  RC_CLASSIFY(switches && !others, "walls switch");
  RC_CLASSIFY(switches && others, "environments switch");
}

// 4000 scripts, or 40 times the max_success of RC_PARAMS.
TEST(DeviceLiesProperty, NoScriptPushesWhileDisarmedOrDisarmsInSilence) {
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess *= 40;
  const auto result = rc::detail::checkTestable(run_script, rc::detail::TestMetadata(), params);
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  EXPECT_TRUE(result.is<rc::detail::SuccessResult>()) << text.str();
}

}  // namespace
}  // namespace hapticwall::session::test
