// A session's life without a thread: the loop's real body on a clock that obeys and a device that
// fails in every way, with somebody at the controls who does whatever comes to mind. Every command
// that reaches the device is judged by what is promised, and by nothing of how it is kept.
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "app/session/loop/loop_driver.h"
#include "app/session/plant_keeper.h"
#include "tests/app/session/support.h"
#include "tests/property/extremes_scene.h"
#include "tests/property/safe_force_devices.h"
#include "tests/property/scene_generator.h"

namespace hapticwall::testing {

using session::ArmingState;
using session::CommandKind;

inline constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kEndless = std::numeric_limits<double>::infinity();
inline constexpr double kBlendRounding = 1e-6;  // for a blend: its forces may be 1e8 times its end

// Random change of a scene while it runs. Valid or not: the owner's side refuses an invalid one.
inline Scene changed_somehow(Draw& draw, Scene scene) {
  constexpr double kWallM = 0.05;
  if (draw.chance(0.4)) scene.algorithm.index = draw.index(algorithms().size());
  if (draw.chance(0.1)) draw_algorithm(draw, scene.algorithm);
  if (draw.chance(0.4)) {
    scene.x().walls.clear();
    for (std::size_t i = draw.index(3); i < 3; ++i) {
      scene.x().walls.push_back({.position_m = kWallM + draw.uniform(-3e-3, 3e-3),
                                 .stiffness_n_per_m = draw.zero_or(1.0, 1e6),
                                 .damping_n_s_per_m = draw.zero_or(1e-3, 1e3)});
    }
  }
  if (draw.chance(0.3)) scene.x().device.force_limit_n = draw.log_uniform(0.01, 100.0);
  if (draw.chance(0.2)) scene.x().device.mass_kg = draw.log_uniform(0.01, 1.0);
  if (draw.chance(0.2)) scene.x().device.damping_n_s_per_m = draw.log_uniform(0.01, 20.0);
  return scene;
}

// One life. `DeviceKind` is one of the two above.
template <typename DeviceKind>
class Life {
 public:
  Life(const Scene& first, std::uint64_t seed, DeviceKind& device, LifeTotals& totals)
      : scene_(first),
        draw_(seed),
        totals_(totals),
        device_(device),
        plants_(first),
        exchange_({.plot = 16, .recorder = 4096}, session::test::parameters_of(first)),
        loop_({&device}, exchange_, session::test::parameters_of(first), false),
        real_(!device.info().is_simulated) {
    settings_[1] = servo_settings(first);
  }

  void live(int cycles) {
    clock_.after_sleep = [this, cycles](session::test::FakeClock& clock) {
      judge();
      if (++cycle_ == cycles) exchange_.stop = true;
      act(clock);
    };
    session::run_servo_loop(loop_, exchange_, scene_.sampling.rate_hz, clock_);
    ++totals_.lives;
    totals_.cycles += static_cast<std::uint64_t>(cycle_);
    promise(device_.commands.closed, "the device is closed at the end");
    promise(device_.commands.newest_n == 0.0, "the last force is zero");
    if (real_) promise(!device_.commands.enabled, "disabled at the end");
    promise(exchange_.finished.load(), "the owner is told of the end");
    promise(newest().newest.x().force_n == 0.0, "the end is shown without force");
    const std::string& broken = device_.commands.broken.promise;
    RC_ASSERT(broken == std::string());
  }

 private:
  void promise(bool holds, const char* what) { device_.commands.broken.unless(holds, what); }
  session::Snapshot newest() {
    exchange_.snapshots.update();
    return exchange_.snapshots.current();
  }
  void command(CommandKind kind, std::uint32_t ticks = 0) {
    promise(exchange_.commands.try_push({kind, ticks}), "the command finds room");
  }

  // ---- what is promised, of the cycle that is over
  void judge() {
    const session::Snapshot now = newest();
    for (session::ParameterEcho echo; exchange_.echoes.try_pop(echo);) {
      plants_.came_into_force(echo.generation);
    }
    if (cycle_ > 0) judge_cycle(now);
    before_ = now;
    device_.commands.of_cycle_n.clear();
  }

