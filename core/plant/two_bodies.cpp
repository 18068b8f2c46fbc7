#include "core/plant/two_bodies.h"

#include "core/plant/linear_generator.h"

namespace hapticwall {
namespace {

// Scaled states (aT, d, d'T, u[, eT/m]).
template <bool kLag>
auto two_bodies_generator(const PlantParameters& p, long double t) {
  LinearGenerator<kLag ? 5 : 4> g(p, t);
  constexpr int kA = 0;
  constexpr int kD = 1;
  constexpr int kRate = 2;  // of d
  constexpr int kU = 3;
  const long double m1 = p.mass_kg;
  const long double m2 = p.hand_mass_kg;
  const long double kg = static_cast<long double>(p.grip_stiffness_n_per_m) * t * t;
  const long double bg = static_cast<long double>(p.grip_damping_n_s_per_m) * t;
  const long double kh = static_cast<long double>(p.hand_stiffness_n_per_m) * t * t;
  const long double bh = static_cast<long double>(p.hand_damping_n_s_per_m) * t;
  const long double b = static_cast<long double>(p.damping_n_s_per_m) * t;
  auto& a = g.matrix;
  a(kA, kA) = -b / m1;
  a(kA, kD) = kg / m1;
  a(kA, kRate) = bg / m1;
  a(kD, kRate) = 1.0L;
  // d'' = w'' - v''.
  a(kRate, kA) = b / m1 - bh / m2;
  a(kRate, kD) = -kg / m1 - kg / m2;
  a(kRate, kRate) = -bg / m1 - bg / m2 - bh / m2;
  a(kRate, kU) = -kh / m2;
  a(kU, kA) = 1.0L;
  a(kU, kRate) = 1.0L;
  a(g.kVelocity, kA) = 1.0L;
  a(g.kHandForce, kD) = kg / m1;
  a(g.kHandForce, kRate) = bg / m1;
  g.unit[kA] = g.unit[kRate] = t;
  g.unit[kD] = g.unit[kU] = 1.0L;
  if constexpr (kLag) {
    constexpr int kE = 4;
    const long double rate = t / static_cast<long double>(p.time_constant_s);
    a(kA, kE) = rate;
    a(kRate, kE) = -rate;
    a(kE, kE) = -rate;
    g.unit[kE] = t / m1;
  }
  return g;
}

}  // namespace

template <typename Real, bool kLag>
BasicTwoBodies<Real, kLag>::BasicTwoBodies(const PlantParameters& p, double period_s)
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
      per_hand_mass_(1 / parameters_.hand_mass_kg),
      root_per_mass_(std::sqrt(per_mass_)),
      root_per_hand_mass_(std::sqrt(per_hand_mass_)),
      stick_stiffness_n_per_m_(parameters_.hand_stiffness_n_per_m +
                               parameters_.grip_stiffness_n_per_m),
      root_stick_stiffness_(std::sqrt(stick_stiffness_n_per_m_)),
      hand_share_(stick_stiffness_n_per_m_ > 0
                      ? parameters_.hand_stiffness_n_per_m / stick_stiffness_n_per_m_
                      : 0) {
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
                   q.grip_damping_n_s_per_m * (root_per_hand_mass_ + root_per_mass_) +
                   q.damping_n_s_per_m * root_per_mass_);
  // |m g'| = |k_g d + b_g w'| likewise.
  drive_rate_per_root_energy_ = per_mass_ * (std::sqrt(q.grip_stiffness_n_per_m) +
                                             q.grip_damping_n_s_per_m * root_per_hand_mass_);
  self_damping_rate_per_s_ = (q.damping_n_s_per_m + q.grip_damping_n_s_per_m) * per_mass_;
  Real rate_per_s = std::sqrt(stiffness) + damping;
  if constexpr (kLag) rate_per_s += lag_.rate_per_s;
  const int halvings = halvings_within_reach(static_cast<double>(rate_per_s), period_s);
  make_levels(p, halvings);
  make_stick_levels(p, halvings);
}

