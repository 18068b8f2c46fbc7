#include "core/tick/servo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace hapticwall {
namespace {

// Gives the positions that a test names and keeps the forces that it gets.
class ScriptedDevice {
 public:
  DeviceReading read() { return next; }
  void write(double force_n) { forces.push_back(force_n); }

  DeviceReading next;
  std::vector<double> forces;
};

ServoSettings stiff_wall(std::string_view algorithm = "none") {
  ServoSettings settings;
  const std::array<WallSettings, 1> walls{WallSettings{0.0, 35e3, 0.0}};
  settings.walls = WallSet(walls);
  settings.device_damping_n_s_per_m = 1.0;
  settings.force_limit_n = 8.9;
  settings.algorithm.index = *find_algorithm(algorithm);
  return settings;
}

// A servo whose handle is where the test says.
struct Bench {
  explicit Bench(const ServoSettings& settings = stiff_wall()) : servo(settings) {}
  Sample take(const DeviceReading& reading) {
    device.next = reading;
    return servo.tick(device);
  }
  Sample at(double position_m) { return take({position_m, 0.0, DeviceState::kOk}); }
  void stay(int ticks) {
    for (int i = 0; i < ticks; ++i) servo.tick(device);
  }
  [[nodiscard]] double force_n() const { return device.forces.back(); }

