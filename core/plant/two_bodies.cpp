#include "core/plant/two_bodies.h"

#include "core/plant/ladder.h"
#include "core/plant/propagator.h"

namespace hapticwall {
namespace {

// State (u1, a1 T, u2, a2 T, [eT/m,] ∫u1/T, ∫u2/T, ∫∫(u2 - u1)/T²), time in ticks.
template <bool kLag>
struct Generator {
  static constexpr int kU1 = 0;
  static constexpr int kA1 = 1;
  static constexpr int kU2 = 2;
  static constexpr int kA2 = 3;
  static constexpr int kE = 4;  // with a lag only
  static constexpr int kIntegral1 = kLag ? 5 : 4;
  static constexpr int kIntegral2 = kIntegral1 + 1;
  static constexpr int kDouble = kIntegral1 + 2;
  static constexpr int kSize = kDouble + 1;
  using Matrix = SetupMatrix<kSize>;

  static Matrix make(const TwoBodyParameters& p, long double t) {
    const long double m1 = p.mass_kg;
    const long double m2 = p.hand_mass_kg;
    const long double kg = static_cast<long double>(p.grip_stiffness_n_per_m) * t * t;
    const long double bg = static_cast<long double>(p.grip_damping_n_s_per_m) * t;
    const long double kh = static_cast<long double>(p.hand_stiffness_n_per_m) * t * t;
    const long double bh = static_cast<long double>(p.hand_damping_n_s_per_m) * t;
    const long double b = static_cast<long double>(p.damping_n_s_per_m) * t;
    Matrix a = Matrix::Zero();
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
    a(kIntegral1, kU1) = 1.0L;
    a(kIntegral2, kU2) = 1.0L;
    a(kDouble, kIntegral1) = -1.0L;
    a(kDouble, kIntegral2) = 1.0L;
    if constexpr (kLag) {
      a(kA1, kE) = t / static_cast<long double>(p.time_constant_s);
      a(kE, kE) = -a(kA1, kE);
    }
    return a;
  }

  // The weight of ∫(k_g δ + b_g δ') u1 in units of the scaled state: δ = T(∫u2/T - ∫u1/T).
  static Matrix grip_work(const TwoBodyParameters& p, long double t) {
    const long double kg = static_cast<long double>(p.grip_stiffness_n_per_m) * t;
    const long double bg = p.grip_damping_n_s_per_m;
    Matrix s = Matrix::Zero();
    s(kU1, kIntegral2) = s(kIntegral2, kU1) = 0.5L * kg;
    s(kU1, kIntegral1) = s(kIntegral1, kU1) = -0.5L * kg;
    s(kU1, kU2) = s(kU2, kU1) = 0.5L * bg;
    s(kU1, kU1) = -bg;
    return s;
  }

