#include "core/study/stable_stiffness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "core/study/pulse_transfer.h"

namespace hapticwall {
namespace {

using Complex = std::complex<double>;

// A piece of the upper half of the unit circle; angles in radians.
struct Piece {
  double from = 0.0;
  double to = 0.0;

  [[nodiscard]] double middle() const { return 0.5 * (from + to); }
  [[nodiscard]] double half() const { return 0.5 * (to - from); }
};

// Faster than std::abs(), which guards against overflow.
double magnitude(Complex value) { return std::sqrt(std::norm(value)); }

// A function of the angle on a piece. By Taylor's theorem, no value on the piece differs from the
// middle one by more than reach().
class Enclosure {
 public:
  // Value and derivatives in the middle, and a bound of |third derivative| on the piece.
  Enclosure(double half, Complex value, Complex slope, Complex bend, double third)
      : half_(half),
        value_(value),
        slope_(slope),
        bend_(bend),
        max_third_(third),
        max_bend_(magnitude(bend) + half * third),
        max_slope_(magnitude(slope) + half * (magnitude(bend) + 0.5 * half * third)),
        max_value_(magnitude(value) + reach()) {}

  [[nodiscard]] Complex value() const { return value_; }
  [[nodiscard]] double reach() const { return reach_of(magnitude(slope_), magnitude(bend_)); }
  [[nodiscard]] double reach_re() const { return reach_of(slope_.real(), bend_.real()); }
  [[nodiscard]] double reach_im() const { return reach_of(slope_.imag(), bend_.imag()); }
  [[nodiscard]] bool im_is_monotonic() const {
    return std::abs(slope_.imag()) > half_ * (std::abs(bend_.imag()) + 0.5 * half_ * max_third_);
  }

  [[nodiscard]] Enclosure conjugate() const {
    return {half_, std::conj(value_), std::conj(slope_), std::conj(bend_), max_third_};
  }
  friend Enclosure operator+(const Enclosure& a, const Enclosure& b) {
    return {a.half_, a.value_ + b.value_, a.slope_ + b.slope_, a.bend_ + b.bend_,
            a.max_third_ + b.max_third_};
  }
  friend Enclosure operator+(double a, const Enclosure& b) {
    return {b.half_, a + b.value_, b.slope_, b.bend_, b.max_third_};
  }
  friend Enclosure operator*(double a, const Enclosure& b) {
    return {b.half_, a * b.value_, a * b.slope_, a * b.bend_, std::abs(a) * b.max_third_};
  }
  friend Enclosure operator*(const Enclosure& a, const Enclosure& b) {
    return {a.half_, a.value_ * b.value_, a.slope_ * b.value_ + a.value_ * b.slope_,
            a.bend_ * b.value_ + 2.0 * a.slope_ * b.slope_ + a.value_ * b.bend_,
            a.max_third_ * b.max_value_ + b.max_third_ * a.max_value_ +
                3.0 * (a.max_bend_ * b.max_slope_ + a.max_slope_ * b.max_bend_)};
  }

 private:
  [[nodiscard]] double reach_of(double slope, double bend) const {
    constexpr double kSixth = 1.0 / 6.0;
    return half_ * (std::abs(slope) + half_ * (0.5 * std::abs(bend) + kSixth * half_ * max_third_));
  }

  double half_;
  Complex value_;
  Complex slope_;
  Complex bend_;
  double max_third_;
  double max_bend_;
  double max_slope_;
  double max_value_;
};

// z^turns. The value comes first, because std::polar() is slow.
Enclosure power_of_z(double half, Complex value, double turns) {
  return {half, value, Complex(0.0, turns) * value, -turns * turns * value,
          turns * turns * std::abs(turns)};
}

// Expands the polynomial around `w`, which gives bounds that are tight at a resonance, too.
template <std::size_t kSize>
Enclosure polynomial(const std::array<double, kSize>& coefficients, std::size_t count, Complex w,
                     double half) {
  std::array<Complex, kSize> local{};
  std::copy_n(coefficients.begin(), count, local.begin());
  for (std::size_t done = 0; done + 1 < count; ++done) {
    for (std::size_t i = count - 1; i-- > done;) local.at(i) += w * local.at(i + 1);
  }
  // Bounds of the derivatives by w; they hold because a chord is at most as long as its arc.
  double first = 0.0;
  double second = 0.0;
  double third = 0.0;
  for (std::size_t i = count; i-- > 1;) {
    const auto n = static_cast<double>(i);
    const double term = n * magnitude(local.at(i));
    first = first * half + term;
    if (i > 1) second = second * half + (n - 1.0) * term;
    if (i > 2) third = third * half + (n - 1.0) * (n - 2.0) * term;
  }
  const Complex z = 1.0 + w;
  const Complex slope = z * local[1];
  return {half, local[0], Complex(0.0, 1.0) * slope, -slope - 2.0 * z * z * local[2],
          first + 3.0 * second + third};
}

// The parts of the characteristic equation z^d D Q + (K Q + B (1 - 1/z) P) N = 0 at z = e^{iθ}. The
// estimator of velocity has the transfer function (1 - 1/z) P/(Q T); it is stable, so that the
// factor Q brings no zero outside.
struct CirclePart {
  Enclosure delayed;                 // z^d D Q
  Enclosure numerator;               // N
  Enclosure difference;              // (1 - 1/z) P
  std::optional<Enclosure> divisor;  // Q; nullopt: 1

