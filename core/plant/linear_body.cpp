#include "core/plant/linear_body.h"

#include <limits>

#include "core/plant/propagator.h"

namespace hapticwall {

// The equations in scaled states, with time in ticks. `unit` converts each state to SI.
template <typename Real, bool kGrip, bool kLag>
struct LinearBody<Real, kGrip, kLag>::Setup {
  static constexpr int kCore = static_cast<int>(kStates);
  using Matrix = SetupMatrix<kCore + 2>;

  long double period_s;
  long double mass_kg;
  std::array<long double, kStates + 2> unit{};
  Matrix generator = Matrix::Zero();

  Setup(const PlantParameters& p, long double t) : period_s(t), mass_kg(p.mass_kg) {
    const long double m = p.mass_kg;
    const long double kh = static_cast<long double>(p.hand_stiffness_n_per_m) * t * t;
    const long double bh = static_cast<long double>(p.hand_damping_n_s_per_m) * t;
    auto& a = generator;
    if constexpr (kGrip) {
      const long double mh = p.hand_mass_kg;
      const long double k = static_cast<long double>(p.grip_stiffness_n_per_m) * t * t;
      const long double bc = static_cast<long double>(p.grip_damping_n_s_per_m) * t;
      a(kHandForce, kDifference) = k / m;
      a(kHandForce, kRate) = bc / m;
      // w''.
      a(kRate, kHand) = -kh / mh;
      a(kRate, kNet) = -bh / mh;
      a(kRate, kDifference) = -k / mh;
      a(kRate, kRate) = -(bc + bh) / mh;
      a(kDifference, kRate) = a(kHand, kRate) = 1.0L;
      unit[kDifference] = 1.0L;
      unit[kRate] = t;
    } else {
      a(kHandForce, kHand) = -kh / m;
      a(kHandForce, kNet) = -bh / m;
    }
    a(kHand, kNet) = a(kVelocity, kNet) = 1.0L;
    a.row(kNet) = a.row(kHandForce);
    a(kNet, kNet) -= static_cast<long double>(p.damping_n_s_per_m) * t / m;
    unit[kHand] = unit[kVelocity] = 1.0L;
    unit[kNet] = unit[kHandForce] = t / m;
    if constexpr (kLag) {
      const long double rate = t / static_cast<long double>(p.time_constant_s);
      a(kNet, kExcess) = rate;
      a(kExcess, kExcess) = -rate;
      unit[kExcess] = t / m;
    }
    if constexpr (kGrip) a.row(kRate) -= a.row(kNet);  // d'' = w'' - v''
  }

  [[nodiscard]] static auto weights() {
    std::array<Matrix, kLag ? 3 : 2> all;
    all.fill(Matrix::Zero());
    all[0](kVelocity, kVelocity) = 1.0L;
    all[1](kVelocity, kHandForce) = all[1](kHandForce, kVelocity) = 0.5L;
    if constexpr (kLag) all[2](kExcess, kVelocity) = all[2](kVelocity, kExcess) = 0.5L;
    return all;
  }
  [[nodiscard]] static long double at(const Matrix& matrix, std::size_t row, std::size_t column) {
    return matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
  }
  [[nodiscard]] Row row(const Matrix& matrix, std::size_t output, long double scale) const {
    Row numbers{};
    for (std::size_t i = 0; i < kStates; ++i) {
      numbers[i] = static_cast<Real>(at(matrix, output, i) * unit[i] * scale);
    }
    return numbers;
  }
  [[nodiscard]] Form form(const Matrix& integral, long double scale) const {
    Form numbers{};
    std::size_t k = 0;
    for (std::size_t i = 0; i < kStates; ++i) {
      for (std::size_t j = i; j < kStates; ++j) {
        const long double twice = i == j ? 1.0L : 2.0L;
        numbers[k++] = static_cast<Real>(twice * at(integral, i, j) * unit[i] * unit[j] * scale);
      }
    }
    return numbers;
  }
  template <typename Step>
  [[nodiscard]] Rows rows(const Step& step, long double ticks) const {
    Rows rows;
    rows.duration_s = static_cast<Real>(ticks * period_s);
    rows.velocity = row(step.increment, kVelocity, 1.0L);
    rows.drift = row(step.integral, kVelocity, period_s);
    rows.hand_force_drift = row(step.integral, kHandForce, mass_kg);
    rows.square = form(step.integrals[0], period_s);
    rows.hand_work = form(step.integrals[1], mass_kg);
    if constexpr (kGrip) {
      rows.difference = row(step.increment, kDifference, 1.0L);
      rows.stretch = row(step.integral, kDifference, period_s);
    } else {
      Matrix integral = step.integral;
      integral(kVelocity, kHand) += ticks;
      rows.integral_at_rest = row(integral, kVelocity, period_s);
      Matrix square = step.integrals[0];
      square(kHand, kHand) += ticks + 2.0L * step.integral(kVelocity, kHand);
      for (int i = 1; i < kCore; ++i) square(kHand, i) += step.integral(kVelocity, i);
      rows.square_at_rest = form(square, period_s);
    }
    if constexpr (kLag) {
      rows.settled_fraction = static_cast<Real>(-step.increment(kExcess, kExcess));
      rows.excess_integral_s = static_cast<Real>(step.integral(kExcess, kExcess) * period_s);
      for (std::size_t i = 0; i < kStates; ++i) {
        const long double twice = i == kExcess ? 1.0L : 2.0L;
        rows.excess_work[i] =
            static_cast<Real>(twice * at(step.integrals[2], kExcess, i) * unit[i] * period_s);
      }
    }
    return rows;
  }

