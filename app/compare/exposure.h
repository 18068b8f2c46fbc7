// The forces that a participant meets in a trial.
#pragma once

#include <cstdint>
#include <optional>

#include "app/file/trials/answer.h"
#include "core/sample.h"

namespace hapticwall::compare {

// Sums over the ticks of a trial. Both axes count as one force; they are in contact together.
class Exposure {
 public:
  // Begins anew.
  void begin() { *this = Exposure(); }
  // Ticks in order. A tick that does not follow the one before, as after a reset or in a slow
  // window, adds no work. The ticks between two such ticks count as lost, except after a reset.
  void add(const Tick& tick, double period_s);
  // Without the recording.
  [[nodiscard]] file::ExposureRow row() const;

 private:
  double period_s_ = 0.0;
  double force_sum_n_ = 0.0;  // over the ticks in contact
  double max_force_n_ = 0.0;
  double energy_to_hand_j_ = 0.0;
  std::uint64_t contact_ticks_ = 0;
  std::uint64_t touches_ = 0;
  std::uint64_t lost_ticks_ = 0;
  std::optional<std::uint64_t> first_tick_;
  Tick before_;  // valid with first_tick_
};

}  // namespace hapticwall::compare
