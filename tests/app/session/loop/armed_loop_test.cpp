// When the force of a real device may act, in the loop that runs it.
#include <gtest/gtest.h>

#include "app/session/loop/arming.h"
#include "app/session/scene_change.h"
#include "tests/app/session/loop/loop_bench.h"

namespace hapticwall::session::test {
namespace {

constexpr int kRampLengthTicks = 500;
constexpr double kArmingFreeM = 0.03;
constexpr double kArmingInsideM = 0.0502;
constexpr double kStiffness = 10'000.0;
constexpr double kLimitN = 8.9;

Scene bare_wall() {
  Scene scene;
  scene.x().walls = {{0.05, kStiffness, 0.0}};
  scene.algorithm.index = find_algorithm("none").value();
  return scene;
}

// The loop on a device that shows its commands.
struct RealLoop : LoopBench<FakeDevice> {
  RealLoop() : LoopBench(bare_wall()) { device.position_m = kArmingFreeM; }
  void arm() {
    command(CommandKind::kArm);
    cycles(kRampLengthTicks + 2);
    ASSERT_EQ(snapshot().arming.state, ArmingState::kOn);
  }
  void publish(const Scene& changed) {
    exchange.parameters.publish(parameters_of(changed, ++generation));
  }
  [[nodiscard]] double force_n() const { return device.forces_n.back(); }
  void expect_no_force() const {
    EXPECT_EQ(force_n(), 0.0);
    EXPECT_FALSE(device.enabled_at_write.back());
  }

