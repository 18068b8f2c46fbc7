// The limit of stability under the estimators of velocity, which docs/estimators.md quotes: against
// the eigenvalues of a loop by a second derivation, and against the growth of a loop that runs with
// the program's estimators.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/estimator/active_estimator.h"
#include "core/scene_keys.h"
#include "core/study/stability_bounds.h"
#include "tests/golden/estimator_scenes.h"

namespace hapticwall {
namespace {

using hapticwall::testing::kDifference;
using hapticwall::testing::move_handle;
using hapticwall::testing::scene_of;
using Choice = hapticwall::testing::EstimatorChoice;

// ---- the table ----

struct Row {
  double mass_kg;
  Choice estimator;
  std::array<double, 6> limits_n_per_m;
};
constexpr std::array kDampings{0.0, 2.0, 5.0, 10.0, 20.0, 50.0};
const Choice kLowPass{"low-pass", "cutoff_hz", 30.0};
const Choice kKalman{"kalman", "noise_ratio", 0.1};
const Choice kLeastSquares{"least-squares", "points", 8.0};

const std::vector<Row>& table() {
  static const std::vector<Row> kRows{
      {0.05, kDifference, {2006.69, 5786.3, 10904.5, 18097.7, 28217.8, 34641.8}},
      {0.05, kLowPass, {2006.69, 3130.93, 4028.19, 4841.68, 5496.47, 4889.22}},
      {0.05, kKalman, {2006.69, 4499.99, 6129.55, 6715.9, 5369.28, 0.0}},
      {0.2, kDifference, {2001.67, 5945.4, 11714.2, 20946.9, 38041.4, 79451.9}},
      {0.2, kLowPass, {2001.67, 4308.42, 6540.11, 9047.87, 12240.0, 16841.8}},
      // Our own numbers; AreThoseOfTheEigenvaluesWithADelay confirms the estimator.
      {0.05, kLeastSquares, {2006.69, 3546.22, 4151.61, 3826.04, 1734.94, 0.0}}};
  return kRows;
}

// Half of the sixth digit.
double last_digit(double value) {
  return value == 0.0 ? 0.0 : 0.5 * std::pow(10.0, std::floor(std::log10(value)) - 5.0);
}

// True if a motion of the running loop grows.
bool grows(const Scene& scene, double stiffness_n_per_m) {
  ActiveEstimator estimator;
  estimator.configure(chosen_estimator(scene.estimator), {1000.0, 0.0, &scene.estimator});
  constexpr int kTicks = 120000;
  constexpr int kWindow = 20000;
  double x_m = 1e-3;
  double v_m_per_s = 0.0;
  double before_m = x_m;
  double early_m = 0.0;
  double late_m = 0.0;
  for (int k = 0; k < kTicks; ++k) {
    const double velocity = estimator.velocity(x_m, x_m - before_m);
    before_m = x_m;
    move_handle(x_m, v_m_per_s, scene.x().device.mass_kg,
                stiffness_n_per_m * x_m + scene.x().walls[0].damping_n_s_per_m * velocity);
    if (std::abs(x_m) > 1e3) return true;
    if (k >= kWindow && k < 2 * kWindow) early_m = std::max(early_m, std::abs(x_m));
    if (k >= kTicks - kWindow) late_m = std::max(late_m, std::abs(x_m));
  }
  return late_m > early_m;
}

TEST(EstimatorLimits, AreThoseOfTheTable) {
  for (const Row& row : table()) {
    for (std::size_t i = 0; i < kDampings.size(); ++i) {
      const auto limit = exact_stable_limit(scene_of(row.estimator, row.mass_kg, kDampings.at(i)));
      const double expected = row.limits_n_per_m.at(i);
      ASSERT_TRUE(limit);
      EXPECT_NEAR(*limit, expected, 1e-6 * expected + last_digit(expected))
          << row.estimator.name << ", m " << row.mass_kg << ", B " << kDampings.at(i);
    }
  }
}

TEST(EstimatorLimits, PartTheLoopsThatDecayFromThoseThatGrow) {
  for (const Row& row : table()) {
    for (std::size_t i = 0; i < kDampings.size(); ++i) {
      const Scene scene = scene_of(row.estimator, row.mass_kg, kDampings.at(i));
      const double limit = exact_stable_limit(scene).value();
      const std::string name = row.estimator.name + ", B " + std::to_string(kDampings.at(i));
      if (limit == 0.0) {
        EXPECT_TRUE(grows(scene, 1.0)) << name;
        continue;
      }
      double low = 0.9 * limit;
      double high = 1.1 * limit;
      ASSERT_FALSE(grows(scene, low)) << name;
      ASSERT_TRUE(grows(scene, high)) << name;
      while (high - low > 2e-7 * limit) {
        const double middle = 0.5 * (low + high);
        (grows(scene, middle) ? high : low) = middle;
      }
      EXPECT_NEAR(low / limit, 1.0, 1e-6) << name;
    }
  }
}

// ---- the second derivation ----

using Real = long double;
using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// Gains of the steady filter by bisection of their two equations: α² + αβ + β²/6 = 2β and β² =
// λ(1 - α).
std::pair<Real, Real> kalman_gains(Real ratio) {
  Real low = 0;
  Real high = 1;
  const auto beta = [&](Real alpha) { return std::sqrt(ratio * (1 - alpha)); };
  for (int i = 0; i < 200; ++i) {
    const Real a = (low + high) / 2;
    (a * a + a * beta(a) + beta(a) * beta(a) / 6 < 2 * beta(a) ? low : high) = a;
  }
  return {low, beta(low)};
}

// The loop in positions and SI units. State: x, v, two numbers of the estimator, the earlier
// positions, and the forces on their way.
struct Loop {
  const Choice& estimator;
  const Scene& scene;
  Real stiffness_n_per_m;

