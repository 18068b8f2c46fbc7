#include "core/stabiliser/stabiliser.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>

namespace hapticwall {
namespace {

constexpr double kPeriodS = 1e-3;

void set(AlgorithmSettings& settings, std::string_view key, double value) {
  settings.values.at(find_algorithm_parameter(key).value()) = value;
}

Stabiliser configured(std::string_view algorithm, const StabiliserContext& context) {
  Stabiliser stabiliser;
  stabiliser.configure(find_algorithm(algorithm).value(), context);
  return stabiliser;
}

// A wall at 0 and the bookkeeping around an algorithm's step, so that a test names positions only.
class Bench {
 public:
  Bench(std::string_view algorithm, const WallSettings& wall, AlgorithmSettings settings,
        double damping = 1.0, double encoder_m = 0.1e-3)
      : settings_(settings) {
    context_.period_s = kPeriodS;
    context_.device_damping_n_s_per_m = damping;
    context_.encoder_m = encoder_m;
    const std::array<WallSettings, 1> walls{wall};
    context_.walls = WallSet(walls);
    context_.settings = &settings_;
    stabiliser_ = configured(algorithm, context_);
  }

  double move_to(double position_m) {
    const double displacement_m = position_m - position_m_;
    const double velocity = displacement_m / kPeriodS;
    const WallContact contact = evaluate_walls(context_.walls, position_m, velocity);
    wall_force_n_ = contact.force_n;
    force_n_ = stabiliser_.step({contact.force_n, position_m, displacement_m, velocity,
                                 contact.penetration_m, force_n_, contact.in_contact});
    position_m_ = position_m;
    return force_n_;
  }
  [[nodiscard]] double wall_force_n() const { return wall_force_n_; }

 private:
  AlgorithmSettings settings_;
  StabiliserContext context_;
  Stabiliser stabiliser_;
  double position_m_ = 0.0;
  double force_n_ = 0.0;
  double wall_force_n_ = 0.0;
};

TEST(AlgorithmList, EveryNameIsItsOwnAndFoundAgain) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    const AlgorithmDescription& algorithm = algorithms()[i];
    EXPECT_TRUE(names.insert(algorithm.name).second) << algorithm.name;
    EXPECT_EQ(find_algorithm(algorithm.name), i);
    EXPECT_FALSE(algorithm.title.empty());
    EXPECT_FALSE(algorithm.idea.empty());
  }
  EXPECT_EQ(find_algorithm("no-such-thing"), std::nullopt);
}

TEST(AlgorithmList, AnIndexOutsideItIsTheFirstAlgorithm) {
  Stabiliser stabiliser;
  stabiliser.configure(algorithms().size(), {.walls = {}, .settings = nullptr});
  EXPECT_EQ(stabiliser.algorithm(), 0U);
}

TEST(AlgorithmList, EveryParameterIsInTheUnionOnce) {
  std::set<std::string_view> keys;
  for (const ParameterDescription& parameter : algorithm_parameters()) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.key;
    EXPECT_FALSE(parameter.default_text.empty()) << parameter.key;
  }
  for (const AlgorithmDescription& algorithm : algorithms()) {
    for (const ParameterDescription& parameter : algorithm.parameters) {
      EXPECT_TRUE(keys.contains(parameter.key)) << parameter.key;
    }
  }
}

TEST(NoStabiliser, PassesTheWallForceOn) {
  Bench bench("none", {0.0, 10e3, 0.0}, {});
  EXPECT_DOUBLE_EQ(bench.move_to(0.1e-3), 1.0);
}

// Paper, section 3.2: b = 1, Δ = 0.1 mm, T = 1 ms: 0.1 N per count of motion, ten ticks to reach 1
// N.
TEST(EnergyBounding, ReachesTheWallForceInThePapersTenTicks) {
  AlgorithmSettings settings;
  set(settings, "rest_force_step_n", 0.1);
  Bench bench("energy-bounding", {0.0, 10e3, 0.0}, settings);
  EXPECT_NEAR(bench.move_to(0.1e-3), 0.1, 1e-12);  // one count: b |v| = 0.1 N
  for (int i = 2; i <= 9; ++i) EXPECT_NEAR(bench.move_to(0.1e-3), 0.1 * i, 1e-12);
  EXPECT_NEAR(bench.move_to(0.1e-3), 1.0, 1e-12);
  EXPECT_NEAR(bench.move_to(0.1e-3), 1.0, 1e-12);
}

