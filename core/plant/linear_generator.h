// Set-up of a body's steps: its equations of motion as a matrix, and the rows that it gives.
#pragma once

#include <array>
#include <cstddef>

#include "core/plant/linear_motion.h"
#include "core/plant/plant_parameters.h"
#include "core/plant/propagator.h"

namespace hapticwall {

// The equations in scaled states, with time in ticks. `unit` converts each state to SI.
template <std::size_t kStates>
struct LinearGenerator {
  static constexpr int kCore = static_cast<int>(kStates);
  static constexpr int kVelocity = kCore;       // v - v(0), m/s
  static constexpr int kHandForce = kCore + 1;  // (F_h - F_h(0)) T/m
  static constexpr int kSize = kCore + 2;
  using Matrix = SetupMatrix<kSize>;

  Matrix matrix = Matrix::Zero();
  std::array<long double, kStates> unit{};
  long double period_s;
  long double mass_kg;  // m
  long double time_constant_s;

  LinearGenerator(const PlantParameters& parameters, long double period)
      : period_s(period),
        mass_kg(parameters.mass_kg),
        time_constant_s(parameters.time_constant_s) {}

  template <bool kLag>
  [[nodiscard]] static auto weights() {
    Matrix square = Matrix::Zero();
    square(kVelocity, kVelocity) = 1.0L;
    Matrix product = Matrix::Zero();
    product(kVelocity, kHandForce) = product(kHandForce, kVelocity) = 0.5L;
    if constexpr (kLag) {
      Matrix excess = Matrix::Zero();
      excess(kCore - 1, kVelocity) = excess(kVelocity, kCore - 1) = 0.5L;
      return std::array{square, product, excess};
    } else {
      return std::array{square, product};
    }
  }

  template <typename Real>
  [[nodiscard]] std::array<Real, kStates> row(const Matrix& matrix_of_step, int output,
                                              long double scale) const {
    std::array<Real, kStates> numbers{};
    for (std::size_t i = 0; i < kStates; ++i) {
      numbers[i] = static_cast<Real>(matrix_of_step(output, static_cast<int>(i)) * unit[i] * scale);
    }
    return numbers;
  }

  template <typename Real>
  [[nodiscard]] SymmetricForm<Real, kStates> form(const Matrix& integral, long double scale) const {
    SymmetricForm<Real, kStates> numbers{};
    std::size_t k = 0;
    for (std::size_t i = 0; i < kStates; ++i) {
      for (std::size_t j = i; j < kStates; ++j) {
        const long double twice = i == j ? 1.0L : 2.0L;
        numbers[k++] = static_cast<Real>(
            twice * integral(static_cast<int>(i), static_cast<int>(j)) * unit[i] * unit[j] * scale);
      }
    }
    return numbers;
  }

  template <typename Real, bool kLag, std::size_t kWeights>
  void fill(LinearRows<Real, kLag, kStates>& rows, const Propagator<kSize, kWeights>& step,
            long double duration_s) const {
    rows.duration_s = static_cast<Real>(duration_s);
    rows.velocity = row<Real>(step.increment, kVelocity, 1.0L);
    rows.drift = row<Real>(step.integral, kVelocity, period_s);
    rows.hand_force_drift = row<Real>(step.integral, kHandForce, mass_kg);
    rows.square = form<Real>(step.integrals[0], period_s);
    rows.hand_work = form<Real>(step.integrals[1], mass_kg);
    if constexpr (kLag) {
      rows.lag = {duration_s, time_constant_s};
      for (std::size_t i = 0; i < kStates; ++i) {
        const long double twice = i + 1 == kStates ? 1.0L : 2.0L;
        rows.lag.cross[i] = static_cast<Real>(
            twice * step.integrals[2](kCore - 1, static_cast<int>(i)) * unit[i] * period_s);
      }
    }
  }
};

}  // namespace hapticwall
