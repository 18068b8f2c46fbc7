#include "core/study/worst_hand/damping_criterion.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/estimator/estimator.h"
#include "core/plant/plant_parameters.h"
#include "core/study/pulse_transfer.h"
#include "core/study/stable_stiffness.h"

namespace hapticwall::worst_hand {
namespace {

using Complex = std::complex<double>;
// Coefficients of powers of w = z - 1, the low ones first.
using Polynomial = std::vector<double>;

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial all(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) all[i + j] += a[i] * b[j];
  }
  return all;
}

Complex value_at(const Polynomial& polynomial, Complex w) {
  Complex value = 0.0;
  for (std::size_t i = polynomial.size(); i-- > 0;) value = value * w + polynomial[i];
  return value;
}

// From the measured position to the force that pushes out, N/m.
struct Transfer {
  Polynomial numerator;
  Polynomial denominator;
};

// (1 + w) times a spring and a damper on the backward difference.
Polynomial spring_and_damper(double stiffness, double damping, double period_s) {
  return {stiffness, stiffness + damping / period_s};
}

Transfer transfer_of(const Scene& scene, std::string_view algorithm) {
  const WallSettings& wall = scene.x().walls.front();
  const double period_s = scene.sampling.period_s();
  const Polynomial z{1.0, 1.0};
  Polynomial of_wall = spring_and_damper(wall.stiffness_n_per_m, wall.damping_n_s_per_m, period_s);
  if (algorithm == "none") return {of_wall, z};
  if (algorithm == "half-sample") {
    of_wall[1] += 0.5 * wall.stiffness_n_per_m;
    return {of_wall, z};
  }
  AlgorithmContext context;
  context.period_s = period_s;
  context.device_damping_n_s_per_m = scene.x().device.damping_n_s_per_m;
  context.settings = &scene.algorithm;
  const double damping = context.value_or("coupling_damping_n_s_per_m", 0.0);
  const double stiffness =
      context.value_or("coupling_stiffness_n_per_m",
                       std::max(0.0, 2.0 * (believed_damping(context) - damping) / period_s));
  const Polynomial coupling = spring_and_damper(stiffness, damping, period_s);
  return {product(of_wall, coupling),
          product(z, {of_wall[0] + coupling[0], of_wall[1] + coupling[1]})};
}

// The damping that the criterion asks for at this angle.
double needed_at(const Transfer& transfer, double period_s, double delay_ticks, double angle) {
  const Complex w = std::polar(1.0, angle) - 1.0;
  const Complex force = value_at(transfer.numerator, w) / value_at(transfer.denominator, w);
  // 1 - e^(-jθ) = 2j sin(θ/2) e^(-jθ/2), and 2 (1 - cos θ) = 4 sin²(θ/2).
  const Complex turned = force * std::polar(1.0, -angle * (0.5 + delay_ticks));
  return -period_s * turned.imag() / (2.0 * std::sin(0.5 * angle));
}

double needed_damping(const Transfer& transfer, double period_s, double delay_ticks) {
  constexpr double kPi = std::numbers::pi;
  constexpr int kAngles = 20'000;
  constexpr double kFirst = 1e-5;  // the limit at 0 to ten digits
  const auto needed = [&](double angle) {
    return needed_at(transfer, period_s, delay_ticks, std::clamp(angle, kFirst, kPi));
  };
  double best_angle = kFirst;
  for (int i = 1; i <= kAngles; ++i) {
    const double angle = kPi * i / kAngles;
    if (needed(angle) > needed(best_angle)) best_angle = angle;
  }
  for (double step = kPi / kAngles; step > 1e-9; step *= 0.5) {
    for (const double next : {best_angle - step, best_angle + step}) {
      if (needed(next) > needed(best_angle)) best_angle = std::clamp(next, kFirst, kPi);
    }
  }
  return needed(best_angle);
}

// True if a root of the polynomial lies outside of the unit circle of z. A root within `margin` of
// it counts as one on it.
bool has_unstable_root(Polynomial polynomial, double margin) {
  while (polynomial.back() == 0.0) polynomial.pop_back();
  const auto size = static_cast<Eigen::Index>(polynomial.size() - 1);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(size, size);
  companion.diagonal(-1).setOnes();
  for (Eigen::Index i = 0; i < size; ++i)
    companion(i, size - 1) = -polynomial[static_cast<std::size_t>(i)] / polynomial.back();
  const Eigen::VectorXcd roots = companion.eigenvalues();
  // |1 + w|² - 1, without the rounding of a number near 1.
  return (2.0 * roots.array().real() + roots.array().abs2() > 2.0 * margin).any();
}

// The handle with what holds it, as a mass and a spring to ground.
struct Held {
  double mass_kg;
  double spring_n_per_m;
};