  void judge_cycle(const session::Snapshot& now) {
    const bool ticked = now.timing.ticks > before_.timing.ticks;
    Tick tick;
    promise(exchange_.plot.try_pop(tick) == ticked, "one sample a tick");
    if (ticked) judge_tick(tick.x(), now);
    if (!real_) return;
    const bool trouble = bad_reading_ || hole_ || disarmed_ || !ticked;
    if (trouble) may_push_ = false;
    if (trouble && newest_before_n_ != 0.0) ++totals_.forces_taken_away;
    if (!may_push_) {
      promise(device_.commands.newest_n == 0.0, "no force while it is not allowed");
      promise(!device_.commands.enabled, "not enabled while it is not allowed");
      promise(now.arming.gain == 0.0 || asked_, "no gain while it is not allowed");
    }
    const double rise = kMaxRise / (session::kArmingRampS * scene_.sampling.rate_hz);
    promise(now.arming.gain <= before_.arming.gain + rise, "the gain rises evenly");
    // The hole was before somebody asked.
    if (asked_ && ticked && !bad_reading_ && !disarmed_) may_push_ = true;
    if (before_.arming.state == ArmingState::kOff && now.arming.state == ArmingState::kRamping) {
      ++totals_.armings;
    }
    newest_before_n_ = device_.commands.newest_n;
  }

  void judge_tick(const Sample& sample, const session::Snapshot& now) {
    const double gain = before_.arming.gain;  // max gain of this tick
    const ServoSettings& settings = settings_.at(sample.generation);
    const std::vector<double>& heard_n = device_.commands.of_cycle_n;
    promise(!heard_n.empty() && heard_n.front() == sample.force_n, "the sample tells the command");
    promise(std::abs(sample.force_n) <= gain * settings.force_limit_n,
            "within the limit and the ramp");
    const std::uint32_t untrusted = kFlagStaleInput | kFlagDeviceFault;
    if ((sample.flags & untrusted) != 0)
      promise(sample.force_n == 0.0, "zero on what is not to be trusted");
    if (real_ && bad_reading_)
      promise((sample.flags & untrusted) != 0, "what is not to be trusted is seen");
    if (sample.force_n != 0.0) ++totals_.ticks_with_force;
    if (sample.force_n != 0.0 && gain < 1.0) ++totals_.ticks_in_ramp_with_force;
    if ((sample.flags & kFlagForceLimit) != 0) ++totals_.ticks_at_limit;
    judge_change(sample, settings, gain, now);
    force_before_n_ = sample.force_n;
    gain_before_ = gain;
    in_force_ = settings;
  }

  // A change is no kick: the force begins where it was, as far as the new limit lets it.
  void judge_change(const Sample& sample, const ServoSettings& settings, double gain,
                    const session::Snapshot& now) {
    const std::uint32_t untrusted = kFlagStaleInput | kFlagDeviceFault;
    const bool changed = in_force_ && !(settings == *in_force_) && sample.tick > 0;
    const bool taken_away = (sample.flags & untrusted) != 0 || hole_ || disarmed_ ||
                            now.arming.note == session::ArmingNote::kForce;
    if (!changed || taken_away || force_before_n_ == 0.0 || gain_before_ == 0.0) return;
    const double full_n = force_before_n_ / gain_before_;
    const double limit_n = settings.force_limit_n;
    const double expected_n = gain * std::clamp(full_n, -limit_n, limit_n);
    promise(std::abs(sample.force_n - expected_n) <= kBlendRounding * std::max(1.0, limit_n),
            "no kick at a change");
    ++totals_.changes_under_force;
  }

  // ---- what somebody does, and what happens, before the next cycle
  void act(session::test::FakeClock& clock) {
    bad_reading_ = hole_ = disarmed_ = asked_ = false;
    if (draw_.chance(0.01)) late(clock);
    if (draw_.chance(0.01)) publish(changed_somehow(draw_, scene_));
    if (draw_.chance(0.02)) lead();
    command_something();
    if constexpr (std::is_same_v<DeviceKind, FaultyDevice>) move();
    if (draw_.chance(5e-5)) break_down();
  }

  void late(session::test::FakeClock& clock) {
    const double late_s = draw_.chance(0.1) ? draw_.log_uniform(0.0201, 10.0)  //
                                            : draw_.uniform(0.0, 0.0199);
    hole_ = late_s > kDefaultMaxAgeS;
    totals_.holes += hole_ ? 1 : 0;
    clock.advance_ns(static_cast<std::int64_t>(late_s * session::kNanosecondsPerSecond));
  }

  // Publishes a scene as a session's owner does.
  void publish(const Scene& wanted) {
    if (validate(wanted)) return;
    scene_ = wanted;
    const bool unread = exchange_.parameters.withdraw();
    ++generation_;
    settings_[generation_] = servo_settings(wanted);
    PlantModel* plant = real_ ? nullptr : plants_.plant_for(wanted, generation_, unread);
    exchange_.parameters.publish(session::test::parameters_of(wanted, generation_, plant));
  }