  // N Q
  [[nodiscard]] Enclosure spring() const { return divisor ? numerator * *divisor : numerator; }
  // The K that the equation gives, times |N Q|²; on the limit of stability it is real.
  [[nodiscard]] Enclosure stiffness(double damping) const {
    return -1.0 * (delayed + damping * (numerator * difference)) * spring().conjugate();
  }
  // The left side of the equation.
  [[nodiscard]] Enclosure characteristic(double stiffness, double damping) const {
    const Enclosure damper = damping * difference;
    const Enclosure wall = divisor ? stiffness * *divisor + damper : stiffness + damper;
    return delayed + wall * numerator;
  }
};

// c_0 + c_1/z + …, with `back` = 1/z in the middle of the piece.
Enclosure delays(std::span<const double> coefficients, Complex back, double half) {
  Complex value;
  Complex slope;
  Complex bend;
  double third = 0.0;
  Complex turned = 1.0;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const auto turns = static_cast<double>(i);
    const Complex term = coefficients[i] * turned;
    value += term;
    slope -= Complex(0.0, turns) * term;
    bend -= turns * turns * term;
    third += turns * turns * turns * std::abs(coefficients[i]);
    turned *= back;
  }
  return {half, value, slope, bend, third};
}

// A tick's loop without the wall: the plant, and the estimator of velocity.
struct OpenLoop {
  PulseTransfer plant;
  VelocityTransfer velocity;
};

void take_estimator(const VelocityTransfer& velocity, Complex back, double half, CirclePart& part) {
  if (velocity.is_difference()) return;
  part.difference =
      part.difference *
      delays(std::span(velocity.numerator).first(velocity.numerator_count), back, half);
  if (velocity.denominator_count == 1) return;
  part.divisor =
      delays(std::span(velocity.denominator).first(velocity.denominator_count), back, half);
  part.delayed = part.delayed * *part.divisor;
}

CirclePart on_piece(const OpenLoop& loop, const Piece& piece) {
  const PulseTransfer& plant = loop.plant;
  const double angle = piece.middle();
  const double half = piece.half();
  const double sine = std::sin(0.5 * angle);
  const Complex w(-2.0 * sine * sine, std::sin(angle));
  const Enclosure to_earlier = power_of_z(half, 1.0 + std::conj(w), -1.0);
  Enclosure delayed = polynomial(plant.denominator, plant.states + 1, w, half);
  if (plant.delay_ticks > 0.0) {
    const Complex turned = std::polar(1.0, plant.delay_ticks * angle);
    delayed = power_of_z(half, turned, plant.delay_ticks) * delayed;
  }
  Enclosure numerator = polynomial(plant.numerator, plant.states, w, half);
  if (plant.has_earlier) {
    numerator = numerator + to_earlier * polynomial(plant.earlier, plant.states, w, half);
  }
  const Complex turn = to_earlier.value();
  const Enclosure difference(half, -std::conj(w), Complex(0.0, 1.0) * turn, turn, 1.0);
  CirclePart part{delayed, numerator, difference, std::nullopt};
  take_estimator(loop.velocity, turn, half, part);
  return part;
}

// Calls `take` for the upper half of the circle from small angles to large ones, and halves the
// pieces that it does not take.
template <typename Take>
void halve(const Piece& piece, int depth, const Take& take) {
  constexpr int kDeepest = 40;
  if (take(piece, depth == kDeepest)) return;
  halve({piece.from, piece.middle()}, depth + 1, take);
  halve({piece.middle(), piece.to}, depth + 1, take);
}
template <typename Take>
void visit_pieces(const Take& take) {
  constexpr double kFirst = 1e-9;
  constexpr double kRatio = 2.0;
  for (double from = kFirst; from < std::numbers::pi;) {
    const double to = std::min(kRatio * from, std::numbers::pi);
    halve({from, to}, 0, take);
    from = to;
  }
}

struct CurvePoint {
  Complex value;
  double spring_squared = 0.0;  // |N Q|²

