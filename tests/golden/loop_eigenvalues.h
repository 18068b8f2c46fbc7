// The sampled loop of a wall by a second derivation, which shares only the scene's numbers with the
// program: a matrix of the tick with all commands on their way, and its eigenvalues in long double.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

#include "core/scene.h"

namespace hapticwall::testing {

class LoopEigenvalues {
 public:
  // Takes the first wall, with its damping. `delay_s` replaces the scene's delay.
  LoopEigenvalues(const Scene& scene, double delay_s);

  // The largest |eigenvalue| of a tick; above 1 the loop is unstable.
  [[nodiscard]] long double growth(long double stiffness_n_per_m) const;

  // m/T²
  [[nodiscard]] double unit_n_per_m() const { return static_cast<double>(unit_n_per_m_); }

 private:
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

  long double unit_n_per_m_;
  Matrix without_wall_;
  Matrix by_wall_;  // its change by a wall of one unit
};

// Random numbers that are the same with any standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) / 0x1p53;
  }
  double ratio(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
  int upto(int most) { return static_cast<int>(between(0.0, most + 1.0 - 1e-9)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hapticwall::testing