  void lead() {
    session::HandMove move{.m = {draw_.chance(0.2) ? 1.0 : draw_.uniform(0.0, 0.1)}};
    move.to_place = draw_.chance(0.5);
    move.duration_s = draw_.uniform(0.0, 0.1);
    static_cast<void>(exchange_.hand_moves.try_push(move));
  }

  void command_something() {
    const bool off = before_.arming.state == ArmingState::kOff;
    if (real_ && draw_.chance(off ? 0.1 : 1e-3)) {
      command(CommandKind::kArm);
      asked_ = true;
    } else if (draw_.chance(3e-4)) {
      command(CommandKind::kDisarm);
      disarmed_ = true;
    }
    if (draw_.chance(5e-4)) {
      command(CommandKind::kReset);
      disarmed_ = true;
      asked_ = false;
      force_before_n_ = 0.0;
    }
    if (before_.paused) {
      if (draw_.chance(0.05)) step();
      if (draw_.chance(0.05)) command(CommandKind::kResume);
    } else if (draw_.chance(3e-4)) {
      command(CommandKind::kPause);
    }
  }

  void step() {
    constexpr std::size_t kMaxSteps = 600;
    command(CommandKind::kStep, static_cast<std::uint32_t>(1 + draw_.index(kMaxSteps)));
  }

  // The handle goes into the wall and out of it, by jumps now and then; readings fail for a while.
  void move() {
    constexpr double kSwingM = 4e-3;
    phase_ += draw_.uniform(0.0, 0.05);
    DeviceReading& reading = device_.reading;
    reading = {0.0498 + kSwingM * std::sin(phase_), draw_.uniform(0.0, 0.0199), DeviceState::kOk};
    if (draw_.chance(2e-3)) reading.position_m = draw_.uniform(-1.0, 1.0);
    if (draw_.chance(5e-5)) {  // finite, and what is computed from it is not
      reading.position_m = draw_.log_uniform(1e290, 1e308);
      ++totals_.absurd_positions;
    }
    if (bad_for_ == 0 && draw_.chance(5e-4)) {
      bad_for_ = 1 + draw_.index(30);
      bad_kind_ = draw_.index(7);
    }
    if (bad_for_ == 0) return;
    --bad_for_;
    bad_reading_ = true;
    ++totals_.faults;
    spoil(reading);
  }

  void spoil(DeviceReading& reading) {
    const std::vector<double> ages_s{draw_.log_uniform(0.02000001, 1e6), kNotANumber, kEndless};
    switch (bad_kind_) {
      case 0:
      case 1:
      case 2:
        reading.age_s = ages_s.at(bad_kind_);
        break;
      case 3:
        reading.position_m = kNotANumber;
        break;
      case 4:
        reading.position_m = draw_.chance(0.5) ? kEndless : -kEndless;
        break;
      case 5:
        reading.position_m = kNotANumber;
        reading.age_s = kEndless;
        break;
      default:
        reading.state = DeviceState::kFault;
        reading.position_m = draw_.uniform(-1e9, 1e9);
    }
  }

  void break_down() {
    ++totals_.exceptions;
    (draw_.chance(0.5) ? device_.commands.throws_at_read : device_.commands.throws_at_write) = true;
  }

  static constexpr double kMaxRise = 1.01;  // the ramp is a whole number of ticks

  Scene scene_;
  Draw draw_;
  LifeTotals& totals_;
  DeviceKind& device_;
  session::PlantKeeper plants_;
  session::Exchange exchange_;
  session::ServoLoop loop_;
  session::test::FakeClock clock_;
  const bool real_;

  std::map<std::uint32_t, ServoSettings> settings_;  // by generation
  std::optional<ServoSettings> in_force_;
  std::uint32_t generation_ = 1;
  int cycle_ = 0;
  session::Snapshot before_;
  double force_before_n_ = 0.0;
  double gain_before_ = 0.0;
  double newest_before_n_ = 0.0;

  bool may_push_ = false;
  bool asked_ = false;     // these of the cycle that comes
  bool disarmed_ = false;  //
  bool hole_ = false;
  bool bad_reading_ = false;
  std::size_t bad_for_ = 0;
  std::size_t bad_kind_ = 0;
  double phase_ = 0.0;
};

}  // namespace hapticwall::testing