  [[nodiscard]] double stiffness() const { return value.real() / spring_squared; }
};

CurvePoint point_at(const OpenLoop& loop, double damping, double angle) {
  const CirclePart part = on_piece(loop, {angle, angle});
  return {part.stiffness(damping).value(), std::norm(part.spring().value())};
}

// Stiffness at the crossing of the real axis, on a piece with at most one crossing; regula falsi
// (Illinois). nullopt: no crossing.
std::optional<double> stiffness_at_crossing(const OpenLoop& loop, double damping,
                                            const Piece& piece) {
  constexpr int kMaxSteps = 60;
  double a = piece.from;
  double b = piece.to;
  double at_a = point_at(loop, damping, a).value.imag();
  CurvePoint found = point_at(loop, damping, b);
  double at_b = found.value.imag();
  if ((at_a < 0.0) == (at_b < 0.0)) return std::nullopt;
  for (int i = 0; i < kMaxSteps && at_b != 0.0; ++i) {
    const double angle = b - at_b * (b - a) / (at_b - at_a);
    if (angle == a || angle == b) break;
    found = point_at(loop, damping, angle);
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
  return found.stiffness();
}

// The smallest positive K for which a zero lies on the circle.
double first_crossing(const OpenLoop& loop, double damping) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto take = [&](double stiffness) {
    if (stiffness > 0.0) smallest = std::min(smallest, stiffness);
  };
  visit_pieces([&](const Piece& piece, bool deepest) {
    const CirclePart part = on_piece(loop, piece);
    const Enclosure curve = part.stiffness(damping);
    if (!(std::abs(curve.value().imag()) <= curve.reach_im())) return true;  // or NaN
    if (curve.value().real() + curve.reach_re() <= 0.0) return true;
    if (!curve.im_is_monotonic() && !deepest) return false;
    if (const auto found = stiffness_at_crossing(loop, damping, piece)) take(*found);
    return true;
  });
  take(point_at(loop, damping, std::numbers::pi).stiffness());  // z = -1, where K is always real
  return smallest;
}

// Stability by the argument principle: the left side of the equation turns by π for each zero
// within.
bool is_stable(const OpenLoop& loop, double stiffness, double damping) {
  constexpr double kPi = std::numbers::pi;
  constexpr double kNear = 0.7;  // two neighbours differ by less than a right angle
  double angle = 0.0;
  Complex last = 0.0;
  const auto turn_to = [&](Complex value) {
    if (last != 0.0) angle += std::arg(value * std::conj(last));
    last = value;
  };
  visit_pieces([&](const Piece& piece, bool deepest) {
    const Enclosure left = on_piece(loop, piece).characteristic(stiffness, damping);
    if (left.reach() > kNear * magnitude(left.value()) && !deepest) return false;
    turn_to(left.value());
    return true;
  });
  turn_to(on_piece(loop, {kPi, kPi}).characteristic(stiffness, damping).value());
  // A zero on the circle that the wall does not move, such as the place where a hand without a
  // spring holds the handle, costs half a turn; one outside costs a whole turn.
  const double whole = kPi * (static_cast<double>(loop.plant.states) + loop.plant.delay_ticks);
  return angle > whole - 0.75 * kPi;
}

}  // namespace

double largest_stable_stiffness(const SampledLoop& sampled) {
  const OpenLoop loop{pulse_transfer(sampled), sampled.velocity};
  const double mass_kg = sampled.plant.mass_kg;
  const double damping = sampled.wall_damping_n_s_per_m * sampled.period_s / mass_kg;
  const double stiffness = first_crossing(loop, damping);
  constexpr double kNoStiffness = 1e-20;  // the limit of a loop without any damping is 0
  // Between zero and the first crossing no zero passes the circle.
  if (stiffness < kNoStiffness || !is_stable(loop, 0.5 * stiffness, damping)) return 0.0;
  return stiffness * mass_kg / (sampled.period_s * sampled.period_s);
}

}  // namespace hapticwall
