#include "core/study/pulse_transfer.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/plant/propagator.h"

namespace hapticwall {
namespace {

template <int kStates>
struct Motion {
  SetupMatrix<kStates> rates = SetupMatrix<kStates>::Zero();
  Eigen::Matrix<long double, kStates, 1> input = Eigen::Matrix<long double, kStates, 1>::Zero();
};

// States: position and velocity of the handle; with a grip those of the hand minus the handle's;
// with a lag the amplifier's force. A force pushes along x here.
template <bool kGrip, bool kLag>
auto motion_of(const PlantParameters& p, long double t) {
  constexpr int kBodies = kGrip ? 4 : 2;
  Motion<kBodies + (kLag ? 1 : 0)> motion;
  auto& a = motion.rates;
  const long double m = p.mass_kg;
  const long double kh = static_cast<long double>(p.hand_stiffness_n_per_m) * t * t;
  const long double bh = static_cast<long double>(p.hand_damping_n_s_per_m) * t;
  a(0, 1) = 1.0L;
  a(1, 1) = -static_cast<long double>(p.damping_n_s_per_m) * t / m;
  if constexpr (kGrip) {
    const long double mh = p.hand_mass_kg;
    const long double kg = static_cast<long double>(p.grip_stiffness_n_per_m) * t * t;
    const long double bg = static_cast<long double>(p.grip_damping_n_s_per_m) * t;
    a(1, 2) = kg / m;
    a(1, 3) = bg / m;
    a(2, 3) = 1.0L;
    a(3, 0) = -kh / mh;
    a(3, 1) = -bh / mh - a(1, 1);
    a(3, 2) = -(kh + kg) / mh - kg / m;
    a(3, 3) = -(bh + bg) / mh - bg / m;
  } else {
    a(1, 0) = -kh / m;
    a(1, 1) -= bh / m;
  }
  auto force = motion.input;
  force(1) = 1.0L;
  if constexpr (kGrip) force(3) = -1.0L;
  if constexpr (kLag) {
    const long double rate = t / static_cast<long double>(p.time_constant_s);
    a.col(kBodies) = force;
    a(kBodies, kBodies) = -rate;
    motion.input(kBodies) = rate;
  } else {
    motion.input = force;
  }
  return motion;
}

// A tick, or the part of it after the arrival of a command.
template <int kStates>
Propagator<kStates, 0> step_of(const Motion<kStates>& motion, long double part) {
  Propagator<kStates, 0> step = make_propagators<kStates>(SetupMatrix<kStates>(motion.rates * part),
                                                          std::array<SetupMatrix<kStates>, 0>{}, 0)
                                    .front();
  step.integral *= part;
  return step;
}

// Transfer function by Faddeev and LeVerrier, from e^A - 1.
template <int kStates>
PulseTransfer transfer_of(const Motion<kStates>& motion, long double delay_ticks) {
  constexpr auto kCount = static_cast<std::size_t>(kStates);
  PulseTransfer transfer;
  transfer.states = kCount;
  // A whole number of ticks may come in seconds.
  constexpr long double kSameTick = 1e-9L;
  const long double whole = std::floor(delay_ticks + kSameTick);
  const long double late = std::max(0.0L, delay_ticks - whole);
  transfer.delay_ticks = static_cast<double>(whole);
  const auto tick = step_of(motion, 1.0L);
  const Eigen::Matrix<long double, kStates, 1> both = tick.integral * motion.input;
  Eigen::Matrix<long double, kStates, 1> now = both;
  transfer.has_earlier = late > kSameTick;
  if (transfer.has_earlier) now = step_of(motion, 1.0L - late).integral * motion.input;
  SetupMatrix<kStates> adjugate = SetupMatrix<kStates>::Identity();
  transfer.denominator[kCount] = 1.0;
  for (std::size_t k = 1; k <= kCount; ++k) {
    transfer.numerator[kCount - k] = static_cast<double>(adjugate.row(0).dot(now));
    transfer.earlier[kCount - k] = static_cast<double>(adjugate.row(0).dot(both - now));
    adjugate = (tick.increment * adjugate).eval();
    const long double coefficient = -adjugate.trace() / static_cast<long double>(k);
    transfer.denominator[kCount - k] = static_cast<double>(coefficient);
    adjugate.diagonal().array() += coefficient;
  }
  return transfer;
}

// Calls take(Motion) with the motion of the loop's plant.
template <typename Take>
auto with_motion(const SampledLoop& loop, const Take& take) {
  PlantParameters p = loop.plant;
  if (p.grip && p.grip_stiffness_n_per_m == 0.0 && p.grip_damping_n_s_per_m == 0.0) {
    p.grip = false;  // the hand holds nothing
    p.hand_stiffness_n_per_m = p.hand_damping_n_s_per_m = 0.0;
  }
  const long double t = loop.period_s;
  if (!p.grip) {
    return p.has_lag() ? take(motion_of<false, true>(p, t)) : take(motion_of<false, false>(p, t));
  }
  return p.has_lag() ? take(motion_of<true, true>(p, t)) : take(motion_of<true, false>(p, t));
}

}  // namespace

PulseTransfer pulse_transfer(const SampledLoop& loop) {
  const long double delay_ticks = static_cast<long double>(loop.delay_s) / loop.period_s;
  return with_motion(loop, [&](const auto& motion) { return transfer_of(motion, delay_ticks); });
}

PlantStep plant_step(const SampledLoop& loop, double periods) {
  return with_motion(loop, [&](const auto& motion) {
    const auto step = step_of(motion, periods);
    const auto size = step.increment.rows();
    const Eigen::MatrixXd increment = step.increment.template cast<double>();
    return PlantStep{increment + Eigen::MatrixXd::Identity(size, size),
                     (step.integral * motion.input).template cast<double>()};
  });
}

}  // namespace hapticwall