  // Rows of a sticking handle: m_h w'' = -(k_h + k)(w - w_end) - (b_h + b_c) w'.
  static void add_stick_rows(const PlantParameters& p, long double t, int halvings,
                             std::vector<Rows>& levels) {
    const long double m = p.hand_mass_kg;
    SetupMatrix<2> hand;
    hand << 0.0L, 1.0L,
        -(static_cast<long double>(p.hand_stiffness_n_per_m) + p.grip_stiffness_n_per_m) / m * t *
            t,
        -(static_cast<long double>(p.hand_damping_n_s_per_m) + p.grip_damping_n_s_per_m) / m * t;
    std::size_t i = 0;
    for (const auto& step : make_propagators<2>(hand, std::array<SetupMatrix<2>, 0>{}, halvings)) {
      const auto& e = step.increment;
      const auto& integral = step.integral;
      levels[i].stick_difference = {static_cast<Real>(e(0, 0)), static_cast<Real>(e(0, 1) * t)};
      levels[i++].stick_stretch = {static_cast<Real>(integral(0, 0) * t),
                                   static_cast<Real>(integral(0, 1) * t * t)};
    }
  }
};

template <typename Real, bool kGrip, bool kLag>
LinearBody<Real, kGrip, kLag>::LinearBody(const PlantParameters& p, double period_s)
    : damping_n_s_per_m_(p.damping_n_s_per_m),
      stiffness_n_per_m_(kGrip ? p.grip_stiffness_n_per_m : p.hand_stiffness_n_per_m),
      coupling_n_s_per_m_(kGrip ? p.grip_damping_n_s_per_m : p.hand_damping_n_s_per_m),
      hand_stiffness_n_per_m_(p.hand_stiffness_n_per_m),
      hand_damping_n_s_per_m_(p.hand_damping_n_s_per_m),
      hand_mass_kg_(p.hand_mass_kg),
      half_mass_kg_(static_cast<Real>(p.mass_kg) / 2),
      per_mass_(1 / static_cast<Real>(p.mass_kg)),
      per_hand_mass_(kGrip ? 1 / hand_mass_kg_ : 0),
      root_per_mass_(std::sqrt(per_mass_)),
      root_per_hand_mass_(std::sqrt(per_hand_mass_)),
      stick_stiffness_n_per_m_(hand_stiffness_n_per_m_ + stiffness_n_per_m_),
      root_stick_stiffness_(std::sqrt(stick_stiffness_n_per_m_)),
      path_share_(1),
      jerk_per_root_energy_(per_mass_ *
                            (std::sqrt(stiffness_n_per_m_) +
                             coupling_n_s_per_m_ * (root_per_hand_mass_ + root_per_mass_) +
                             damping_n_s_per_m_ * root_per_mass_)),
      drive_rate_per_root_energy_(
          per_mass_ * (std::sqrt(stiffness_n_per_m_) + coupling_n_s_per_m_ * root_per_hand_mass_)),
      self_damping_rate_per_s_((damping_n_s_per_m_ + coupling_n_s_per_m_) * per_mass_),
      fast_rate_per_s_(-std::numeric_limits<Real>::infinity()),
      lag_rate_per_s_(kLag ? 1 / static_cast<Real>(p.time_constant_s) : 0) {
  // A bound of the fastest rate.
  Real square_rate = stiffness_n_per_m_ * per_mass_;
  Real rate = self_damping_rate_per_s_;
  if constexpr (kGrip) {
    path_share_ =
        stick_stiffness_n_per_m_ > 0 ? hand_stiffness_n_per_m_ / stick_stiffness_n_per_m_ : 0;
    square_rate =
        std::max(2 * square_rate, (stiffness_n_per_m_ + stick_stiffness_n_per_m_) * per_hand_mass_);
    rate = std::max(rate + coupling_n_s_per_m_ * per_mass_,
                    (2 * coupling_n_s_per_m_ + hand_damping_n_s_per_m_) * per_hand_mass_);
  } else if (const Real half = rate / 2, natural = std::sqrt(square_rate); half > natural) {
    fast_rate_per_s_ = half + std::sqrt((half - natural) * (half + natural));
  }
  rate += std::sqrt(square_rate) + lag_rate_per_s_;
  const int halvings = halvings_within_reach(static_cast<double>(rate), period_s);

  const Setup setup(p, period_s);
  long double ticks = 1.0L;
  for (const auto& step :
       make_propagators<Setup::kCore>(setup.generator, setup.weights(), halvings)) {
    levels_.push_back(setup.rows(step, ticks));
    ticks *= 0.5L;
  }
  if constexpr (kGrip) Setup::add_stick_rows(p, period_s, halvings, levels_);
}

// The equations of linear_body.h, differentiated: each pass gives the next coefficients of all.
template <typename Real, bool kGrip, bool kLag>
auto LinearBody<Real, kGrip, kLag>::piece(Row c, Real per_mass, Real duration_s) const -> Piece {
  Piece piece;
  piece.duration_s = duration_s;
  for (std::size_t j = 0;; ++j) {
    if constexpr (kGrip) piece.difference.coefficient[j] = c[kDifference];
    if constexpr (kLag) piece.excess.coefficient[j] = c[kExcess];
    if (j == kTaylorDegree) return piece;
    const Real step_s = duration_s / static_cast<Real>(j + 1);
    const Real a = per_mass * c[kNet];
    Real force_rate = 0;
    if constexpr (kGrip) {
      force_rate = stiffness_n_per_m_ * c[kDifference] + coupling_n_s_per_m_ * c[kRate];
    } else {
      force_rate = -(stiffness_n_per_m_ * c[kHand] + coupling_n_s_per_m_ * a);
    }
    piece.velocity.coefficient[j + 1] = step_s * a;
    piece.hand_force.coefficient[j + 1] = step_s * force_rate;
    Real net_rate = force_rate - damping_n_s_per_m_ * a;
    if constexpr (kLag) {
      net_rate += lag_rate_per_s_ * c[kExcess];
      c[kExcess] *= -step_s * lag_rate_per_s_;
    }
    if constexpr (kGrip) {
      const Real hand_a = a + c[kRate];
      const Real hand_rate =
          -(hand_stiffness_n_per_m_ * c[kHand] + hand_damping_n_s_per_m_ * hand_a + force_rate);
      c[kHand] = step_s * hand_a;
      c[kDifference] = step_s * c[kRate];
      c[kRate] = step_s * (per_hand_mass_ * hand_rate - per_mass * net_rate);
    } else {
      c[kHand] = step_s * a;
    }
    c[kNet] = step_s * net_rate;
  }
}

template <typename Real, bool kGrip, bool kLag>
auto LinearBody<Real, kGrip, kLag>::slide(const State& state, const Load<Real>& load,
                                          const Drive& drive, Real duration_s, Real push) const
    -> Piece {
  Row c = core_states(state, load, drive);
  if (push * c[kNet] < 0) {
    if constexpr (kGrip) c[kRate] += c[kNet] * per_mass_;
    c[kNet] = 0;
  }
  Piece slide = piece(c, per_mass_, duration_s);
  slide.velocity.coefficient[0] = state.velocity_m_per_s;
  slide.hand_force.coefficient[0] = hand_force_n(state, drive);
  slide.force_n = load.force_n;
  return slide;
}

// A handle that sticks is one of infinite mass.
template <typename Real, bool kGrip, bool kLag>
auto LinearBody<Real, kGrip, kLag>::stick(const State& state, Real force_n, const Drive& drive,
                                          Real duration_s) const -> Piece {
  Row c = core_states(state, {force_n, force_n}, drive);
  if constexpr (kGrip) c[kRate] = hand_acceleration(state, drive);
  Piece stick = piece(c, 0, duration_s);
  stick.hand_force.coefficient[0] = hand_force_n(state, drive);
  stick.force_n = force_n;
  return stick;
}

template <typename Real, bool kGrip, bool kLag>
MotionIncrement<Real> LinearBody<Real, kGrip, kLag>::advance(State& state, const Piece& slide,
                                                             Real theta) const {
  std::array<const TaylorPolynomial<Real>*, kLag ? 3 : 2> factors{&slide.velocity,
                                                                  &slide.hand_force};
  if constexpr (kLag) factors[2] = &slide.excess;
  const auto products = product_integrals(factors, slide.velocity, theta);
  const Real h = slide.duration_s;
  MotionIncrement<Real> increment;
  increment.displacement_m = h * slide.velocity.integral_to(theta);
  increment.velocity_squared = h * products[0];
  increment.hand_work_j = h * products[1];
  if constexpr (kLag) increment.lag_work_j = h * products[2];
  state.position_m += increment.displacement_m;
  state.velocity_m_per_s = slide.velocity.at(theta);
  if constexpr (kGrip) state.hand_position_m += increment.displacement_m;
  settle(state, slide, theta);
  return increment;
}

template <typename Real, bool kGrip, bool kLag>
void LinearBody<Real, kGrip, kLag>::settle(State& state, const Piece& stick, Real theta) {
  if constexpr (kGrip) {
    state.hand_position_m += stick.duration_s * stick.difference.integral_to(theta);
    state.hand_velocity_m_per_s = state.velocity_m_per_s + stick.difference.at(theta);
  }
  if constexpr (kLag) state.actuator_n = stick.force_n + stick.excess.at(theta);
}

template class LinearBody<double, false, false>;
template class LinearBody<double, false, true>;
template class LinearBody<double, true, false>;
template class LinearBody<double, true, true>;
template class LinearBody<long double, false, false>;
template class LinearBody<long double, false, true>;
template class LinearBody<long double, true, false>;
template class LinearBody<long double, true, true>;

}  // namespace hapticwall
