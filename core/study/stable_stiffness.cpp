#include "core/study/stable_stiffness.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "core/plant/propagator.h"

namespace hapticwall {
namespace {

using Complex = std::complex<double>;
constexpr std::size_t kMaxStates = 5;

// From the command at the amplifier to the position, as a quotient of polynomials in w = z - 1 of
// which the low powers come first. w keeps the digits of slow motions, which lie close to z = 1.
// Time is in ticks, force in m/T², so that stiffness and damping are K T²/m and B T/m.
struct PulseTransfer {
  std::size_t states = 0;
  double delay_ticks = 0.0;  // whole
  std::array<double, kMaxStates + 1> denominator{};
  std::array<double, kMaxStates> numerator{};  // of the command that acts to the end of the tick
  std::array<double, kMaxStates> earlier{};    // of the one before it, if the delay ends within it
  // Swing of the hand's mass with the handle at rest, where the numerator is nearly 0; per tick.
  double hand_angle = 0.0;
  double hand_decay = 0.0;
};

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

// By Faddeev and LeVerrier, from e^A - 1.
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
  if (late > kSameTick) now = step_of(motion, 1.0L - late).integral * motion.input;
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

PulseTransfer transfer_of(const SampledLoop& loop) {
  PlantParameters p = loop.plant;
  if (p.grip && p.grip_stiffness_n_per_m == 0.0 && p.grip_damping_n_s_per_m == 0.0) {
    p.grip = false;  // the hand holds nothing
    p.hand_stiffness_n_per_m = p.hand_damping_n_s_per_m = 0.0;
  }
  const long double t = loop.period_s;
  const long double delay_ticks = static_cast<long double>(loop.delay_s) / t;
  if (!p.grip) {
    return p.has_lag() ? transfer_of(motion_of<false, true>(p, t), delay_ticks)
                       : transfer_of(motion_of<false, false>(p, t), delay_ticks);
  }
  PulseTransfer transfer = p.has_lag() ? transfer_of(motion_of<true, true>(p, t), delay_ticks)
                                       : transfer_of(motion_of<true, false>(p, t), delay_ticks);
  constexpr double kLeastDecay = 1e-9;
  const double natural =
      loop.period_s *
      std::sqrt((p.grip_stiffness_n_per_m + p.hand_stiffness_n_per_m) / p.hand_mass_kg);
  // The same place on the circle for a swing faster than half the rate.
  transfer.hand_angle = std::abs(std::remainder(natural, 2.0 * std::numbers::pi));
  transfer.hand_decay = std::max(
      kLeastDecay,
      0.5 * loop.period_s * (p.grip_damping_n_s_per_m + p.hand_damping_n_s_per_m) / p.hand_mass_kg);
  return transfer;
}

// The parts of the characteristic equation z^d D + (K + B (1 - 1/z)) N = 0 at z = e^{iθ}.
struct CirclePoint {
  double angle = 0.0;
  Complex delayed;     // z^d D
  Complex numerator;   // N
  Complex difference;  // 1 - 1/z
};

template <std::size_t kSize>
Complex polynomial(const std::array<double, kSize>& coefficients, std::size_t count, Complex w) {
  double re = 0.0;
  double im = 0.0;
  for (std::size_t i = count; i-- > 0;) {
    const double sum = re * w.real() - im * w.imag() + coefficients[i];
    im = re * w.imag() + im * w.real();
    re = sum;
  }
  return {re, im};
}

CirclePoint at_angle(const PulseTransfer& plant, double angle) {
  const double half = std::sin(0.5 * angle);
  const Complex w(-2.0 * half * half, std::sin(angle));
  const Complex to_earlier(1.0 + w.real(), -w.imag());  // 1/z
  CirclePoint point{angle, polynomial(plant.denominator, plant.states + 1, w),
                    polynomial(plant.numerator, plant.states, w), -std::conj(w)};
  point.numerator += to_earlier * polynomial(plant.earlier, plant.states, w);
  if (plant.delay_ticks > 0.0) point.delayed *= std::polar(1.0, plant.delay_ticks * angle);
  return point;
}

// The K that the equation gives, times |N|²; on the limit of stability it is real.
struct StiffnessCurve {
  double damping;

  Complex operator()(const CirclePoint& at) const {
    return -at.delayed * std::conj(at.numerator) -
           damping * std::norm(at.numerator) * at.difference;
  }
};

// The left side of the equation. It turns by π once for each zero within the circle.
struct CharacteristicCurve {
  double stiffness;
  double damping;

  Complex operator()(const CirclePoint& at) const {
    return at.delayed + (stiffness + damping * at.difference) * at.numerator;
  }
};

struct CurvePoint {
  CirclePoint at;
  Complex value;
};

// Goes along the upper half of the circle in pieces on which the curve turns by less than 45°.
template <typename Curve, typename Visit>
class Sweep {
 public:
  Sweep(const PulseTransfer& plant, const Curve& curve, Visit& visit)
      : plant_(plant), curve_(curve), visit_(visit) {}

