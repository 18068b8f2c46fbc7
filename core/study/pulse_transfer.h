// The pulse transfer function of handle, hand, hold and amplifier, and the same as a step.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "core/study/stable_stiffness.h"

namespace hapticwall {

// Position and speed of the handle and of a gripping hand, and an amplifier's lag.
inline constexpr std::size_t kMaxTransferStates = 5;

// Transfer from the command at the amplifier to the position, as a quotient of polynomials in w = z
// - 1 of which the low powers come first. w keeps the digits of slow motions, which lie close to z
// = 1. Time is in ticks, force in m/T², so that stiffness and damping are K T²/m and B T/m.
struct PulseTransfer {
  std::size_t states = 0;
  double delay_ticks = 0.0;  // whole
  std::array<double, kMaxTransferStates + 1> denominator{};
  // Coefficients for the command that acts to the end of the tick.
  std::array<double, kMaxTransferStates> numerator{};
  // Coefficients for the command before it, if the delay ends within the tick.
  std::array<double, kMaxTransferStates> earlier{};
  bool has_earlier = false;
};

// Realtime-safe: no.
[[nodiscard]] PulseTransfer pulse_transfer(const SampledLoop& loop);

// state' = transition state + input F, in the units of PulseTransfer. The first state is the
// position of the handle; a force pushes along x.
struct PlantStep {
  Eigen::MatrixXd transition;
  Eigen::VectorXd input;
};

// A step of this many periods, without delay. Realtime-safe: no.
[[nodiscard]] PlantStep plant_step(const SampledLoop& loop, double periods);

}  // namespace hapticwall