bool is_unstable(const Scene& scene, const Transfer& transfer, const Held& held, double margin) {
  const DeviceSettings& device = scene.x().device;
  SampledLoop loop;
  loop.plant.mass_kg = held.mass_kg;
  loop.plant.damping_n_s_per_m = device.damping_n_s_per_m;
  loop.plant.hand_stiffness_n_per_m = held.spring_n_per_m;
  loop.period_s = scene.sampling.period_s();
  const PulseTransfer plant = pulse_transfer(loop);
  const auto states = static_cast<std::ptrdiff_t>(plant.states);
  Polynomial open(plant.denominator.begin(), plant.denominator.begin() + states + 1);
  open = product(open, transfer.denominator);
  for (int i = 0; i < device.delay_ticks.value_or(0); ++i) open = product(open, {1.0, 1.0});
  const Polynomial closed =
      product({plant.numerator.begin(), plant.numerator.begin() + states}, transfer.numerator);
  const double scale = loop.period_s * loop.period_s / held.mass_kg;
  for (std::size_t i = 0; i < closed.size(); ++i) open[i] += scale * closed[i];
  return has_unstable_root(open, margin);
}

std::optional<SpringRange> unstable_springs(const Scene& scene, const Transfer& transfer) {
  constexpr int kSprings = 400;
  constexpr double kMargin = 1e-11;
  const double rate_hz = scene.sampling.rate_hz;
  const double stiffest =
      scene.x().device.mass_kg * std::numbers::pi * std::numbers::pi * rate_hz * rate_hz;
  const auto is_unstable_at = [&](double spring) {
    return is_unstable(scene, transfer, {scene.x().device.mass_kg, spring}, kMargin);
  };
  // The spring between these two at which the answer changes.
  const auto change = [&](double low, double high) {
    const bool at_low = is_unstable_at(low);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (is_unstable_at(middle) == at_low ? low : high) = middle;
    }
    return high;
  };
  std::optional<SpringRange> range;
  double last = 0.0;
  if (is_unstable_at(0.0)) range = SpringRange{};
  for (int i = 1; i <= kSprings; ++i) {
    const double spring = stiffest * i / kSprings;
    const bool unstable = is_unstable_at(spring);
    if (!range && unstable) range = SpringRange{change(last, spring), {}};
    if (range && !unstable) {
      range->to_n_per_m = change(last, spring);
      return range;
    }
    last = spring;
  }
  return range;
}

std::optional<double> critical_mass(const Scene& scene, const Transfer& transfer) {
  constexpr double kHeaviest = 100.0;
  constexpr double kLightest = 1e-6;
  constexpr double kRatio = 0.9;     // of the scan
  constexpr double kMargin = 1e-13;  // a heavy mass grows slowly
  const auto is_unstable_at = [&](double mass) {
    return is_unstable(scene, transfer, {mass, 0.0}, kMargin);
  };
  double unstable = kHeaviest;
  if (!is_unstable_at(unstable)) return std::nullopt;
  double stable = kRatio * unstable;
  while (stable > kLightest && is_unstable_at(stable)) {
    unstable = stable;
    stable *= kRatio;
  }
  if (stable <= kLightest) return 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (is_unstable_at(middle) ? unstable : stable) = middle;
  }
  return unstable;
}

}  // namespace

std::optional<DampingCriterion> damping_criterion(const Scene& scene) {
  const DeviceSettings& device = scene.x().device;
  const std::string_view name = algorithms()[scene.algorithm.index].name;
  const bool linear_algorithm =
      (name == "none" || name == "virtual-coupling" || name == "half-sample") &&
      !has_follower(scene.algorithm);
  const bool linear_device =
      device.friction_n.value_or(0.0) == 0.0 && device.static_friction_n.value_or(0.0) == 0.0 &&
      device.encoder_m.value_or(0.0) == 0.0 && device.force_resolution_n.value_or(0.0) == 0.0 &&
      device.amplifier_time_constant_s.value_or(0.0) == 0.0;
  const bool ideal_loop =
      scene.sampling.render_every.value_or(1) == 1 && !scene.sampling.at_random();
  const bool difference = chosen_estimator(scene.estimator) == nullptr;
  if (!linear_algorithm || !linear_device || !ideal_loop || !difference ||
      scene.x().walls.size() != 1)
    return std::nullopt;
  const Transfer transfer = transfer_of(scene, name);
  return DampingCriterion{
      needed_damping(transfer, scene.sampling.period_s(), device.delay_ticks.value_or(0)),
      unstable_springs(scene, transfer), critical_mass(scene, transfer)};
}

}  // namespace hapticwall::worst_hand
