// No rule disarms an honest device, whatever its hand does: random scripts with noise of one count,
// jitter of 5 %, missed ticks, missing reports, 2 ms of varying delay, and throws at up to 3 m/s.
// HAPTICWALL_HONEST_SCRIPTS sets their number.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "app/session/loop/servo_loop.h"
#include "app/session/scene_change.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "tests/app/session/support.h"
#include "tests/property/honest_device.h"

namespace hapticwall::testing {
namespace {

using session::ArmingNote;
using session::ArmingState;

constexpr double kWallM = 0.05;
constexpr int kScriptTicks = 4000;

std::uint32_t scripts() {
  const char* text = std::getenv("HAPTICWALL_HONEST_SCRIPTS");
  return text == nullptr ? 60 : static_cast<std::uint32_t>(std::stoul(text));
}

class Script {
 public:
  Script(std::uint32_t seed, bool is_wheel) : random_(seed), is_wheel_(is_wheel) {}

  [[nodiscard]] HonestSettings draw() {
    HonestSettings settings;
    settings.is_wheel = is_wheel_;
    settings.scene = scene();
    settings.clock_rate = uniform(0.99, 1.01);
    settings.missing_reports = chance(0.5) ? uniform(0.0, 0.05) : 0.0;
    settings.seed = below(1U << 31U);
    return settings;
  }
  [[nodiscard]] double uniform(double from, double to) {
    return from + (to - from) * static_cast<double>(random_()) / 0x1p32;
  }
  [[nodiscard]] bool chance(double share) { return uniform(0.0, 1.0) < share; }
  [[nodiscard]] std::uint32_t below(std::uint32_t limit) {
    return static_cast<std::uint32_t>(random_() % limit);
  }

 private:
  [[nodiscard]] Scene scene() {
    Scene scene;
    DeviceSettings& device = scene.x().device;
    device.mass_kg = is_wheel_ ? 0.8 : uniform(0.03, 0.2);
    device.damping_n_s_per_m = uniform(0.1, 2.0);
    if (chance(0.7)) device.friction_n = uniform(0.0, 0.3);
    device.encoder_m = std::pow(10.0, uniform(-5.7, -3.6));
    device.force_limit_n = is_wheel_ ? 5.0 : 8.9;
    device.start_m = 0.03;
    scene.x().hand = hand(*device.force_limit_n);
    scene.x().walls = {{kWallM, std::pow(10.0, uniform(2.5, 4.5)), 0.0}};
    scene.algorithm.index = below(static_cast<std::uint32_t>(first_plugin()));
    return scene;
  }
  [[nodiscard]] HandSettings hand(double limit_n) {
    HandSettings hand;
    hand.mass_kg = uniform(0.1, 1.0);
    hand.stiffness_n_per_m = uniform(100.0, 500.0);
    hand.damping_n_s_per_m = uniform(5.0, 40.0);
    if (chance(0.6)) {
      hand.grip_stiffness_n_per_m = uniform(500.0, 3000.0);
      hand.grip_damping_n_s_per_m = uniform(1.0, 5.0);
    }
    const double deepest_m = kWallM + uniform(0.2, 0.8) * limit_n / hand.stiffness_n_per_m;
    double time_s = 0.4;
    double place_m = 0.03;
    hand.path = {{0.0, place_m}, {time_s, place_m}};
    while (time_s < 4.0) {
      const double to_m = chance(0.3) ? uniform(-0.05, 0.045) : uniform(kWallM, deepest_m);
      // Inside the wall a hand is not stronger than the force limit.
      const bool stays_inside = place_m >= kWallM && to_m >= kWallM;
      const double fastest = 0.2 * limit_n / hand.damping_n_s_per_m;
      const double speed =
          stays_inside ? fastest * uniform(0.1, 1.0) : std::pow(10.0, uniform(-1.5, 0.3));
      time_s += std::max(std::abs(to_m - place_m) / speed, 2e-3);
      hand.path.edit().push_back({time_s, to_m});
      place_m = to_m;
      if (chance(0.5)) hand.path.edit().push_back({time_s += uniform(0.05, 1.5), to_m});
    }
    return hand;
  }

  std::mt19937 random_;
  bool is_wheel_;
};

struct Lived {
  ArmingNote note = ArmingNote::kNone;
  bool obeyed = false;
  double fastest_m_per_s = 0.0;
};

Lived live(std::uint32_t seed, bool is_wheel) {
  Script script(seed, is_wheel);
  HonestDevice device(script.draw());
  HonestSettings settings = Script(seed, is_wheel).draw();
  session::Exchange exchange(
      {.plot = 1, .recorder = 1},
      session::test::parameters_of(session::scene_on(settings.scene, device.info())));
  session::ServoLoop loop(
      {&device}, exchange,
      session::test::parameters_of(session::scene_on(settings.scene, device.info())), false);
  session::test::FakeClock clock;
  Lived lived;
  EXPECT_TRUE(exchange.commands.try_push({session::CommandKind::kArm, 0}));
  for (int tick = 0; tick < kScriptTicks && device.fastest_m_per_s <= 3.0;) {
    const std::uint64_t missed = script.chance(0.005) ? script.below(6) : 0;
    for (std::uint64_t i = 0; i <= missed; ++i) device.pass_tick();
    tick += static_cast<int>(missed) + 1;
    clock.advance_ns(static_cast<std::int64_t>(1'000'000 * (missed + 1)));
    loop.cycle({clock.now_ns(), static_cast<std::int64_t>(script.uniform(0.0, 50e3)), missed},
               clock);
    exchange.snapshots.update();
    const session::ArmingStatus arming = exchange.snapshots.current().arming;
    lived.obeyed = arming.state == ArmingState::kOn && arming.limit_share == 1.0;
    if (arming.state == ArmingState::kOff && arming.asked > 0) {
      lived.note = arming.note;
      break;
    }
  }
  lived.fastest_m_per_s = device.fastest_m_per_s;
  return lived;
}

TEST(HonestDevice, IsNeverDisarmed) {
  std::uint32_t obeyed = 0;
  std::uint32_t fast = 0;
  const std::uint32_t count = scripts();
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    const Lived lived = live(seed, seed % 4 == 0);
    EXPECT_EQ(session::arming_note_text(lived.note), "") << "seed " << seed;
    obeyed += lived.obeyed ? 1 : 0;
    fast += lived.fastest_m_per_s > 1.0 ? 1 : 0;
  }
  EXPECT_GT(obeyed, count / 4);
  EXPECT_GT(fast, count / 50);
  RecordProperty("obeyed", static_cast<int>(obeyed));
  RecordProperty("fast", static_cast<int>(fast));
}

}  // namespace
}  // namespace hapticwall::testing