template <typename Real, bool kLag>
void BasicTwoBodies<Real, kLag>::make_levels(const PlantParameters& p, int halvings) {
  constexpr int kD = 1;
  const auto generator = two_bodies_generator<kLag>(p, static_cast<long double>(period_s_));
  long double duration_s = period_s_;
  for (const auto& step : make_propagators<generator.kCore>(
           generator.matrix, generator.template weights<kLag>(), halvings)) {
    Rows rows;
    generator.template fill<Real, kLag>(rows, step, duration_s);
    rows.difference = generator.template row<Real>(step.increment, kD, 1.0L);
    rows.stretch = generator.template row<Real>(step.integral, kD, generator.period_s);
    levels_.push_back(rows);
    duration_s *= 0.5L;
  }
}

// m_h w'' = -(k_h + k_g)(w - w_end) - (b_h + b_g) w', state (w - w_end, w'T, ∫(w - w_end)/T).
template <typename Real, bool kLag>
void BasicTwoBodies<Real, kLag>::make_stick_levels(const PlantParameters& p, int halvings) {
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
  for (const auto& propagator : make_propagators<2>(generator, std::array<Matrix, 0>{}, halvings)) {
    const Matrix& e = propagator.increment;
    stick_levels_.push_back({{static_cast<Real>(e(0, 0)), static_cast<Real>(e(0, 1) * t)},
                             {static_cast<Real>(e(2, 0) * t), static_cast<Real>(e(2, 1) * t * t)}});
  }
}

template <typename Real, bool kLag>
auto BasicTwoBodies<Real, kLag>::slide(const State& state, const Load<Real>& load,
                                       const BasicHandDrive<Real>& drive, Real duration_s,
                                       Real push) const -> Slide {
  const Parameters& p = parameters_;
  const Real h = duration_s;
  const Row c = core_states(state, load, drive);
  const Real hand_acceleration = c[0] + c[2];
  const Real a = push * c[0] < 0 ? 0 : c[0];
  Slide slide;
  slide.duration_s = h;
  if constexpr (kLag) slide.lag = {c[4], load.force_n, h, lag_.rate_per_s};
  auto& v = slide.velocity.coefficient;
  auto& d = slide.difference.coefficient;
  auto& force = slide.hand_force.coefficient;
  v[0] = state.velocity_m_per_s;
  v[1] = a * h;
  d[0] = c[1];
  d[1] = (hand_acceleration - a) * h;
  force[0] = grip_force(state);
  Real u = c[3];  // of w - s, whose coefficients are those of v + d except the first
  Real next_u = hand_acceleration * h;
  for (std::size_t j = 0; j + 1 < v.size(); ++j) {
    const Real order = static_cast<Real>(j + 1);
    force[j + 1] =
        p.grip_stiffness_n_per_m * h * d[j] / order + p.grip_damping_n_s_per_m * d[j + 1];
    if (j + 2 == v.size()) break;
    // Forces' derivatives, times h²: of F_g it is the coefficient just found.
    const Real scale = 1 / (order * (order + 1));
    const Real grip = h * order * force[j + 1];
    Real on_handle = grip - h * order * p.damping_n_s_per_m * v[j + 1];
    if constexpr (kLag) on_handle += h * h * lag_.rate_per_s * slide.lag.excess.coefficient[j];
    const Real on_hand = -h * h * p.hand_stiffness_n_per_m * u -
                         h * order * p.hand_damping_n_s_per_m * next_u - grip;
    v[j + 2] = scale * on_handle * per_mass_;
    u = next_u;
    next_u = scale * on_hand * per_hand_mass_;
    d[j + 2] = next_u - v[j + 2];
  }
  return slide;
}

template <typename Real, bool kLag>
MotionIncrement<Real> BasicTwoBodies<Real, kLag>::advance(State& state, const Slide& slide,
                                                          Real theta) const {
  const Real h = slide.duration_s;
  const MotionIncrement<Real> increment =
      integrate(slide.velocity, slide.hand_force, slide.lag, h, theta);
  slide.lag.settle(state, theta);
  state.position_m += increment.displacement_m;
  state.hand_position_m += increment.displacement_m + h * slide.difference.integral_to(theta);
  state.velocity_m_per_s = slide.velocity.at(theta);
  state.hand_velocity_m_per_s = state.velocity_m_per_s + slide.difference.at(theta);
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
  stick.lag.settle(state, theta);
}

template class BasicTwoBodies<double, false>;
template class BasicTwoBodies<double, true>;
template class BasicTwoBodies<long double, false>;
template class BasicTwoBodies<long double, true>;

}  // namespace hapticwall