  Servo servo;
  ScriptedDevice device;
};

TEST(ServoStep, CommandsTheWallForceAndClampsIt) {
  Bench bench;
  Sample sample = bench.at(0.1e-3);
  EXPECT_NEAR(bench.force_n(), 3.5, 1e-12);
  EXPECT_EQ(sample.flags, static_cast<std::uint32_t>(kFlagInContact));
  sample = bench.at(1e-3);
  EXPECT_EQ(bench.force_n(), 8.9);
  EXPECT_EQ(sample.flags, static_cast<std::uint32_t>(kFlagInContact | kFlagForceLimit));
  EXPECT_NEAR(sample.wall_force_n, 35.0, 1e-12);
  EXPECT_NEAR(sample.stiffness_n_per_m, 8900.0, 1e-9);
}

TEST(ServoStep, OldOrFaultyInputMeansZeroForce) {
  for (const DeviceReading bad :
       {DeviceReading{1e-4, 0.021, DeviceState::kOk},
        DeviceReading{1e-4, std::nan(""), DeviceState::kOk},
        DeviceReading{1e-4, 0.0, DeviceState::kFault},
        DeviceReading{std::nan(""), 0.0, DeviceState::kOk},
        DeviceReading{std::numeric_limits<double>::infinity(), 0.0, DeviceState::kOk}}) {
    Bench bench;
    bench.at(1e-4);
    ASSERT_GT(bench.force_n(), 0.0);
    const Sample sample = bench.take(bad);
    EXPECT_EQ(bench.force_n(), 0.0);
    EXPECT_NE(sample.flags & (kFlagStaleInput | kFlagDeviceFault), 0U);
    EXPECT_TRUE(std::isfinite(sample.position_m));
    bench.at(1e-4);
    EXPECT_GT(bench.force_n(), 0.0);
  }
}

TEST(ServoStep, AForceThatIsNotFiniteIsZeroUntilReset) {
  ServoSettings settings = stiff_wall();
  const std::array<WallSettings, 1> walls{WallSettings{0.0, 1e308, 1e308}};
  settings.walls = WallSet(walls);
  Bench bench(settings);
  bench.at(1e4);
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_TRUE(bench.servo.state().failed);
  bench.at(0.0);
  bench.at(1e-300);
  EXPECT_EQ(bench.force_n(), 0.0);
  bench.servo.reset();
  bench.stay(1);
  EXPECT_GT(bench.force_n(), 0.0);
}

TEST(Servo, ASwitchStartsFromTheForceThatWasThere) {
  for (const AlgorithmDescription& from : algorithms()) {
    for (const AlgorithmDescription& to : algorithms()) {
      if (from.name == to.name) continue;  // no switch
      Bench bench(stiff_wall(from.name));
      for (int i = 0; i < 100; ++i) bench.at(1e-4 + 1e-6 * i);
      const double before = bench.force_n();
      ASSERT_GT(before, 0.0);
      bench.servo.apply(stiff_wall(to.name));
      bench.device.next.position_m += 1e-6;
      const Sample sample = bench.servo.tick(bench.device);
      EXPECT_NEAR(bench.force_n(), before, 1e-12) << from.name << " to " << to.name;
      EXPECT_NE(sample.flags & kFlagParametersChanged, 0U);
      EXPECT_EQ(bench.servo.tick(bench.device).flags & kFlagParametersChanged, 0U);
    }
  }
}

TEST(Servo, AChangedWallDoesNotKickEither) {
  Bench bench;
  bench.at(1e-4);
  ServoSettings moved = stiff_wall();
  const std::array<WallSettings, 1> walls{WallSettings{-1e-4, 35e3, 0.0}};
  moved.walls = WallSet(walls);
  bench.servo.apply(moved);
  bench.stay(1);
  EXPECT_NEAR(bench.force_n(), 3.5, 1e-12);
  double previous = bench.force_n();
  for (int i = 0; i < 60; ++i) {
    bench.stay(1);
    EXPECT_LE(std::abs(bench.force_n() - previous), 3.5 / 50 + 1e-12);
    previous = bench.force_n();
  }
  EXPECT_NEAR(previous, 7.0, 1e-12);
}

TEST(Servo, AfterTheTransitionTheNewAlgorithmIsAlone) {
  Bench bench(stiff_wall("none"));
  bench.at(2e-4);
  bench.servo.apply(stiff_wall("virtual-coupling"));
  bench.stay(51);
  EXPECT_NEAR(bench.force_n(), 2e-4 * 35e3 * 2e3 / 37e3, 1e-12);
}

TEST(Servo, ResetStartsAtTickZeroWithEmptyLedger) {
  Bench bench(stiff_wall("energy-bounding"));
  for (int i = 0; i < 10; ++i) bench.at(1e-5 * i);
  bench.servo.reset();
  const Sample sample = bench.at(5e-5);
  EXPECT_EQ(sample.tick, 0U);
  EXPECT_EQ(sample.velocity_m_per_s, 0.0);
  EXPECT_EQ(sample.energy_cv_j, 0.0);
}

// Without a first position there is no displacement: the position after a faulty start is no leap
// from 0.
TEST(ServoStep, AFaultyStartIsNoMotion) {
  Bench bench;
  bench.at(std::nan(""));
  const Sample sample = bench.at(1e-4);
  EXPECT_EQ(sample.velocity_m_per_s, 0.0);
  EXPECT_EQ(sample.energy_cv_j, 0.0);
  EXPECT_EQ(sample.energy_budget_j, 0.0);
  EXPECT_NEAR(bench.at(2e-4).velocity_m_per_s, 0.1, 1e-12);
}

TEST(ServoStep, TheFirstTickHasNoVelocityWhereverItIs) {
  Bench bench;
  EXPECT_EQ(bench.at(0.03).velocity_m_per_s, 0.0);
}

TEST(ServoStep, ActsOnAPositionOfTheGreatestAge) {
  Bench bench;
  EXPECT_EQ(bench.take({1e-4, kDefaultMaxAgeS, DeviceState::kOk}).flags & kFlagStaleInput, 0U);
  EXPECT_GT(bench.force_n(), 0.0);
}

// Borrowed: its state is the force, which a reset would set to zero.
constexpr Algorithm kConstantForce{
    {},
    [](void* /*state*/) {},
    [](void* /*state*/, const AlgorithmContext& /*context*/) {},
    [](void* state) { *static_cast<double*>(state) = 0.0; },
    [](void* state, const AlgorithmInput& /*input*/, std::span<double> /*signals*/) {
      return *static_cast<double*>(state);
    }};

TEST(ServoStep, ClampsAPullAsItClampsAPush) {
  for (const double wanted_n : {-100.0, -8.9, -3.0, 0.0, 3.5, 100.0}) {
    ServoState state;
    double borrowed_n = wanted_n;
    TickParts parts;
    parts.algorithm.borrow({&kConstantForce, &borrowed_n});
    ScriptedDevice device;
    device.next.position_m = 1e-4;  // the wall asks for 3.5 N
    const TickOutcome out = servo_step(stiff_wall(), state, parts, device);
    EXPECT_EQ(device.forces.back(), std::clamp(wanted_n, -8.9, 8.9));
    EXPECT_EQ(out.saturated, std::abs(wanted_n) > 8.9) << wanted_n;
    EXPECT_EQ(out.intervened, wanted_n != out.contact.force_n) << wanted_n;
    EXPECT_EQ(state.previous_force_n, device.forces.back());
  }
}

TEST(Servo, ABorrowedAlgorithmStaysInThePlaceOfEveryOtherAndItsFollower) {
  double borrowed_n = 2.0;
  std::vector<Servo> servos;
  servos.emplace_back(stiff_wall("force-bounding")).borrow({&kConstantForce, &borrowed_n});
  servos.emplace_back(stiff_wall());  // moves the first one
  ScriptedDevice device;
  device.next.position_m = 1e-4;
  EXPECT_EQ(servos[0].tick(device).force_n, 2.0);
  ServoSettings followed = stiff_wall("passivity-control");
  followed.algorithm.values.at(*find_algorithm_parameter("then")) = 1.0;
  servos[0].apply(followed);
  const Sample sample = servos[0].tick(device);
  EXPECT_EQ(sample.force_n, 2.0);
  EXPECT_TRUE(std::ranges::all_of(sample.signals, [](double value) { return std::isnan(value); }));
  EXPECT_EQ(servos[1].tick(device).force_n, 3.5);
  servos[0].reset();
  EXPECT_EQ(borrowed_n, 0.0) << "the reset reaches the borrowed algorithm";
}

// The velocity over two ticks.
struct LongDifference {
  static constexpr EstimatorDescription kDescription{
      "long-difference", "", "", {}, "v_k = (x_k - x_{k-2})/(2T)"};
  void configure(const EstimatorContext& context) { rate_hz_ = context.rate_hz; }
  void reset() { before_m_ = 0.0; }
  double velocity(double /*position_m*/, double displacement_m) {
    const double both_m = std::exchange(before_m_, displacement_m) + displacement_m;
    return 0.5 * both_m * rate_hz_;
  }