TEST(EnergyBounding, DefaultRestStepIsWhatOneHiddenCountAllows) {
  Bench bench("energy-bounding", {0.0, 1e6, 0.0}, {}, 2.0, 0.1e-3);
  bench.move_to(0.1e-3);
  const double before = bench.move_to(0.1e-3);
  EXPECT_NEAR(bench.move_to(0.1e-3) - before, 2.0 * 0.1e-3 / kPeriodS, 1e-12);
}

TEST(EnergyBounding, BelievesTheDampingThatItIsTold) {
  AlgorithmSettings settings;
  set(settings, "damping_n_s_per_m", 3.0);
  Bench bench("energy-bounding", {0.0, 1e6, 0.0}, settings);
  EXPECT_NEAR(bench.move_to(0.1e-3), 0.3, 1e-12);
}

TEST(EnergyBounding, StaysFiniteForTheSmallestVelocity) {
  AlgorithmSettings settings;
  set(settings, "rest_force_step_n", 0.0);
  Bench bench("energy-bounding", {0.0, 1e9, 0.0}, settings, 1.0, 0.0);
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(std::isfinite(bench.move_to(tiny)));
  EXPECT_NEAR(bench.move_to(tiny), 0.0, 1e-300);
}

// Paper, section 3.2: b = 1, T = 1 ms gives a coupling of 2 kN/m; in series with the wall.
TEST(VirtualCoupling, IsThePapersTwoKilonewtonsPerMetreInSeries) {
  Bench bench("virtual-coupling", {0.0, 35e3, 0.0}, {});
  EXPECT_NEAR(bench.move_to(1e-3), 1e-3 * 35e3 * 2e3 / 37e3, 1e-12);
  EXPECT_EQ(bench.move_to(-1e-3), 0.0);
}

TEST(VirtualCoupling, GivesEachContactItsShare) {
  AlgorithmSettings settings;
  const std::array<WallSettings, 2> walls{WallSettings{0.0, 10e3, 0.0},
                                          WallSettings{1e-3, 20e3, 0.0}};
  StabiliserContext context;
  context.period_s = kPeriodS;
  context.device_damping_n_s_per_m = 1.0;
  context.walls = WallSet(walls);
  context.settings = &settings;
  Stabiliser coupling = configured("virtual-coupling", context);
  const auto force_at = [&](double x) { return coupling.step({0.0, x, 0.0, 0.0, x, 0.0, true}); };
  EXPECT_NEAR(force_at(0.5e-3), 0.5e-3 * 10e3 * 2e3 / 12e3, 1e-12);
  EXPECT_NEAR(force_at(3e-3), 3e-3 * 10e3 * 1e3 / 11e3 + 2e-3 * 20e3 * 1e3 / 21e3, 1e-12);
}

// With dampers, held still, the proxy comes to rest where the springs alone would have it.
TEST(VirtualCoupling, WithDampersSettlesOnTheSprings) {
  AlgorithmSettings settings;
  set(settings, "coupling_damping_n_s_per_m", 0.25);
  Bench bench("virtual-coupling", {0.0, 5e3, 2.0}, settings);
  double force = 0.0;
  for (int i = 0; i < 200; ++i) force = bench.move_to(2e-3);
  const double coupling = 2.0 * (1.0 - 0.25) / kPeriodS;
  EXPECT_NEAR(force, 2e-3 * 5e3 * coupling / (5e3 + coupling), 1e-9);
}

// Two ticks of (B + B_c) q' = K_c (p - q) + B_c v - K q by hand, at 1 mm into the wall and then out
// of the way of the first: the wall's damper carries, the coupling's damper pushes.
TEST(VirtualCoupling, WithDampersTakesTheImplicitStep) {
  constexpr double kWall = 5e3;
  constexpr double kWallDamping = 2.0;
  constexpr double kCouplingDamping = 0.25;
  AlgorithmSettings settings;
  set(settings, "coupling_damping_n_s_per_m", kCouplingDamping);
  Bench bench("virtual-coupling", {0.0, kWall, kWallDamping}, settings);
  const double coupling = 2.0 * (1.0 - kCouplingDamping) / kPeriodS;
  const double rate = (kWallDamping + kCouplingDamping) / kPeriodS;
  double q = 0.0;
  double x = 0.0;
  for (const double next : {1e-3, 1.2e-3, 1.1e-3}) {
    const double v = (next - x) / kPeriodS;
    x = next;
    const double before = q;
    q = (coupling * x + kCouplingDamping * v + rate * before) / (kWall + coupling + rate);
    EXPECT_NEAR(bench.move_to(x), kWall * q + kWallDamping * (q - before) / kPeriodS, 1e-12) << x;
  }
}