  std::uint32_t generation = 1;
};

TEST(ArmedLoop, PushesNothingAndEnablesNothingBeforeItIsArmed) {
  RealLoop real;
  real.device.position_m = kArmingInsideM;
  real.cycles(20);
  for (std::size_t i = 0; i < real.device.forces_n.size(); ++i) {
    EXPECT_EQ(real.device.forces_n[i], 0.0);
    EXPECT_FALSE(real.device.enabled_at_write[i]);
  }
  // The samples hold the commanded force, and the force of the wall.
  EXPECT_EQ(real.snapshot().newest.x().force_n, 0.0);
  EXPECT_NEAR(real.snapshot().newest.x().wall_force_n, 2.0, 1e-9);
}

TEST(ArmedLoop, RampsInAndThenPushesWithAllOfIt) {
  RealLoop real;
  real.command(CommandKind::kArm);
  real.cycles(kRampLengthTicks / 2 + 1);
  real.device.position_m = kArmingInsideM;
  real.cycles(1);
  EXPECT_TRUE(real.device.enabled);
  EXPECT_NEAR(real.force_n(), 1.0, 0.02);
  real.cycles(kRampLengthTicks);
  EXPECT_NEAR(real.force_n(), 2.0, 1e-9);
}

// A stiff wall exceeds the limit: the ramp applies to the limited force.
TEST(ArmedLoop, InAStiffWallTheLimitRisesToo) {
  RealLoop real;
  Scene limited = bare_wall();
  limited.x().device.force_limit_n = kLimitN;
  limited.x().walls[0].stiffness_n_per_m = 1e6;
  real.publish(limited);
  real.command(CommandKind::kArm);
  real.cycles(1);
  real.device.position_m = kArmingInsideM + 1e-3;
  for (int tick = 1; tick <= kRampLengthTicks; ++tick) {
    real.cycles(1);
    ASSERT_NEAR(real.force_n(), kLimitN * tick / kRampLengthTicks, 1e-9) << tick;
  }
}

// While the force rises, a change takes nothing away and gives nothing: it goes on from where it
// is.
TEST(ArmedLoop, AChangeInTheRampIsNoKick) {
  RealLoop real;
  real.command(CommandKind::kArm);
  real.cycles(1);
  real.device.position_m = kArmingInsideM;
  real.cycles(kRampLengthTicks / 2);
  const double before_n = real.force_n();
  EXPECT_NEAR(before_n, 1.0, 0.02);
  Scene changed = bare_wall();
  changed.x().walls[0].stiffness_n_per_m = 3.0 * kStiffness;
  real.publish(changed);
  real.cycles(1);
  EXPECT_NEAR(real.force_n(), before_n, 2.0 * before_n / (0.5 * kRampLengthTicks));
  EXPECT_GT(real.force_n(), before_n);
}

// The force of a stiff wall beyond the limit is forgotten: a handle that leaves right after a
// change is not pulled back in.
TEST(ArmedLoop, AChangeAtTheLimitPullsNothingIn) {
  RealLoop real;
  Scene stiff = bare_wall();
  stiff.x().device.force_limit_n = kLimitN;
  stiff.x().walls[0].stiffness_n_per_m = 1e6;
  real.publish(stiff);
  real.arm();
  real.device.position_m = kArmingInsideM;
  real.cycles(1);
  EXPECT_EQ(real.force_n(), kLimitN);
  stiff.x().walls[0].stiffness_n_per_m = 2e6;
  real.publish(stiff);
  real.cycles(1);
  EXPECT_EQ(real.force_n(), kLimitN);
  EXPECT_NE(real.snapshot().newest.x().flags & kFlagForceLimit, 0U);
  real.device.position_m = kArmingFreeM;
  for (int tick = 0; tick < kRampLengthTicks; ++tick) {
    real.cycles(1);
    ASSERT_EQ(real.force_n(), 0.0) << tick;
  }
}

// The limit is on the magnitude of the force, from zero after a change of sign; the force falls at
// once. Ledger and sample have the commanded force.
TEST(ArmedLoop, ADeviceMayLimitTheRateAtWhichItsForceRises) {
  FakeDevice slow;
  slow.max_force_rate_n_per_s = 700.0;
  LoopBench<FakeDevice> bench(scene_on(bare_wall(), slow.info()));
  FakeDevice& device = bench.device;
  device.position_m = 0.0499;
  bench.cycles(1);
  bench.command(CommandKind::kArm);
  bench.cycles(kRampLengthTicks + 2);
  device.position_m = kArmingInsideM;  // 2 N
  const double energy_j = bench.snapshot().newest.x().energy_cv_j;
  for (const double expected_n : {0.7, 1.4, 2.0, 2.0}) {
    bench.cycles(1);
    const Sample sample = bench.snapshot().newest.x();
    EXPECT_NEAR(device.forces_n.back(), expected_n, 1e-9);
    EXPECT_EQ(sample.force_n, device.forces_n.back());
    EXPECT_EQ((sample.flags & kFlagForceRate) != 0, expected_n < 2.0);
  }
  EXPECT_NE(bench.snapshot().newest.x().energy_cv_j, energy_j);
  device.position_m = 0.0499;
  bench.cycles(1);
  EXPECT_EQ(device.forces_n.back(), 0.0);
  EXPECT_EQ(bench.snapshot().newest.x().flags & kFlagForceRate, 0U);
}

TEST(ArmedLoop, DisarmActsAtTheNextTick) {
  RealLoop real;
  real.arm();
  real.device.position_m = kArmingInsideM;
  real.cycles(1);
  EXPECT_NEAR(real.force_n(), 2.0, 1e-9);
  real.command(CommandKind::kDisarm);
  real.cycles(1);
  real.expect_no_force();
  EXPECT_EQ(real.snapshot().arming.note, ArmingNote::kAsked);
}

TEST(ArmedLoop, AFaultIsAnsweredInTheSameTick) {
  for (const bool stale : {false, true}) {
    RealLoop real;
    real.arm();
    real.device.position_m = kArmingInsideM;
    real.cycles(1);
    if (stale) {
      real.device.age_s = 1.0;
    } else {
      real.device.state = DeviceState::kFault;
      real.device.figures.trouble = device::Trouble::kSilent;
    }
    real.cycles(1);
    real.expect_no_force();
    EXPECT_EQ(real.snapshot().arming.note, stale ? ArmingNote::kStale : ArmingNote::kDevice);
    const double since_s = real.snapshot().newest.x().time_s;
    EXPECT_GT(since_s, 0.0);
    EXPECT_EQ(real.snapshot().arming.since_s, since_s);
    real.device.age_s = 0.0;
    real.device.state = DeviceState::kOk;
    real.cycles(100);  // well again, and still off
    real.expect_no_force();
    EXPECT_EQ(real.snapshot().arming.since_s, since_s);
  }
}

// Unobserved motion has no velocity and no energy.
TEST(ArmedLoop, TheFirstPositionAfterAFaultIsNoMove) {
  RealLoop real;
  real.cycles(10);
  real.device.state = DeviceState::kFault;
  real.cycles(10);
  real.device.state = DeviceState::kOk;
  real.device.position_m = 0.01;
  real.cycles(1);
  EXPECT_EQ(real.snapshot().newest.x().velocity_m_per_s, 0.0);
  EXPECT_EQ(real.snapshot().newest.x().position_m, 0.01);
}

TEST(ArmedLoop, APauseDisarmsAndWhatMovesMeanwhileIsNoMove) {
  RealLoop real;
  real.arm();
  real.command(CommandKind::kPause);
  real.cycles(5);
  EXPECT_EQ(real.snapshot().arming.note, ArmingNote::kPaused);
  EXPECT_FALSE(real.device.enabled);
  real.command(CommandKind::kArm);
  real.cycles(1);
  EXPECT_EQ(real.snapshot().arming.state, ArmingState::kOff);
  EXPECT_EQ(real.snapshot().arming.asked, 2U);
  real.device.position_m = kArmingInsideM;
  real.command(CommandKind::kResume);
  real.cycles(1);
  EXPECT_EQ(real.snapshot().newest.x().velocity_m_per_s, 0.0);
  EXPECT_EQ(real.force_n(), 0.0);
}

TEST(ArmedLoop, AResetDisarms) {
  RealLoop real;
  real.arm();
  real.command(CommandKind::kReset);
  real.cycles(3);
  EXPECT_EQ(real.snapshot().arming.state, ArmingState::kOff);
}

TEST(ArmedLoop, AWallThatIsMovedOverTheHandleTakesTheForceAway) {
  RealLoop real;
  real.arm();
  Scene changed = bare_wall();
  changed.x().walls[0].position_m = 0.02;
  real.publish(changed);
  real.cycles(1);
  EXPECT_EQ(real.snapshot().arming.note, ArmingNote::kWallMoved);
  real.expect_no_force();
}

TEST(ArmedLoop, TheSampleTellsAgeAndDeviceTime) {
  RealLoop real;
  real.device.age_s = 0.003;
  real.cycles(1);
  EXPECT_EQ(real.snapshot().newest.x().read_age_s, 0.003);
  EXPECT_EQ(real.snapshot().newest.x().device_time_s, real.device.device_time_s);
}

TEST(ArmedLoop, TheEndTakesTheForceAway) {
  RealLoop real;
  real.arm();
  real.loop.shut_down(false);
  real.expect_no_force();
  EXPECT_EQ(real.device.log.back(), "close");
  EXPECT_EQ(real.snapshot().arming.state, ArmingState::kOff);
}

}  // namespace
}  // namespace hapticwall::session::test
