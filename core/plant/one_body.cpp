#include "core/plant/one_body.h"

#include "core/plant/ladder.h"
#include "core/plant/propagator.h"

namespace hapticwall {
namespace {

// State (u, aT, [eT/m,] ∫u/T, ∫∫u/T²), time in ticks.
template <bool kLag>
struct Generator {
  static constexpr int kU = 0;
  static constexpr int kA = 1;
  static constexpr int kE = 2;  // with a lag only
  static constexpr int kIntegral = kLag ? 3 : 2;
  static constexpr int kDouble = kIntegral + 1;
  static constexpr int kSize = kDouble + 1;
  using Matrix = SetupMatrix<kSize>;

  static Matrix make(const OneBodyParameters& p, long double t) {
    const long double m = p.mass_kg;
    const long double damping = static_cast<long double>(p.damping_n_s_per_m) +
                                static_cast<long double>(p.hand_damping_n_s_per_m);
    Matrix a = Matrix::Zero();
    a(kU, kA) = 1.0L;
    a(kA, kU) = -static_cast<long double>(p.hand_stiffness_n_per_m) / m * t * t;
    a(kA, kA) = -damping / m * t;
    a(kIntegral, kU) = 1.0L;
    a(kDouble, kIntegral) = 1.0L;
    if constexpr (kLag) {
      a(kA, kE) = t / static_cast<long double>(p.time_constant_s);
      a(kE, kE) = -a(kA, kE);
    }
    return a;
  }