TEST(VirtualCoupling, ForgetsTheProxyOutsideTheWall) {
  AlgorithmSettings settings;
  set(settings, "coupling_damping_n_s_per_m", 0.25);
  Bench fresh("virtual-coupling", {0.0, 5e3, 2.0}, settings);
  Bench used("virtual-coupling", {0.0, 5e3, 2.0}, settings);
  for (int i = 0; i < 10; ++i) used.move_to(2e-3);
  used.move_to(0.0);
  used.move_to(0.0);
  EXPECT_EQ(used.move_to(1e-3), fresh.move_to(1e-3));
}

TEST(VirtualCoupling, OfNoStiffnessAtAllGivesNoForce) {
  AlgorithmSettings settings;
  set(settings, "coupling_stiffness_n_per_m", 0.0);
  Bench bench("virtual-coupling", {0.0, 0.0, 0.0}, settings);
  EXPECT_EQ(bench.move_to(1e-3), 0.0);
}

// Paper, Eq. 12: on a spring wall the same-sample observer never falls below zero.
TEST(PassivityControl, WithTheSameSampleObserverNeverActsOnASpring) {
  Bench bench("passivity-control", {0.0, 35e3, 0.0}, {});
  double x = 0.0;
  for (int i = 1; i < 2000; ++i) {
    x = 1e-3 * std::sin(0.37 * i) + 0.4e-3 * std::sin(1.91 * i);
    const double force = bench.move_to(x);
    ASSERT_EQ(force, bench.wall_force_n()) << i;
  }
}

// Two moves by hand. In: 0.1 mm at F_d = 1 N held from the entry; then out again by 0.05 mm.
// Held-force observer: E = 0 at entry (force before it was 0); moving out by 0.05 mm under the held
// 1 N gives W = -0.05 mJ; a damper takes (0.05 mJ)/(T v²) = 20 N·s/m: beyond the cap of 4 N·s/m.
TEST(PassivityControl, WithTheHeldForceObserverDampsUpToItsCap) {
  AlgorithmSettings settings;
  set(settings, "observer", 1.0);
  set(settings, "max_damping_n_s_per_m", 4.0);
  Bench bench("passivity-control", {0.0, 10e3, 0.0}, settings);
  EXPECT_NEAR(bench.move_to(0.1e-3), 1.0, 1e-12);
  EXPECT_NEAR(bench.move_to(0.05e-3), 0.5 + 4.0 * -0.05, 1e-12);
}

TEST(PassivityControl, BelowItsCapTakesExactlyWhatIsMissing) {
  AlgorithmSettings settings;
  set(settings, "observer", 1.0);
  set(settings, "max_damping_n_s_per_m", 1e3);
  Bench bench("passivity-control", {0.0, 10e3, 0.0}, settings);
  bench.move_to(0.1e-3);
  // W = -1 N * 0.05 mm; F_d = F_e + W/|Δx| in the direction of motion: 0.5 - 1.
  EXPECT_NEAR(bench.move_to(0.05e-3), 0.5 - 1.0, 1e-12);
}

