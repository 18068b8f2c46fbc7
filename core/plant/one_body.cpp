#include "core/plant/one_body.h"

#include <limits>

#include "core/plant/linear_generator.h"

namespace hapticwall {
namespace {

// Scaled states (u, aT[, eT/m]).
template <bool kLag>
auto one_body_generator(const PlantParameters& p, long double t) {
  LinearGenerator<kLag ? 3 : 2> g(p, t);
  constexpr int kU = 0;
  constexpr int kA = 1;
  const long double m = p.mass_kg;
  const long double stiffness = static_cast<long double>(p.hand_stiffness_n_per_m) / m * t * t;
  const long double hand_damping = static_cast<long double>(p.hand_damping_n_s_per_m) / m * t;
  const long double damping = static_cast<long double>(p.damping_n_s_per_m) / m * t;
  auto& a = g.matrix;
  a(kU, kA) = 1.0L;
  a(kA, kU) = -stiffness;
  a(kA, kA) = -(damping + hand_damping);
  a(g.kVelocity, kA) = 1.0L;
  a(g.kHandForce, kU) = -stiffness;
  a(g.kHandForce, kA) = -hand_damping;
  g.unit[kU] = 1.0L;
  g.unit[kA] = t / m;
  if constexpr (kLag) {
    constexpr int kE = 2;
    a(kA, kE) = t / static_cast<long double>(p.time_constant_s);
    a(kE, kE) = -a(kA, kE);
    g.unit[kE] = t / m;
  }
  return g;
}

}  // namespace

template <typename Real, bool kLag>
BasicOneBody<Real, kLag>::BasicOneBody(const PlantParameters& parameters, double period_s)
    : damping_n_s_per_m_(parameters.damping_n_s_per_m),
      hand_stiffness_n_per_m_(parameters.hand_stiffness_n_per_m),
      hand_damping_n_s_per_m_(parameters.hand_damping_n_s_per_m),
      half_mass_kg_(static_cast<Real>(parameters.mass_kg) / 2),
      per_mass_(1 / static_cast<Real>(parameters.mass_kg)),
      natural_rate_per_s_(
          std::sqrt(hand_stiffness_n_per_m_ / static_cast<Real>(parameters.mass_kg))),
      damping_rate_per_s_((damping_n_s_per_m_ + hand_damping_n_s_per_m_) /
                          static_cast<Real>(parameters.mass_kg)),
      fast_rate_per_s_(-std::numeric_limits<Real>::infinity()),
      lag_(parameters.time_constant_s) {
  const Real half = damping_rate_per_s_ / 2;
  if (half > natural_rate_per_s_) {
    fast_rate_per_s_ =
        half + std::sqrt((half - natural_rate_per_s_) * (half + natural_rate_per_s_));
  }
  Real rate_per_s = natural_rate_per_s_ + damping_rate_per_s_;
  if constexpr (kLag) rate_per_s += lag_.rate_per_s;
  const auto generator = one_body_generator<kLag>(parameters, static_cast<long double>(period_s));
  long double duration_s = period_s;
  for (const auto& step : make_propagators<generator.kCore>(
           generator.matrix, generator.template weights<kLag>(),
           halvings_within_reach(static_cast<double>(rate_per_s), period_s))) {
    Rows rows;
    generator.template fill<Real, kLag>(rows, step, duration_s);
    // u = v: the velocity's own terms join those of u.
    const auto& drift = step.integral;
    const auto& square = step.integrals[0];
    const int v = generator.kVelocity;
    auto integral = drift;
    integral(v, 0) += duration_s / generator.period_s;
    rows.integral_at_rest = generator.template row<Real>(integral, v, generator.period_s);
    auto at_rest = square;
    at_rest(0, 0) += duration_s / generator.period_s + 2.0L * drift(v, 0);
    for (int i = 1; i < generator.kCore; ++i) at_rest(0, i) += drift(v, i);
    rows.square_at_rest = generator.template form<Real>(at_rest, generator.period_s);
    levels_.push_back(rows);
    duration_s *= 0.5L;
  }
}

template <typename Real, bool kLag>
auto BasicOneBody<Real, kLag>::slide(const State& state, const Load<Real>& load,
                                     const BasicHandDrive<Real>& drive, Real duration_s,
                                     Real push) const -> Slide {
  Slide slide;
  slide.duration_s = duration_s;
  Real a = net_force_n(state, load, drive) * per_mass_;
  if (push * a < 0) a = 0;
  const Real h = duration_s;
  const Real stiffness = natural_rate_per_s_ * natural_rate_per_s_ * h * h;
  const Real damping = damping_rate_per_s_ * h;
  if constexpr (kLag) {
    slide.lag = {state.excess_n(load.force_n), load.force_n, h, lag_.rate_per_s};
  }
  auto& v = slide.velocity.coefficient;
  auto& force = slide.hand_force.coefficient;
  Real u = state.velocity_m_per_s - drive.velocity_m_per_s;  // its coefficients differ in the first
  v[0] = state.velocity_m_per_s;
  v[1] = a * h;
  force[0] = hand_force_n(state, drive);
  for (std::size_t j = 0; j + 1 < v.size(); ++j) {
    const Real order = static_cast<Real>(j + 1);
    force[j + 1] = -(hand_stiffness_n_per_m_ * h * u / order + hand_damping_n_s_per_m_ * v[j + 1]);
    if (j + 2 < v.size()) {
      Real sum = -(stiffness * u + damping * order * v[j + 1]);
      if constexpr (kLag) {
        sum += h * h * lag_.rate_per_s * per_mass_ * slide.lag.excess.coefficient[j];
      }
      v[j + 2] = sum / (order * (order + 1));
    }
    u = v[j + 1];
  }
  return slide;
}

template <typename Real, bool kLag>
MotionIncrement<Real> BasicOneBody<Real, kLag>::advance(State& state, const Slide& slide,
                                                        Real theta) const {
  const MotionIncrement<Real> increment =
      integrate(slide.velocity, slide.hand_force, slide.lag, slide.duration_s, theta);
  slide.lag.settle(state, theta);
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