  static auto weights() {
    Matrix u_squared = Matrix::Zero();
    u_squared(kU, kU) = 1.0L;
    if constexpr (kLag) {
      Matrix excess_times_u = Matrix::Zero();
      excess_times_u(kE, kU) = excess_times_u(kU, kE) = 0.5L;
      return std::array{u_squared, excess_times_u};
    } else {
      return std::array{u_squared};
    }
  }
};

}  // namespace

template <typename Real, bool kLag>
BasicOneBody<Real, kLag>::BasicOneBody(const OneBodyParameters& parameters, double period_s)
    : damping_n_s_per_m_(parameters.damping_n_s_per_m),
      hand_stiffness_n_per_m_(parameters.hand_stiffness_n_per_m),
      hand_damping_n_s_per_m_(parameters.hand_damping_n_s_per_m),
      half_mass_kg_(static_cast<Real>(parameters.mass_kg) / 2),
      per_mass_(1 / static_cast<Real>(parameters.mass_kg)),
      natural_rate_per_s_(
          std::sqrt(hand_stiffness_n_per_m_ / static_cast<Real>(parameters.mass_kg))),
      damping_rate_per_s_((damping_n_s_per_m_ + hand_damping_n_s_per_m_) /
                          static_cast<Real>(parameters.mass_kg)),
      lag_(parameters.time_constant_s) {
  using G = Generator<kLag>;
  const long double t = period_s;
  // What a unit of u, f = m a and e is in the scaled state.
  std::array<long double, kStates> unit{1.0L, t / static_cast<long double>(parameters.mass_kg)};
  Real rate_per_s = natural_rate_per_s_ + damping_rate_per_s_;
  if constexpr (kLag) {
    unit[2] = unit[1];
    rate_per_s += lag_.rate_per_s;
  }
  const auto row = [&](const typename G::Matrix& e, int output, long double scale) {
    Row numbers{};
    for (std::size_t i = 0; i < kStates; ++i) {
      numbers[i] = static_cast<Real>(e(output, static_cast<int>(i)) * unit[i] * scale);
    }
    return numbers;
  };
  long double duration_s = t;
  for (const auto& propagator :
       make_propagators(G::make(parameters, t), G::weights(),
                        halvings_within_reach(static_cast<double>(rate_per_s), period_s))) {
    const auto& e = propagator.increment;
    const auto& g = propagator.integrals.front();
    Rows rows;
    rows.duration_s = static_cast<Real>(duration_s);
    rows.velocity = row(e, G::kU, 1.0L);
    rows.integral = row(e, G::kIntegral, t);
    rows.double_integral = row(e, G::kDouble, t * t);
    std::size_t k = 0;
    for (std::size_t j = 0; j < kStates; ++j) {
      for (std::size_t i = 0; i <= j; ++i) {
        const long double twice = i == j ? 1.0L : 2.0L;
        rows.square[k++] = static_cast<Real>(twice * g(static_cast<int>(i), static_cast<int>(j)) *
                                             unit[i] * unit[j] * t);
      }
    }
    if constexpr (kLag) {
      rows.lag = {duration_s, static_cast<long double>(parameters.time_constant_s)};
      const auto& cross = propagator.integrals[1];
      for (std::size_t i = 0; i < kStates; ++i) {
        const long double twice = i == G::kE ? 1.0L : 2.0L;
        rows.lag.cross[i] =
            static_cast<Real>(twice * cross(G::kE, static_cast<int>(i)) * unit[i] * t);
      }
    }
    levels_.push_back(rows);
    duration_s *= 0.5L;
  }
}

// The hand's force on a handle at rest changes linearly, and a lag's excess falls: their ends bound
// the net force.
template <typename Real, bool kLag>
bool BasicOneBody<Real, kLag>::surely_sticks(int level, const State& state, Real force_n,
                                             const BasicHandDrive<Real>& drive,
                                             Real friction_n) const {
  const Rows& rows = this->level(level);
  const Real begin_n = hand_force_n(state, drive) - force_n;
  const Real end_n = begin_n + hand_stiffness_n_per_m_ * drive.velocity_m_per_s * rows.duration_s;
  Real most_n = std::max(begin_n, end_n);
  Real least_n = std::min(begin_n, end_n);
  if constexpr (kLag) {
    const Real excess_n = state.excess_n(force_n);
    const Real rest_n = excess_n - rows.lag.settled_fraction * excess_n;
    most_n -= std::min(excess_n, rest_n);
    least_n -= std::max(excess_n, rest_n);
  }
  return most_n < friction_n && least_n > -friction_n;
}

template <typename Real, bool kLag>
auto BasicOneBody<Real, kLag>::slide(const State& state, const Load<Real>& load,
                                     const BasicHandDrive<Real>& drive, Real duration_s,
                                     Real push) const -> Slide {
  Slide slide;
  slide.duration_s = duration_s;
  Real a = net_force_n(state, load, drive) * per_mass_;
  if (push * a < 0) a = 0;
  auto& u = slide.relative_velocity.coefficient;
  u[0] = state.velocity_m_per_s - drive.velocity_m_per_s;
  u[1] = a * duration_s;
  const Real stiffness = natural_rate_per_s_ * natural_rate_per_s_ * duration_s * duration_s;
  const Real damping = damping_rate_per_s_ * duration_s;
  if constexpr (kLag) {
    slide.lag = {state.excess_n(load.force_n), load.force_n, duration_s, lag_.rate_per_s};
  }
  for (std::size_t j = 0; j + 2 < u.size(); ++j) {
    const Real order = static_cast<Real>(j + 1);
    Real force = -(stiffness * u[j] + damping * order * u[j + 1]);
    if constexpr (kLag) {
      force +=
          duration_s * duration_s * lag_.rate_per_s * per_mass_ * slide.lag.excess.coefficient[j];
    }
    u[j + 2] = force / (order * (order + 1));
  }
  slide.velocity = slide.relative_velocity;
  slide.velocity.coefficient[0] = state.velocity_m_per_s;
  return slide;
}

template <typename Real, bool kLag>
MotionIncrement<Real> BasicOneBody<Real, kLag>::advance(State& state, const Slide& slide,
                                                        const BasicHandDrive<Real>& drive,
                                                        Real theta) const {
  const Real h = slide.duration_s;
  const Real integral_u = h * slide.relative_velocity.integral_to(theta);
  const Real double_integral_u = h * h * slide.relative_velocity.double_integral_to(theta);
  const Real u_squared =
      h * product_integral(slide.relative_velocity, slide.relative_velocity, theta);
  MotionIncrement<Real> increment;
  increment.displacement_m = h * slide.velocity.integral_to(theta);
  increment.velocity_squared = h * product_integral(slide.velocity, slide.velocity, theta);
  increment.hand_work_j = hand_work(drive.position_m - state.position_m, drive.velocity_m_per_s,
                                    h * theta, integral_u, double_integral_u, u_squared);
  if constexpr (kLag) {
    increment.lag_work_j = h * product_integral(slide.lag.excess, slide.velocity, theta);
    slide.lag.settle(state, theta);
  }
  state.position_m += increment.displacement_m;
  state.velocity_m_per_s = slide.velocity.at(theta);
  return increment;
}

template <typename Real, bool kLag>
auto BasicOneBody<Real, kLag>::stick(const State& state, Real force_n,
                                     const BasicHandDrive<Real>& drive, Real duration_s) const
    -> Stick {
  Stick stick;
  stick.duration_s = duration_s;
  auto& net = stick.net_force.coefficient;
  net[0] = hand_force_n(state, drive) - force_n;
  net[1] = hand_stiffness_n_per_m_ * drive.velocity_m_per_s * duration_s;
  if constexpr (kLag) {
    stick.lag = {state.excess_n(force_n), force_n, duration_s, lag_.rate_per_s};
    for (std::size_t j = 0; j < net.size(); ++j) net[j] -= stick.lag.excess.coefficient[j];
  }
  return stick;
}

template class BasicOneBody<double, false>;
template class BasicOneBody<double, true>;
template class BasicOneBody<long double, false>;
template class BasicOneBody<long double, true>;

}  // namespace hapticwall
