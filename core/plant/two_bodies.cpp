#include "core/plant/two_bodies.h"

#include "core/plant/propagator.h"

namespace hapticwall {
namespace {

enum Index : Eigen::Index { kU1, kA1, kU2, kA2, kInt1, kInt2, kDouble, kSize };

double stretch_within_reach(double rate_per_s, double period_s) {
  double stretch_s = period_s;
  while (rate_per_s * stretch_s > kTaylorReach) stretch_s *= 0.5;
  return stretch_s;
}

// State (u1, a1 T, u2, a2 T, ∫u1/T, ∫u2/T, ∫∫(u2 - u1)/T²), time in ticks.
SetupMatrix make_generator(const TwoBodyParameters& p, long double t) {
  const long double m1 = p.mass_kg;
  const long double m2 = p.hand_mass_kg;
  const long double kg = static_cast<long double>(p.grip_stiffness_n_per_m) * t * t;
  const long double bg = static_cast<long double>(p.grip_damping_n_s_per_m) * t;
  const long double kh = static_cast<long double>(p.hand_stiffness_n_per_m) * t * t;
  const long double bh = static_cast<long double>(p.hand_damping_n_s_per_m) * t;
  const long double b = static_cast<long double>(p.damping_n_s_per_m) * t;
  SetupMatrix a = SetupMatrix::Zero(kSize, kSize);
  a(kU1, kA1) = 1.0L;
  a(kA1, kU1) = -kg / m1;
  a(kA1, kA1) = -(bg + b) / m1;
  a(kA1, kU2) = kg / m1;
  a(kA1, kA2) = bg / m1;
  a(kU2, kA2) = 1.0L;
  a(kA2, kU1) = kg / m2;
  a(kA2, kA1) = bg / m2;
  a(kA2, kU2) = -(kg + kh) / m2;
  a(kA2, kA2) = -(bg + bh) / m2;
  a(kInt1, kU1) = 1.0L;
  a(kInt2, kU2) = 1.0L;
  a(kDouble, kInt1) = -1.0L;
  a(kDouble, kInt2) = 1.0L;
  return a;
}

// The weight of ∫(k_g δ + b_g δ') u1 in units of the scaled state: δ = T(∫u2/T - ∫u1/T).
SetupMatrix grip_work_weight(const TwoBodyParameters& p, long double t) {
  const long double kg = static_cast<long double>(p.grip_stiffness_n_per_m) * t;
  const long double bg = p.grip_damping_n_s_per_m;
  SetupMatrix s = SetupMatrix::Zero(kSize, kSize);
  s(kU1, kInt2) = s(kInt2, kU1) = 0.5L * kg;
  s(kU1, kInt1) = s(kInt1, kU1) = -0.5L * kg;
  s(kU1, kU2) = s(kU2, kU1) = 0.5L * bg;
  s(kU1, kU1) = -bg;
  return s;
}

constexpr std::array<Eigen::Index, 4> kStart{kU1, kA1, kU2, kA2};

// Row `output` of the increment as it acts on (u1, a1, u2, a2) in SI units.
std::array<double, 4> row_of(const SetupMatrix& increment, Eigen::Index output, long double scale,
                             long double t) {
  std::array<double, 4> row{};
  for (std::size_t i = 0; i < row.size(); ++i) {
    const long double unit = i % 2 == 1 ? t : 1.0L;
    row[i] = static_cast<double>(increment(output, kStart[i]) * scale * unit);
  }
  return row;
}

std::array<double, 10> form_of(const SetupMatrix& integral, long double t) {
  std::array<double, 10> form{};
  std::size_t k = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i; j < 4; ++j) {
      const long double unit = (i % 2 == 1 ? t : 1.0L) * (j % 2 == 1 ? t : 1.0L) * t;
      const long double twice = i == j ? 1.0L : 2.0L;
      form[k++] = static_cast<double>(integral(kStart[i], kStart[j]) * unit * twice);
    }
  }
  return form;
}

}  // namespace

TwoBodies::TwoBodies(const TwoBodyParameters& parameters, double period_s)
    : parameters_(parameters),
      period_s_(period_s),
      half_mass_kg_(0.5 * parameters.mass_kg),
      per_mass_(1.0 / parameters.mass_kg),
      per_hand_mass_(1.0 / parameters.hand_mass_kg) {
  make_rows();
  const double handle_stiffness = 2.0 * parameters.grip_stiffness_n_per_m / parameters.mass_kg;
  const double hand_stiffness =
      (2.0 * parameters.grip_stiffness_n_per_m + parameters.hand_stiffness_n_per_m) /
      parameters.hand_mass_kg;
  const double handle_damping =
      (2.0 * parameters.grip_damping_n_s_per_m + parameters.damping_n_s_per_m) / parameters.mass_kg;
  const double hand_damping =
      (2.0 * parameters.grip_damping_n_s_per_m + parameters.hand_damping_n_s_per_m) /
      parameters.hand_mass_kg;
  natural_rate_per_s_ = std::sqrt(std::max(handle_stiffness, hand_stiffness));
  // Row sums of the generator in the scaled state (u rate, a) are at most `rate`.
  const double rate = natural_rate_per_s_ + std::max(handle_damping, hand_damping);
  longest_stretch_s_ = stretch_within_reach(rate, period_s);
  jerk_bound_ = 0.5 * period_s * period_s * rate * std::exp(rate * period_s);
}