TEST(PassivityControl, CreditFloorAndResetHoldItBack) {
  AlgorithmSettings base;
  set(base, "observer", 1.0);
  set(base, "max_damping_n_s_per_m", 1e3);
  AlgorithmSettings credit = base;
  set(credit, "damping_credit", 1.0);
  set(credit, "damping_n_s_per_m", 1.0);
  Bench with_credit("passivity-control", {0.0, 10e3, 0.0}, credit);
  with_credit.move_to(0.1e-3);
  // Credit T b Σv² = 1e-3 (0.1² + 0.05²) J = 0.0125 mJ of the 0.05 mJ is forgiven.
  EXPECT_NEAR(with_credit.move_to(0.05e-3), 0.5 - (0.05e-3 - 0.0125e-3) / 0.05e-3, 1e-9);

  AlgorithmSettings floor = base;
  set(floor, "velocity_floor_m_per_s", 0.06);
  Bench with_floor("passivity-control", {0.0, 10e3, 0.0}, floor);
  with_floor.move_to(0.1e-3);
  EXPECT_NEAR(with_floor.move_to(0.05e-3), 0.5, 1e-12);

  for (const double reset : {0.0, 1.0}) {
    AlgorithmSettings forgets = base;
    set(forgets, "reset_in_free_motion", reset);
    Bench bench("passivity-control", {0.0, 10e3, 0.0}, forgets);
    bench.move_to(0.1e-3);
    // Outside, 1 N held through -0.2 mm: W = -0.2 mJ is answered by -1 N, which takes W to -0.25
    // mJ.
    EXPECT_NEAR(bench.move_to(-0.1e-3), reset != 0.0 ? 0.0 : -1.0, 1e-12);
    EXPECT_NEAR(bench.move_to(-0.05e-3), reset != 0.0 ? 0.0 : 5.0, 1e-12);
    EXPECT_NEAR(bench.move_to(0.1e-3), 1.0, 1e-12);  // inside again, with W > 0
  }
}

TEST(PassivityControl, ActsAboveItsVelocityFloorOnly) {
  AlgorithmSettings settings;
  set(settings, "observer", 1.0);
  set(settings, "max_damping_n_s_per_m", 1e3);
  for (const double floor : {0.25, std::nextafter(0.25, 0.0)}) {
    set(settings, "velocity_floor_m_per_s", floor);
    StabiliserContext context;
    context.settings = &settings;
    Stabiliser control = configured("passivity-control", context);
    // Exactly at 0.25 m/s: 1 N held through -0.25 mm.
    const double force = control.step({0.5, 1e-4, -0.25e-3, -0.25, 1e-4, 1.0, true});
    EXPECT_EQ(force != 0.5, floor < 0.25);
  }
}

// b = 1 N s/m is the largest damper that the hold renders passively.
TEST(PassivityControl, ItsDefaultCapIsTheBelievedDamping) {
  AlgorithmSettings settings;
  set(settings, "observer", 1.0);
  Bench bench("passivity-control", {0.0, 10e3, 0.0}, settings);
  bench.move_to(0.1e-3);
  EXPECT_NEAR(bench.move_to(0.05e-3), 0.5 - 1.0 * 0.05, 1e-12);
}

// A wall that is no spring: nothing on the way in, 1 N on the way out. The same-sample observer
// sees that at once, and its damper takes the force away.
TEST(PassivityControl, WithTheSameSampleObserverActsOnAnActiveWall) {
  AlgorithmSettings settings;
  set(settings, "max_damping_n_s_per_m", 1e3);
  StabiliserContext context;
  context.settings = &settings;
  Stabiliser control = configured("passivity-control", context);
  EXPECT_EQ(control.step({0.0, 1e-4, 1e-4, 0.1, 1e-4, 0.0, true}), 0.0);
  EXPECT_NEAR(control.step({1.0, 0.5e-4, -0.5e-4, -0.05, 0.5e-4, 0.0, true}), 0.0, 1e-12);
}

// Out of the wall the last displacement is forgotten with the rest.
TEST(PassivityControl, ResetInFreeMotionForgetsTheLastMoveToo) {
  AlgorithmSettings settings;
  set(settings, "reset_in_free_motion", 1.0);
  set(settings, "max_damping_n_s_per_m", 1e3);
  StabiliserContext context;
  context.settings = &settings;
  Stabiliser control = configured("passivity-control", context);
  EXPECT_EQ(control.step({0.0, -1e-4, -1e-4, -0.1, -1e-4, 0.0, false}), 0.0);
  // Were 5 N paired with the -0.1 mm before it, 0.5 mJ would be missing.
  EXPECT_EQ(control.step({1.0, 1e-4, 2e-4, 0.2, 1e-4, 5.0, true}), 1.0);
}

TEST(PassivityControl, StaysFiniteForTheSmallestVelocity) {
  AlgorithmSettings settings;
  set(settings, "observer", 1.0);
  Bench bench("passivity-control", {0.0, 1e9, 0.0}, settings);
  bench.move_to(1e-3);
  bench.move_to(0.5e-3);
  const double next = std::nextafter(0.5e-3, 0.0);
  EXPECT_TRUE(std::isfinite(bench.move_to(next)));
  EXPECT_TRUE(std::isfinite(bench.move_to(next)));
}

}  // namespace
}  // namespace hapticwall
