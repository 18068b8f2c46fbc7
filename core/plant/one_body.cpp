#include "core/plant/one_body.h"

#include <array>

#include "core/plant/propagator.h"

namespace hapticwall {
namespace {

// Largest stretch with rate * stretch within the Taylor polynomial's reach, as T/2^n.
double stretch_within_reach(double rate_per_s, double period_s) {
  double stretch_s = period_s;
  while (rate_per_s * stretch_s > kTaylorReach) stretch_s *= 0.5;
  return stretch_s;
}

}  // namespace

OneBody::OneBody(const OneBodyParameters& parameters, double period_s)
    : parameters_(parameters), period_s_(period_s), half_mass_kg_(0.5 * parameters.mass_kg) {
  // State (u, aT, ∫u/T, ∫∫u/T²), time in ticks.
  const long double t = period_s;
  const long double stiffness = static_cast<long double>(parameters.hand_stiffness_n_per_m) /
                                static_cast<long double>(parameters.mass_kg);
  const long double damping = (static_cast<long double>(parameters.damping_n_s_per_m) +
                               static_cast<long double>(parameters.hand_damping_n_s_per_m)) /
                              static_cast<long double>(parameters.mass_kg);
  SetupMatrix generator = SetupMatrix::Zero(4, 4);
  generator(0, 1) = 1.0L;
  generator(1, 0) = -stiffness * t * t;
  generator(1, 1) = -damping * t;
  generator(2, 0) = 1.0L;
  generator(3, 2) = 1.0L;
  SetupMatrix u_squared = SetupMatrix::Zero(4, 4);
  u_squared(0, 0) = 1.0L;
  const Propagator propagator = make_propagator(generator, std::array{u_squared});
  const SetupMatrix& e = propagator.increment;
  const SetupMatrix& g = propagator.integrals[0];
  const auto number = [](long double value) { return static_cast<double>(value); };
  // The second input is aT = fT/m.
  const long double n = t / static_cast<long double>(parameters.mass_kg);
  rows_.velocity[0] = number(e(0, 0));
  rows_.velocity[1] = number(e(0, 1) * n);
  rows_.integral[0] = number(e(2, 0) * t);
  rows_.integral[1] = number(e(2, 1) * n * t);
  rows_.double_integral[0] = number(e(3, 0) * t * t);
  rows_.double_integral[1] = number(e(3, 1) * n * t * t);
  rows_.square[0] = number(g(0, 0) * t);
  rows_.square[1] = number(2.0L * g(0, 1) * n * t);
  rows_.square[2] = number(g(1, 1) * n * n * t);

  natural_rate_per_s_ = std::sqrt(static_cast<double>(stiffness));
  damping_rate_per_s_ = static_cast<double>(damping);
  const double rate = natural_rate_per_s_ + damping_rate_per_s_;
  longest_stretch_s_ = stretch_within_reach(rate, period_s);
  // In the scaled state (u rate0, a) the generator's norm is at most `rate`: |a'| ≤ rate e^{rate T}
  // |state|.
  jerk_bound_ = 0.5 * period_s * period_s * rate * std::exp(rate * period_s);
}

OneBody::Slide OneBody::slide(const State& state, double load_n, const HandDrive& drive,
                              double duration_s, double minimum_acceleration_sign) const {
  Slide slide;
  slide.duration_s = duration_s;
  double a = net_force_n(state, load_n, drive) / parameters_.mass_kg;
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
