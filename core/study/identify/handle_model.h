// The model that a fit compares with an experiment:
//
//   m dv/dt = -F_a - b v - f₊ (v > 0) or + f₋ (v < 0),   F_a' = (u - F_a)/τ
//
// u the command of some whole ticks before. The plant of the simulator integrates it, with solved
// instants of stop and breakaway. Unequal frictions are their mean and a constant force.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "core/plant/exact_plant.h"
#include "core/plant/linear_body.h"

namespace hapticwall::identify {

// Order: ln m, b, f₊, f₋, τ in SI units.
inline constexpr int kParameters = 5;
enum Parameter : std::uint8_t { kLogMass, kDamping, kFrictionUp, kFrictionDown, kLag };
using Parameters = std::array<double, kParameters>;

// Positions and the commands that hold from each of them to the next.
struct Record {
  double period_s = 1e-3;
  double encoder_m = 0.0;  // greater than 0
  std::vector<double> position_m;
  std::vector<double> force_n;  // as many values as position_m
};

struct SegmentStart {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
};

// A stretch of the record with a start of its own.
struct Segment {
  std::size_t first = 0;
  std::size_t count = 0;
  SegmentStart start;
};

class HandleModel {
 public:
  // A lag below 0.1 µs counts as none. Realtime-safe: no, none of it.
  HandleModel(const Parameters& parameters, double period_s);

  // The force at the actuator before each command of `force_n`, `delay` ticks late.
  [[nodiscard]] std::vector<double> actuator(std::span<const double> force_n,
                                             std::size_t delay) const;
  // Positions of a segment from `start`. Not finite if the motion has no solution. `actuator_n`:
  // the result of actuator() for the same forces and delay.
  void run(const Segment& segment, SegmentStart start, const std::vector<double>& force_n,
           std::size_t delay, const std::vector<double>& actuator_n,
           std::vector<double>& position_m);

 private:
  using Quick = ExactPlant<LinearBody<double, false, false>, true>;
  using Lagging = ExactPlant<LinearBody<double, false, true>, true>;
  [[nodiscard]] static std::variant<Quick, Lagging> plant(const Parameters& parameters,
                                                          double period_s);

  double bias_n_;
  double held_share_;  // of the actuator's excess after a tick
  std::variant<Quick, Lagging> plant_;
};

}  // namespace hapticwall::identify
