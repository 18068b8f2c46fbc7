#include "core/plant/one_body.h"

#include <array>

#include "core/plant/ladder.h"
#include "core/plant/propagator.h"

namespace hapticwall {
namespace {

// State (u, aT, ∫u/T, ∫∫u/T²), time in ticks.
SetupMatrix make_generator(const OneBodyParameters& p, long double t) {
  const long double m = p.mass_kg;
  const long double damping = static_cast<long double>(p.damping_n_s_per_m) +
                              static_cast<long double>(p.hand_damping_n_s_per_m);
  SetupMatrix generator = SetupMatrix::Zero(4, 4);
  generator(0, 1) = 1.0L;
  generator(1, 0) = -static_cast<long double>(p.hand_stiffness_n_per_m) / m * t * t;
  generator(1, 1) = -damping / m * t;
  generator(2, 0) = 1.0L;
  generator(3, 2) = 1.0L;
  return generator;
}

double number(long double value) { return static_cast<double>(value); }

}  // namespace

OneBody::OneBody(const OneBodyParameters& parameters, double period_s)
    : parameters_(parameters),
      half_mass_kg_(0.5 * parameters.mass_kg),
      per_mass_(1.0 / parameters.mass_kg),
      natural_rate_per_s_(std::sqrt(parameters.hand_stiffness_n_per_m / parameters.mass_kg)),
      damping_rate_per_s_((parameters.damping_n_s_per_m + parameters.hand_damping_n_s_per_m) /
                          parameters.mass_kg) {
  const long double t = period_s;
  const long double n = t / static_cast<long double>(parameters.mass_kg);  // aT = f n
  SetupMatrix u_squared = SetupMatrix::Zero(4, 4);
  u_squared(0, 0) = 1.0L;
  const int halvings = halvings_within_reach(natural_rate_per_s_ + damping_rate_per_s_, period_s);
  double duration_s = period_s;
  for (const Propagator& propagator :
       make_propagators(make_generator(parameters, t), std::array{u_squared}, halvings)) {
    const SetupMatrix& e = propagator.increment;
    const SetupMatrix& g = propagator.integrals.front();
    levels_.push_back(
        {duration_s,
         {number(e(0, 0)), number(e(0, 1) * n)},
         {number(e(2, 0) * t), number(e(2, 1) * n * t)},
         {number(e(3, 0) * t * t), number(e(3, 1) * n * t * t)},
         {number(g(0, 0) * t), number(2.0L * g(0, 1) * n * t), number(g(1, 1) * n * n * t)}});
    duration_s *= 0.5;
  }
}

// The net force on a handle at rest changes linearly: its two ends tell.
bool OneBody::surely_sticks(int level, const State& state, double force_n, const HandDrive& drive,
                            double friction_n) const {
  const double begin_n = hand_force_n(state, drive) - force_n;
  const double end_n = begin_n + parameters_.hand_stiffness_n_per_m * drive.velocity_m_per_s *
                                     levels_[static_cast<std::size_t>(level)].duration_s;
  return std::abs(begin_n) < friction_n && std::abs(end_n) < friction_n;
}

OneBody::Slide OneBody::slide(const State& state, double load_n, const HandDrive& drive,
                              double duration_s, double minimum_acceleration_sign) const {
  Slide slide;
  slide.duration_s = duration_s;
  double a = net_force_n(state, load_n, drive) * per_mass_;
  if (minimum_acceleration_sign * a < 0.0) a = 0.0;
  auto& u = slide.relative_velocity.coefficient;
  u[0] = state.velocity_m_per_s - drive.velocity_m_per_s;
  u[1] = a * duration_s;
  const double stiffness = natural_rate_per_s_ * natural_rate_per_s_ * duration_s * duration_s;
  const double damping = damping_rate_per_s_ * duration_s;
  for (std::size_t j = 0; j + 2 < u.size(); ++j) {
    const double order = static_cast<double>(j + 1);
    u[j + 2] = -(stiffness * u[j] + damping * order * u[j + 1]) / (order * (order + 1.0));
  }
  slide.velocity = slide.relative_velocity;
  slide.velocity.coefficient[0] = state.velocity_m_per_s;
  return slide;
}

MotionIncrement OneBody::advance(State& state, const Slide& slide, const HandDrive& drive,
                                 double theta) const {
  const double h = slide.duration_s;
  const double duration_s = h * theta;
  const double integral_u = h * slide.relative_velocity.integral_to(theta);
  const double double_integral_u = h * h * slide.relative_velocity.double_integral_to(theta);
  const double u_squared =
      h * product_integral(slide.relative_velocity, slide.relative_velocity, theta);
  MotionIncrement increment;
  increment.displacement_m = h * slide.velocity.integral_to(theta);
  increment.velocity_squared = h * product_integral(slide.velocity, slide.velocity, theta);
  increment.hand_work_j = hand_work(drive.position_m - state.position_m, drive.velocity_m_per_s,
                                    duration_s, integral_u, double_integral_u, u_squared);
  state.position_m += increment.displacement_m;
  state.velocity_m_per_s = slide.velocity.at(theta);
  return increment;
}

OneBody::Stick OneBody::stick(const State& state, double force_n, const HandDrive& drive,
                              double duration_s) const {
  Stick stick;
  stick.duration_s = duration_s;
  stick.net_force.coefficient[0] = hand_force_n(state, drive) - force_n;
  stick.net_force.coefficient[1] =
      parameters_.hand_stiffness_n_per_m * drive.velocity_m_per_s * duration_s;
  return stick;
}

}  // namespace hapticwall