  static auto weights(const TwoBodyParameters& p, long double t) {
    Matrix square = Matrix::Zero();
    square(kU1, kU1) = 1.0L;
    if constexpr (kLag) {
      Matrix excess_times_u = Matrix::Zero();
      excess_times_u(kE, kU1) = excess_times_u(kU1, kE) = 0.5L;
      return std::array{square, grip_work(p, t), excess_times_u};
    } else {
      return std::array{square, grip_work(p, t)};
    }
  }
};

}  // namespace

template <typename Real, bool kLag>
BasicTwoBodies<Real, kLag>::BasicTwoBodies(const TwoBodyParameters& p, double period_s)
    : parameters_{p.mass_kg,
                  p.damping_n_s_per_m,
                  p.hand_mass_kg,
                  p.hand_stiffness_n_per_m,
                  p.hand_damping_n_s_per_m,
                  p.grip_stiffness_n_per_m,
                  p.grip_damping_n_s_per_m},
      lag_(p.time_constant_s),
      period_s_(period_s),
      half_mass_kg_(parameters_.mass_kg / 2),
      per_mass_(1 / parameters_.mass_kg),
      per_hand_mass_(1 / parameters_.hand_mass_kg) {
  const Parameters& q = parameters_;
  const Real stiffness =
      std::max(2 * q.grip_stiffness_n_per_m * per_mass_,
               (2 * q.grip_stiffness_n_per_m + q.hand_stiffness_n_per_m) * per_hand_mass_);
  const Real damping =
      std::max((2 * q.grip_damping_n_s_per_m + q.damping_n_s_per_m) * per_mass_,
               (2 * q.grip_damping_n_s_per_m + q.hand_damping_n_s_per_m) * per_hand_mass_);
  // |m a'| = |k_g (u_h - u) + b_g (a_h - a) - b a|, each term at most this much times sqrt(2E).
  jerk_per_root_energy_ =
      per_mass_ * (std::sqrt(q.grip_stiffness_n_per_m) +
                   q.grip_damping_n_s_per_m * (std::sqrt(per_hand_mass_) + std::sqrt(per_mass_)) +
                   q.damping_n_s_per_m * std::sqrt(per_mass_));
  Real rate_per_s = std::sqrt(stiffness) + damping;
  if constexpr (kLag) rate_per_s += lag_.rate_per_s;
  const int halvings = halvings_within_reach(static_cast<double>(rate_per_s), period_s);
  make_levels(p, halvings);
  make_stick_levels(p, halvings);
}

template <typename Real, bool kLag>
void BasicTwoBodies<Real, kLag>::make_levels(const TwoBodyParameters& p, int halvings) {
  using G = Generator<kLag>;
  const long double t = period_s_;
  // What a unit of u, a and e is in the scaled state.
  std::array<long double, kStates> unit{1.0L, t, 1.0L, t};
  if constexpr (kLag) unit[G::kE] = t / static_cast<long double>(p.mass_kg);
  const auto row = [&](const typename G::Matrix& e, int output, long double scale) {
    Row numbers{};
    for (std::size_t i = 0; i < kStates; ++i) {
      numbers[i] = static_cast<Real>(e(output, static_cast<int>(i)) * scale * unit[i]);
    }
    return numbers;
  };
  const auto form = [&](const typename G::Matrix& g) {
    SymmetricForm numbers{};
    std::size_t k = 0;
    for (std::size_t i = 0; i < kStates; ++i) {
      for (std::size_t j = i; j < kStates; ++j) {
        const long double twice = i == j ? 1.0L : 2.0L;
        numbers[k++] = static_cast<Real>(g(static_cast<int>(i), static_cast<int>(j)) *
                                         (unit[i] * unit[j] * t) * twice);
      }
    }
    return numbers;
  };
  long double duration_s = t;
  for (const auto& propagator : make_propagators(G::make(p, t), G::weights(p, t), halvings)) {
    const auto& e = propagator.increment;
    Rows rows;
    rows.duration_s = static_cast<Real>(duration_s);
    rows.velocity = row(e, G::kU1, 1.0L);
    rows.hand_velocity = row(e, G::kU2, 1.0L);
    rows.integral = row(e, G::kIntegral1, t);
    rows.hand_integral = row(e, G::kIntegral2, t);
    rows.difference_double_integral = row(e, G::kDouble, t * t);
    rows.square = form(propagator.integrals[0]);
    rows.grip_work = form(propagator.integrals[1]);
    if constexpr (kLag) {
      rows.lag = {duration_s, static_cast<long double>(p.time_constant_s)};
      for (std::size_t i = 0; i < kStates; ++i) {
        const long double twice = i == G::kE ? 1.0L : 2.0L;
        rows.lag.cross[i] = static_cast<Real>(
            twice * propagator.integrals[2](G::kE, static_cast<int>(i)) * unit[i] * t);
      }
    }
    levels_.push_back(rows);
    duration_s *= 0.5L;
  }
}

// m_h w'' = -(k_h + k_g)(w - w_end) - (b_h + b_g) w', state (w - w_end, w'T, ∫(w - w_end)/T).
template <typename Real, bool kLag>
void BasicTwoBodies<Real, kLag>::make_stick_levels(const TwoBodyParameters& p, int halvings) {
  const long double t = period_s_;
  const long double m = p.hand_mass_kg;
  using Matrix = SetupMatrix<3>;
  Matrix generator = Matrix::Zero();
  generator(0, 1) = 1.0L;
  generator(1, 0) = -(static_cast<long double>(p.hand_stiffness_n_per_m) +
                      static_cast<long double>(p.grip_stiffness_n_per_m)) /
                    m * t * t;
  generator(1, 1) = -(static_cast<long double>(p.hand_damping_n_s_per_m) +
                      static_cast<long double>(p.grip_damping_n_s_per_m)) /
                    m * t;
  generator(2, 0) = 1.0L;
  for (const auto& propagator : make_propagators(generator, std::array<Matrix, 0>{}, halvings)) {
    const Matrix& e = propagator.increment;
    stick_levels_.push_back({{static_cast<Real>(e(0, 0)), static_cast<Real>(e(0, 1) * t)},
                             {static_cast<Real>(e(2, 0) * t), static_cast<Real>(e(2, 1) * t * t)}});
  }
}

// The net force changes at the rate k_g w + b_g w', and ½m_h w'² + ½(k_h + k_g)(w - w_end)² never
// grows: that bounds both. A lag's excess falls to a known rest.
template <typename Real, bool kLag>
bool BasicTwoBodies<Real, kLag>::surely_sticks(int level, const State& state, Real force_n,
                                               const BasicHandDrive<Real>& drive,
                                               Real friction_n) const {
  const Parameters& p = parameters_;
  const Rows& rows = this->level(level);
  const Real h = rows.duration_s;
  const Real stiffness = p.hand_stiffness_n_per_m + p.grip_stiffness_n_per_m;
  const Real end = settling_velocity(drive);
  const Real u = state.hand_velocity_m_per_s - end;
  const Real a = hand_acceleration(state, drive);
  const Real root_energy = std::sqrt(p.hand_mass_kg * a * a + stiffness * u * u);
  const Real most_a = root_energy * std::sqrt(per_hand_mass_);
  Real most_w = std::abs(state.hand_velocity_m_per_s) + h * most_a;
  if (stiffness > 0) {
    most_w = std::min(most_w, std::abs(end) + root_energy / std::sqrt(stiffness));
  }
  Real change_n = h * (p.grip_stiffness_n_per_m * most_w + p.grip_damping_n_s_per_m * most_a);
  Real net_n = grip_force(state) - force_n;
  if constexpr (kLag) {
    const Real excess_n = state.excess_n(force_n);
    net_n -= excess_n;
    change_n += rows.lag.settled_fraction * std::abs(excess_n);
  }
  return std::abs(net_n) + change_n < friction_n;
}

template <typename Real, bool kLag>
void BasicTwoBodies<Real, kLag>::advance_stick_level(int level, State& state, Real force_n,
                                                     const BasicHandDrive<Real>& drive) const {
  const Rows& rows = this->level(level);
  const StickRows& stick = stick_levels_[static_cast<std::size_t>(level)];
  const Real end = settling_velocity(drive);
  const Real u = state.hand_velocity_m_per_s - end;
  const Real a = hand_acceleration(state, drive);
  state.hand_position_m += end * rows.duration_s + (stick.integral[0] * u + stick.integral[1] * a);
  state.hand_velocity_m_per_s += stick.velocity[0] * u + stick.velocity[1] * a;
  if constexpr (kLag) {
    rows.lag.settle(state, force_n);
  } else {
    static_cast<void>(force_n);
  }
}

template <typename Real, bool kLag>
auto BasicTwoBodies<Real, kLag>::slide(const State& state, const Load<Real>& load,
                                       const BasicHandDrive<Real>& drive, Real duration_s,
                                       Real push) const -> Slide {
  const Parameters& p = parameters_;
  const Real h = duration_s;
  Row w = relative_state(state, load, drive);
  if (push * w[1] < 0) w[1] = 0;
  Slide slide;
  slide.duration_s = h;
  if constexpr (kLag) slide.lag = {w[4], load.force_n, h, lag_.rate_per_s};
  auto& u1 = slide.relative_velocity.coefficient;
  auto& u2 = slide.hand_relative_velocity.coefficient;
  u1[0] = w[0];
  u1[1] = w[1] * h;
  u2[0] = w[2];
  u2[1] = w[3] * h;
  for (std::size_t j = 0; j + 2 < u1.size(); ++j) {
    const Real order = static_cast<Real>(j + 1);
    const Real scale = 1 / (order * (order + 1));
    const Real spring = h * h * p.grip_stiffness_n_per_m * (u2[j] - u1[j]) +
                        h * order * p.grip_damping_n_s_per_m * (u2[j + 1] - u1[j + 1]);
    Real force = spring - h * order * p.damping_n_s_per_m * u1[j + 1];
    if constexpr (kLag) force += h * h * lag_.rate_per_s * slide.lag.excess.coefficient[j];
    u1[j + 2] = scale * force / p.mass_kg;
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

template <typename Real, bool kLag>
MotionIncrement<Real> BasicTwoBodies<Real, kLag>::advance(State& state, const Slide& slide,
                                                          const BasicHandDrive<Real>& drive,
                                                          Real theta) const {
  const Real h = slide.duration_s;
  const Real stretch_m = state.hand_position_m - state.position_m;
  MotionIncrement<Real> increment;
  increment.displacement_m = h * slide.velocity.integral_to(theta);
  increment.velocity_squared = h * product_integral(slide.velocity, slide.velocity, theta);
  increment.hand_work_j =
      parameters_.grip_stiffness_n_per_m *
          (stretch_m * increment.displacement_m +
           h * h * lagged_product_integral(slide.velocity, slide.velocity_difference, theta)) +
      parameters_.grip_damping_n_s_per_m * h *
          product_integral(slide.velocity_difference, slide.velocity, theta);
  if constexpr (kLag) {
    increment.lag_work_j = h * product_integral(slide.lag.excess, slide.velocity, theta);
    slide.lag.settle(state, theta);
  }
  state.position_m += increment.displacement_m;
  state.hand_position_m +=
      drive.velocity_m_per_s * (h * theta) + h * slide.hand_relative_velocity.integral_to(theta);
  state.velocity_m_per_s = slide.velocity.at(theta);
  state.hand_velocity_m_per_s = drive.velocity_m_per_s + slide.hand_relative_velocity.at(theta);
  return increment;
}

template <typename Real, bool kLag>
auto BasicTwoBodies<Real, kLag>::stick(const State& state, Real force_n,
                                       const BasicHandDrive<Real>& drive, Real duration_s) const
    -> Stick {
  const Parameters& p = parameters_;
  const Real h = duration_s;
  Stick stick;
  stick.duration_s = h;
  auto& w = stick.hand_velocity.coefficient;
  w[0] = state.hand_velocity_m_per_s;
  w[1] = hand_acceleration(state, drive) * h;
  const Real stiffness =
      h * h * (p.hand_stiffness_n_per_m + p.grip_stiffness_n_per_m) / p.hand_mass_kg;
  const Real damping = h * (p.hand_damping_n_s_per_m + p.grip_damping_n_s_per_m) / p.hand_mass_kg;
  const Real drive_term =
      h * h * p.hand_stiffness_n_per_m * drive.velocity_m_per_s / p.hand_mass_kg;
  for (std::size_t j = 0; j + 2 < w.size(); ++j) {
    const Real order = static_cast<Real>(j + 1);
    const Real inhomogeneity = j == 0 ? drive_term : 0;
    w[j + 2] =
        (inhomogeneity - stiffness * w[j] - damping * order * w[j + 1]) / (order * (order + 1));
  }
  auto& net = stick.net_force.coefficient;
  net[0] = grip_force(state) - force_n;
  for (std::size_t j = 1; j < net.size(); ++j) {
    net[j] = p.grip_stiffness_n_per_m * h * w[j - 1] / static_cast<Real>(j) +
             p.grip_damping_n_s_per_m * w[j];
  }
  if constexpr (kLag) {
    stick.lag = {state.excess_n(force_n), force_n, h, lag_.rate_per_s};
    for (std::size_t j = 0; j < net.size(); ++j) net[j] -= stick.lag.excess.coefficient[j];
  }
  return stick;
}

template <typename Real, bool kLag>
void BasicTwoBodies<Real, kLag>::advance(State& state, const Stick& stick, Real theta) {
  state.hand_position_m += stick.duration_s * stick.hand_velocity.integral_to(theta);
  state.hand_velocity_m_per_s = stick.hand_velocity.at(theta);
  if constexpr (kLag) stick.lag.settle(state, theta);
}

template class BasicTwoBodies<double, false>;
template class BasicTwoBodies<double, true>;
template class BasicTwoBodies<long double, false>;
template class BasicTwoBodies<long double, true>;

}  // namespace hapticwall
