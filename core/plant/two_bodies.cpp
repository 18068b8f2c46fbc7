#include "core/plant/two_bodies.h"

#include "core/plant/ladder.h"

namespace hapticwall {
namespace {

enum Index : Eigen::Index { kU1, kA1, kU2, kA2, kInt1, kInt2, kDouble, kSize };

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
  const TwoBodyParameters& p = parameters;
  const double stiffness =
      std::max(2.0 * p.grip_stiffness_n_per_m * per_mass_,
               (2.0 * p.grip_stiffness_n_per_m + p.hand_stiffness_n_per_m) * per_hand_mass_);
  const double damping =
      std::max((2.0 * p.grip_damping_n_s_per_m + p.damping_n_s_per_m) * per_mass_,
               (2.0 * p.grip_damping_n_s_per_m + p.hand_damping_n_s_per_m) * per_hand_mass_);
  // |m a'| = |k_g (u_h - u) + b_g (a_h - a) - b a|, each term at most this much times sqrt(2E).
  jerk_per_root_energy_ =
      per_mass_ * (std::sqrt(p.grip_stiffness_n_per_m) +
                   p.grip_damping_n_s_per_m * (std::sqrt(per_hand_mass_) + std::sqrt(per_mass_)) +
                   p.damping_n_s_per_m * std::sqrt(per_mass_));
  const int halvings = halvings_within_reach(std::sqrt(stiffness) + damping, period_s);
  make_levels(halvings);
  make_stick_levels(halvings);
}

void TwoBodies::make_levels(int halvings) {
  const long double t = period_s_;
  SetupMatrix square = SetupMatrix::Zero(kSize, kSize);
  square(kU1, kU1) = 1.0L;
  double duration_s = period_s_;
  for (const Propagator& propagator :
       make_propagators(make_generator(parameters_, t),
                        std::array{square, grip_work_weight(parameters_, t)}, halvings)) {
    levels_.push_back(make_rows(propagator, duration_s));
    duration_s *= 0.5;
  }
}

TwoBodies::Rows TwoBodies::make_rows(const Propagator& propagator, double duration_s) const {
  const long double t = period_s_;
  const SetupMatrix& e = propagator.increment;
  Rows rows;
  rows.duration_s = duration_s;
  rows.velocity = row_of(e, kU1, 1.0L, t);
  rows.hand_velocity = row_of(e, kU2, 1.0L, t);
  rows.integral = row_of(e, kInt1, t, t);
  rows.hand_integral = row_of(e, kInt2, t, t);
  rows.difference_double_integral = row_of(e, kDouble, t * t, t);
  rows.square = form_of(propagator.integrals[0], t);
  rows.grip_work = form_of(propagator.integrals[1], t);
  return rows;
}

// m_h w'' = -(k_h + k_g)(w - w_end) - (b_h + b_g) w', state (w - w_end, w'T, ∫(w - w_end)/T).
void TwoBodies::make_stick_levels(int halvings) {
  const TwoBodyParameters& p = parameters_;
  const long double t = period_s_;
  const long double m = p.hand_mass_kg;
  SetupMatrix generator = SetupMatrix::Zero(3, 3);
  generator(0, 1) = 1.0L;
  generator(1, 0) = -(static_cast<long double>(p.hand_stiffness_n_per_m) +
                      static_cast<long double>(p.grip_stiffness_n_per_m)) /
                    m * t * t;
  generator(1, 1) = -(static_cast<long double>(p.hand_damping_n_s_per_m) +
                      static_cast<long double>(p.grip_damping_n_s_per_m)) /
                    m * t;
  generator(2, 0) = 1.0L;
  for (const Propagator& propagator : make_propagators(generator, {}, halvings)) {
    const SetupMatrix& e = propagator.increment;
    stick_levels_.push_back(
        {{static_cast<double>(e(0, 0)), static_cast<double>(e(0, 1) * t)},
         {static_cast<double>(e(2, 0) * t), static_cast<double>(e(2, 1) * t * t)}});
  }
}

// The net force changes at the rate k_g w + b_g w', and ½m_h w'² + ½(k_h + k_g)(w - w_end)² never
// grows: that bounds both.
bool TwoBodies::surely_sticks(int level, const State& state, double force_n, const HandDrive& drive,
                              double friction_n) const {
  const TwoBodyParameters& p = parameters_;
  const double h = levels_[static_cast<std::size_t>(level)].duration_s;
  const double stiffness = p.hand_stiffness_n_per_m + p.grip_stiffness_n_per_m;
  const double end = settling_velocity(drive);
  const double u = state.hand_velocity_m_per_s - end;
  const double a = hand_acceleration(state, drive);
  const double root_energy = std::sqrt(p.hand_mass_kg * a * a + stiffness * u * u);
  const double most_a = root_energy * std::sqrt(per_hand_mass_);
  double most_w = std::abs(state.hand_velocity_m_per_s) + h * most_a;
  if (stiffness > 0.0) {
    most_w = std::min(most_w, std::abs(end) + root_energy / std::sqrt(stiffness));
  }
  const double change_n =
      h * (p.grip_stiffness_n_per_m * most_w + p.grip_damping_n_s_per_m * most_a);
  return std::abs(grip_force(state) - force_n) + change_n < friction_n;
}

void TwoBodies::advance_stick_level(int level, State& state, const HandDrive& drive) const {
  const auto index = static_cast<std::size_t>(level);
  const StickRows& rows = stick_levels_[index];
  const double end = settling_velocity(drive);
  const double u = state.hand_velocity_m_per_s - end;
  const double a = hand_acceleration(state, drive);
  state.hand_position_m +=
      end * levels_[index].duration_s + (rows.integral[0] * u + rows.integral[1] * a);
  state.hand_velocity_m_per_s += rows.velocity[0] * u + rows.velocity[1] * a;
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