 private:
  double rate_hz_ = 0.0;
  double before_m_ = 0.0;
};
constexpr Estimator kLongDifference = estimator_of<LongDifference>();
constexpr Estimator kDifferenceByTable = estimator_of<BackwardDifference>();

TEST(Estimator, OfATableGivesTheVelocityOfTheTick) {
  ServoSettings settings = stiff_wall();
  settings.estimator = &kLongDifference;
  const std::array<WallSettings, 1> damper{WallSettings{0.0, 0.0, 1.0}};
  settings.walls = WallSet(damper);
  Bench bench(settings);
  bench.at(1e-3);
  EXPECT_DOUBLE_EQ(bench.at(3e-3).velocity_m_per_s, 1.0);
  EXPECT_DOUBLE_EQ(bench.at(5e-3).velocity_m_per_s, 2.0);
  EXPECT_DOUBLE_EQ(bench.force_n(), 2.0) << "the wall's damper takes it, too";
  bench.servo.reset();
  bench.at(5e-3);
  EXPECT_DOUBLE_EQ(bench.at(7e-3).velocity_m_per_s, 1.0) << "the reset forgets the past";
}

TEST(Estimator, KeepsItsPastWhenOtherSettingsChange) {
  ServoSettings settings = stiff_wall();
  settings.estimator = &kLongDifference;
  Bench bench(settings);
  bench.at(-9e-3);
  bench.at(-7e-3);
  settings.force_limit_n = 3.0;
  bench.servo.apply(settings);
  EXPECT_DOUBLE_EQ(bench.at(-5e-3).velocity_m_per_s, 2.0);
}

TEST(Estimator, TheInlineDifferenceIsThatOfTheTable) {
  ServoSettings settings = stiff_wall();
  Bench inlined(settings);
  settings.estimator = &kDifferenceByTable;
  Bench by_table(settings);
  for (const double position_m : {1e-3, 1.1e-3, 0.7e-3, -2e-3, 3.14159e-3}) {
    EXPECT_EQ(inlined.at(position_m).velocity_m_per_s, by_table.at(position_m).velocity_m_per_s);
    EXPECT_EQ(inlined.force_n(), by_table.force_n());
  }
}

TEST(ServoStep, MayLimitTheRiseOfTheMagnitude) {
  EXPECT_EQ(hapticwall::detail::limit_rise(9.0, 3.0, 1.0), 4.0);
  EXPECT_EQ(hapticwall::detail::limit_rise(0.5, 3.0, 1.0), 0.5);
  EXPECT_EQ(hapticwall::detail::limit_rise(-9.0, 3.0, 1.0), -1.0);
  EXPECT_EQ(hapticwall::detail::limit_rise(-9.0, -3.0, 1.0), -4.0);
  EXPECT_EQ(hapticwall::detail::limit_rise(9.0, -3.0, 1.0), 1.0);
}

TEST(ServoStep, TellsWhetherTheAlgorithmIntervened) {
  for (const char* algorithm : {"none", "virtual-coupling"}) {
    Bench bench(stiff_wall(algorithm));
    const Sample sample = bench.at(1e-4);
    EXPECT_EQ((sample.flags & kFlagIntervened) != 0U, sample.force_n != sample.wall_force_n);
    EXPECT_EQ((sample.flags & kFlagIntervened) != 0U, std::string_view(algorithm) != "none");
  }
}

TEST(Servo, TheBudgetIsThatOfTheBelievedDamping) {
  ServoSettings settings = stiff_wall();
  settings.algorithm.values.at(*find_algorithm_parameter("damping_n_s_per_m")) = 3.0;
  Bench bench(settings);
  bench.stay(1);
  EXPECT_NEAR(bench.at(-1e-4).energy_budget_j, -3.0 * 1e-8 / 1e-3, 1e-18);  // b Δx²/T
}

// Passivity control remembers the deficit of an earlier contact, unless it was switched in between.
TEST(Servo, ASwitchForgetsWhatTheAlgorithmRemembered) {
  ServoSettings controlled = stiff_wall("passivity-control");
  controlled.algorithm.values.at(*find_algorithm_parameter("observer")) = 1.0;
  Bench bench(controlled);
  for (const double position_m : {0.0, 2e-4, -2e-4}) bench.at(position_m);
  bench.servo.apply(stiff_wall("none"));
  bench.stay(60);
  bench.servo.apply(controlled);
  bench.stay(60);
  EXPECT_EQ(bench.at(1e-4).flags & kFlagIntervened, 0U);
}

ServoSettings seldom(std::uint64_t every) {
  ServoSettings settings = stiff_wall();
  settings.skipped.render_every = every;
  return settings;
}

TEST(SkippedTicks, HoldTheForceAndKnowThePosition) {
  Bench bench(seldom(3));
  bench.at(0.1e-3);
  const Sample held = bench.at(0.2e-3);
  EXPECT_NEAR(bench.force_n(), 3.5, 1e-12);
  EXPECT_EQ(held.position_m, 0.2e-3);
  EXPECT_NEAR(held.wall_force_n, 7.0, 1e-12);
  bench.at(0.05e-3);
  EXPECT_NEAR(bench.force_n(), 3.5, 1e-12);
  bench.at(0.05e-3);
  EXPECT_NEAR(bench.force_n(), 1.75, 1e-12);
}

// The hand must not wait for the controller's next computation.
TEST(SkippedTicks, GiveNoForceAfterAFaultAndComputeAtOnceWhenItIsOver) {
  Bench bench(seldom(100));
  bench.at(0.1e-3);
  bench.at(0.1e-3);
  bench.take({0.1e-3, 0.0, DeviceState::kFault});
  EXPECT_EQ(bench.force_n(), 0.0);
  bench.take({0.1e-3, 1.0, DeviceState::kOk});
  EXPECT_EQ(bench.force_n(), 0.0) << "a stale position";
  bench.at(0.02e-3);
  EXPECT_NEAR(bench.force_n(), 0.7, 1e-12);
}

// The switch of an algorithm starts from the force that acts, also between two computations.
TEST(SkippedTicks, AChangeOfParametersGivesNoKick) {
  Bench bench(seldom(100));
  bench.at(0.1e-3);
  bench.at(0.1e-3);
  ServoSettings settings = seldom(100);
  settings.algorithm.index = *find_algorithm("energy-bounding");
  bench.servo.apply(settings);
  double last_n = bench.force_n();
  for (int tick = 0; tick < 60; ++tick) {
    bench.at(0.1e-3);
    EXPECT_NEAR(bench.force_n(), last_n, 0.2) << tick;
    last_n = bench.force_n();
  }
}

TEST(SkippedTicks, TheAlgorithmSeesTheWholeDisplacement) {
  ServoSettings settings = seldom(4);
  settings.algorithm.index = *find_algorithm("energy-bounding");
  Bench bench(settings);
  bench.at(0.0);
  for (int tick = 1; tick <= 4; ++tick) bench.at(tick * 1e-6);
  // b times 4 µm in 4 ms, of the 0.14 N of the wall.
  EXPECT_NEAR(bench.force_n(), 1e-3, 1e-12);
}

}  // namespace
}  // namespace hapticwall