  void run() {
    constexpr double kPi = std::numbers::pi;
    constexpr double kFirst = 1e-9;
    constexpr double kRatio = 2.0;
    constexpr double kShare = 0.5;
    // A piece that turned by a full circle would pass for one that does not turn.
    const double longest =
        1.5 / (plant_.delay_ticks + 2.0 * static_cast<double>(plant_.states) + 1.0);
    CurvePoint last = point(kFirst);
    while (last.at.angle < kPi) {
      double next = std::min({kRatio * last.at.angle, last.at.angle + longest, kPi});
      // At the hand's own swing a turn and its reverse may follow each other closely.
      if (plant_.hand_angle > 0.0) {
        const double distance = std::abs(last.at.angle - plant_.hand_angle);
        next = std::min(next, last.at.angle + kShare * (distance + plant_.hand_decay));
      }
      const CurvePoint to = point(next);
      piece(last, to, 0);
      last = to;
    }
  }

 private:
  CurvePoint point(double angle) const {
    const CirclePoint at = at_angle(plant_, angle);
    return {at, curve_(at)};
  }
  void piece(const CurvePoint& from, const CurvePoint& to, int depth) const {
    constexpr int kDeepest = 40;
    const Complex turn = to.value * std::conj(from.value);
    if (!(std::abs(turn.imag()) > turn.real()) || depth == kDeepest) return visit_(from, to);
    const CurvePoint middle = point(0.5 * (from.at.angle + to.at.angle));
    piece(from, middle, depth + 1);
    piece(middle, to, depth + 1);
  }

  const PulseTransfer& plant_;
  const Curve& curve_;
  Visit& visit_;
};

template <typename Curve, typename Visit>
void sweep(const PulseTransfer& plant, const Curve& curve, Visit visit) {
  Sweep<Curve, Visit>(plant, curve, visit).run();
}

// Between two angles where the curve crosses the real axis; regula falsi (Illinois).
double stiffness_at_crossing(const PulseTransfer& plant, const StiffnessCurve& curve,
                             const CurvePoint& from, const CurvePoint& to) {
  constexpr int kMaxSteps = 60;
  double a = from.at.angle;
  double b = to.at.angle;
  double at_a = from.value.imag();
  double at_b = to.value.imag();
  CurvePoint found = to;
  for (int i = 0; i < kMaxSteps && at_b != 0.0; ++i) {
    const double angle = b - at_b * (b - a) / (at_b - at_a);
    if (angle == a || angle == b) break;
    const CirclePoint at = at_angle(plant, angle);
    found = {at, curve(at)};
    const double here = found.value.imag();
    if ((here < 0.0) != (at_b < 0.0)) {
      a = b;
      at_a = at_b;
    } else {
      at_a *= 0.5;
    }
    b = angle;
    at_b = here;
  }
  return found.value.real() / std::norm(found.at.numerator);
}

// The smallest positive K for which a zero lies on the circle.
double first_crossing(const PulseTransfer& plant, double damping) {
  double smallest = std::numeric_limits<double>::infinity();
  const StiffnessCurve curve{damping};
  const auto take = [&](double stiffness) {
    if (stiffness > 0.0) smallest = std::min(smallest, stiffness);
  };
  sweep(plant, curve, [&](const CurvePoint& from, const CurvePoint& to) {
    if ((from.value.imag() < 0.0) == (to.value.imag() < 0.0)) return;
    if (std::max(from.value.real(), to.value.real()) <= 0.0) return;
    take(stiffness_at_crossing(plant, curve, from, to));
  });
  const CirclePoint end = at_angle(plant, std::numbers::pi);  // z = -1, where K is always real
  take(curve(end).real() / std::norm(end.numerator));
  return smallest;
}

bool is_stable(const PulseTransfer& plant, double stiffness, double damping) {
  double angle = 0.0;
  sweep(plant, CharacteristicCurve{stiffness, damping},
        [&](const CurvePoint& from, const CurvePoint& to) {
          angle += std::arg(to.value * std::conj(from.value));
        });
  // A zero on the circle that the wall does not move, such as the place where a hand without a
  // spring holds the handle, costs half a turn; one outside costs a whole turn.
  const double whole = std::numbers::pi * (static_cast<double>(plant.states) + plant.delay_ticks);
  return angle > whole - 0.75 * std::numbers::pi;
}

}  // namespace

double largest_stable_stiffness(const SampledLoop& loop) {
  const PulseTransfer plant = transfer_of(loop);
  const double mass_kg = loop.plant.mass_kg;
  const double damping = loop.wall_damping_n_s_per_m * loop.period_s / mass_kg;
  const double stiffness = first_crossing(plant, damping);
  constexpr double kNoStiffness = 1e-20;  // the limit of a loop without any damping is 0
  // Between zero and the first crossing no zero passes the circle.
  if (stiffness < kNoStiffness || !is_stable(plant, 0.5 * stiffness, damping)) return 0.0;
  return stiffness * mass_kg / (loop.period_s * loop.period_s);
}

}  // namespace hapticwall
