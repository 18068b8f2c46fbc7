// sin and exp from sums, products and quotients alone, whose rounding IEEE 754 fixes. The functions
// of a C library differ from library to library in the last digit, and a run must have the same
// bits everywhere.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace hapticwall {

// sin(2π t), within 3e-16 of the exact value of this double, times 2π |t| where |t| is large.
// Realtime-safe: yes.
[[nodiscard]] inline double sine_of_turns(double turns) {
  double t = turns - std::floor(turns + 0.5);  // within ±1/2, exact
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  constexpr double kTwoPi = 6.283185307179586;
  const double x = kTwoPi * t;  // within ±π/2
  const double square = x * x;
  // 1 - x²/(2·3) (1 - x²/(4·5) (...)): Taylor's series up to x²³, whose rest is below 1e-18.
  double sum = 1.0;
  for (int i = 22; i >= 2; i -= 2) sum = 1.0 - square / static_cast<double>(i * (i + 1)) * sum;
  return x * sum;
}

// exp(-s) for s ≥ 0, within 4e-16 of its value in relative terms where s is at most 1; beyond, the
// rounding of s adds s 1e-16. 0 beyond 700. Realtime-safe: yes.
[[nodiscard]] inline double exp_of_minus(double s) {
  if (!(s < 700.0)) return 0.0;
  constexpr double kLn2High = 0.693147180369123816490;  // 32 bits, so that n times it is exact
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  const double n = std::floor(s * 1.4426950408889634);
  const double rest = (s - n * kLn2High) - n * kLn2Low;  // within 0 and ln 2, up to rounding
  // 1 - r (1 - r/2 (1 - r/3 (...))) up to r^20/20!, below 1e-21.
  double sum = 1.0;
  for (int i = 20; i >= 1; --i) sum = 1.0 - rest / static_cast<double>(i) * sum;
  return std::ldexp(sum, -static_cast<int>(n));
}

}  // namespace hapticwall