void TwoBodies::make_rows() {
  const long double t = period_s_;
  SetupMatrix square = SetupMatrix::Zero(kSize, kSize);
  square(kU1, kU1) = 1.0L;
  const Propagator propagator = make_propagator(
      make_generator(parameters_, t), std::array{square, grip_work_weight(parameters_, t)});
  const SetupMatrix& e = propagator.increment;
  rows_.velocity = row_of(e, kU1, 1.0L, t);
  rows_.hand_velocity = row_of(e, kU2, 1.0L, t);
  rows_.integral = row_of(e, kInt1, t, t);
  rows_.hand_integral = row_of(e, kInt2, t, t);
  rows_.difference_double_integral = row_of(e, kDouble, t * t, t);
  rows_.square = form_of(propagator.integrals[0], t);
  rows_.grip_work = form_of(propagator.integrals[1], t);
}

TwoBodies::Slide TwoBodies::slide(const State& state, double load_n, const HandDrive& drive,
                                  double duration_s, double minimum_acceleration_sign) const {
  const TwoBodyParameters& p = parameters_;
  const double h = duration_s;
  Relative w = relative_state(state, load_n, drive);
  if (minimum_acceleration_sign * w[1] < 0.0) w[1] = 0.0;
  Slide slide;
  slide.duration_s = h;
  auto& u1 = slide.relative_velocity.coefficient;
  auto& u2 = slide.hand_relative_velocity.coefficient;
  u1[0] = w[0];
  u1[1] = w[1] * h;
  u2[0] = w[2];
  u2[1] = w[3] * h;
  for (std::size_t j = 0; j + 2 < u1.size(); ++j) {
    const double order = static_cast<double>(j + 1);
    const double scale = 1.0 / (order * (order + 1.0));
    const double spring = h * h * p.grip_stiffness_n_per_m * (u2[j] - u1[j]) +
                          h * order * p.grip_damping_n_s_per_m * (u2[j + 1] - u1[j + 1]);
    u1[j + 2] = scale * (spring - h * order * p.damping_n_s_per_m * u1[j + 1]) / p.mass_kg;
    u2[j + 2] = scale *
                (-h * h * p.hand_stiffness_n_per_m * u2[j] -
                 h * order * p.hand_damping_n_s_per_m * u2[j + 1] - spring) /
                p.hand_mass_kg;
  }
  slide.velocity = slide.relative_velocity;
  slide.velocity.coefficient[0] = state.velocity_m_per_s;
  for (std::size_t j = 0; j < u1.size(); ++j) {
    slide.velocity_difference.coefficient[j] = u2[j] - u1[j];
  }
  return slide;
}

MotionIncrement TwoBodies::advance(State& state, const Slide& slide, const HandDrive& drive,
                                   double theta) const {
  const double h = slide.duration_s;
  const double stretch_m = state.hand_position_m - state.position_m;
  MotionIncrement increment;
  increment.displacement_m = h * slide.velocity.integral_to(theta);
  increment.velocity_squared = h * product_integral(slide.velocity, slide.velocity, theta);
  increment.hand_work_j =
      parameters_.grip_stiffness_n_per_m *
          (stretch_m * increment.displacement_m +
           h * h * lagged_product_integral(slide.velocity, slide.velocity_difference, theta)) +
      parameters_.grip_damping_n_s_per_m * h *
          product_integral(slide.velocity_difference, slide.velocity, theta);
  state.position_m += increment.displacement_m;
  state.hand_position_m +=
      drive.velocity_m_per_s * (h * theta) + h * slide.hand_relative_velocity.integral_to(theta);
  state.velocity_m_per_s = slide.velocity.at(theta);
  state.hand_velocity_m_per_s = drive.velocity_m_per_s + slide.hand_relative_velocity.at(theta);
  return increment;
}

TwoBodies::Stick TwoBodies::stick(const State& state, double force_n, const HandDrive& drive,
                                  double duration_s) const {
  const TwoBodyParameters& p = parameters_;
  const double h = duration_s;
  Stick stick;
  stick.duration_s = h;
  auto& w = stick.hand_velocity.coefficient;
  w[0] = state.hand_velocity_m_per_s;
  w[1] = hand_acceleration(state, drive) * h;
  const double stiffness =
      h * h * (p.hand_stiffness_n_per_m + p.grip_stiffness_n_per_m) / p.hand_mass_kg;
  const double damping = h * (p.hand_damping_n_s_per_m + p.grip_damping_n_s_per_m) / p.hand_mass_kg;
  const double drive_term =
      h * h * p.hand_stiffness_n_per_m * drive.velocity_m_per_s / p.hand_mass_kg;
  for (std::size_t j = 0; j + 2 < w.size(); ++j) {
    const double order = static_cast<double>(j + 1);
    const double inhomogeneity = j == 0 ? drive_term : 0.0;
    w[j + 2] =
        (inhomogeneity - stiffness * w[j] - damping * order * w[j + 1]) / (order * (order + 1.0));
  }
  auto& net = stick.net_force.coefficient;
  net[0] = grip_force(state) - force_n;
  for (std::size_t j = 1; j < net.size(); ++j) {
    net[j] = p.grip_stiffness_n_per_m * h * w[j - 1] / static_cast<double>(j) +
             p.grip_damping_n_s_per_m * w[j];
  }
  return stick;
}

void TwoBodies::advance(State& state, const Stick& stick, double theta) {
  state.hand_position_m += stick.duration_s * stick.hand_velocity.integral_to(theta);
  state.hand_velocity_m_per_s = stick.hand_velocity.at(theta);
}

}  // namespace hapticwall