  [[nodiscard]] int delay() const { return scene.x().device.delay_ticks.value_or(0); }
  [[nodiscard]] int points() const {
    return estimator.name == "least-squares" ? static_cast<int>(estimator.value) : 2;
  }
  [[nodiscard]] int size() const { return 4 + points() - 1 + delay(); }

  // Estimate of the velocity from x and the earlier positions; changes the estimator's numbers.
  Real estimate(Column& state) const {
    const Real t = Real(1) / 1000;
    if (estimator.name == "low-pass") {
      const Real pole = std::exp(-2 * std::numbers::pi_v<Real> * Real(estimator.value) * t);
      return state[2] = pole * state[2] + (1 - pole) * (state[0] - state[4]) / t;
    }
    if (estimator.name == "kalman") {
      const Real predicted = state[2] + t * state[3];
      const Real surprise = state[0] - predicted;
      const auto [alpha, beta] = kalman_gains(estimator.value);
      state[2] = predicted + alpha * surprise;
      return state[3] += beta / t * surprise;
    }
    const Real n = points();
    Real sum = (n - 1) / 2 * state[0];
    for (int i = 1; i < points(); ++i) sum += ((n - 1) / 2 - i) * state[3 + i];
    return 12 * sum / (n * (n * n - 1) * t);
  }
  [[nodiscard]] Column after_a_tick(Column state) const {
    const Real velocity = estimate(state);
    if (estimator.name != "kalman") state[3] = 0;  // an unused number would stay as it is
    if (estimator.name != "kalman" && estimator.name != "low-pass") state[2] = 0;
    const int first = 4;
    for (int i = points() - 2; i > 0; --i) state[first + i] = state[first + i - 1];
    state[first] = state[0];
    Real force =
        stiffness_n_per_m * state[0] + Real(scene.x().walls[0].damping_n_s_per_m) * velocity;
    for (int i = 0; i < delay(); ++i) std::swap(force, state[first + points() - 1 + i]);
    move_handle(state[0], state[1], scene.x().device.mass_kg, force);
    return state;
  }
  [[nodiscard]] Real growth() const {
    Column unit = Column::Ones(size());
    unit[1] = unit[3] = 1e3L;
    if (estimator.name == "low-pass") unit[2] = 1e3L;
    for (int i = 0; i < delay(); ++i)
      unit[4 + points() - 1 + i] = Real(scene.x().device.mass_kg) * 1e6L;
    Matrix matrix(size(), size());
    for (int i = 0; i < size(); ++i)
      matrix.col(i) = after_a_tick(Column::Unit(size(), i) * unit[i]).cwiseQuotient(unit);
    return Eigen::EigenSolver<Matrix>(matrix, false).eigenvalues().cwiseAbs().maxCoeff();
  }
};

TEST(EstimatorLimits, AreThoseOfTheEigenvaluesWithADelay) {
  const std::vector<Choice> choices{kDifference,
                                    kLowPass,
                                    {"low-pass", "cutoff_hz", 300.0},
                                    kKalman,
                                    {"least-squares", "points", 3.0},
                                    {"least-squares", "points", 5.0},
                                    kLeastSquares,
                                    {"least-squares", "points", 16.0}};
  int compared = 0;
  for (const Choice& estimator : choices) {
    for (const int delay : {0, 1, 3}) {
      for (const double wall_damping : {0.0, 0.5, 2.0, 5.0, 15.0}) {
        const Scene scene = scene_of(estimator, 0.05, wall_damping, delay);
        const double limit = exact_stable_limit(scene).value();
        const std::string name = estimator.name + " " + std::to_string(estimator.value) + ", " +
                                 std::to_string(delay) + " ticks, B " +
                                 std::to_string(wall_damping);
        if (limit == 0.0) {
          EXPECT_GT((Loop{estimator, scene, 1.0L}.growth()), 1.0L) << name;
          continue;
        }
        ++compared;
        for (const double part : {0.01, 0.1, 0.5, 0.9, 1.0 - 1e-8})
          EXPECT_LT((Loop{estimator, scene, Real(part * limit)}.growth()), 1.0L) << name << part;
        EXPECT_GT((Loop{estimator, scene, Real((1.0 + 1e-8) * limit)}.growth()), 1.0L) << name;
      }
    }
  }
  EXPECT_GT(compared, 80);
}

TEST(EstimatorLimits, ExistForLinearEstimatorsOnly) {
  const std::vector<std::string> nonlinear{"foaw", "levant"};
  for (const std::string name :
       {"backward-difference", "low-pass", "least-squares", "kalman", "foaw", "levant"}) {
    const bool linear = std::ranges::find(nonlinear, name) == nonlinear.end();
    const Scene scene = scene_of({name, "", 0.0}, 0.05, 5.0);
    EXPECT_EQ(exact_stable_limit(scene).has_value(), linear) << name;
    const StabilityBounds bounds = stability_bounds(scene, scene.x().walls[0], {});
    EXPECT_EQ(bounds.stable_n_per_m.has_value(), linear) << name;
    EXPECT_EQ(bounds.passive_n_per_m.has_value(), name == "backward-difference") << name;
    EXPECT_EQ(bounds.rule_n_per_m.has_value(), name == "backward-difference") << name;
  }
}

// Without a damper the estimate acts on nothing.
TEST(EstimatorLimits, WithoutADamperAreThatOfTheDifference) {
  const double limit = exact_stable_limit(scene_of(kDifference, 0.05, 0.0)).value();
  for (const Choice& estimator : {kLowPass, kKalman, Choice{"least-squares", "points", 12.0}}) {
    EXPECT_NEAR(exact_stable_limit(scene_of(estimator, 0.05, 0.0)).value(), limit, 1e-8 * limit)
        << estimator.name;
  }
}

}  // namespace
}  // namespace hapticwall
