// The experiment of `identify` in the place of an algorithm.
#pragma once

#include <atomic>
#include <cstdint>

#include "core/identify/experiment.h"
#include "core/loop/tick_law.h"

namespace hapticwall::command {

// The loop calls step(); the owner's thread calls the rest.
class ExperimentLaw final : public TickLaw {
 public:
  explicit ExperimentLaw(const identify::ExperimentSettings& settings) : experiment_(settings) {}

  // Zero force before begin() and after the end.
  [[nodiscard]] double step(const StabiliserInput& input) override {
    if (!begun_.load(std::memory_order_relaxed)) {
      ++first_tick_;
      return 0.0;
    }
    const double force_n = experiment_.step(input.position_m);
    if (experiment_.facts().state != identify::ExperimentState::kRunning) {
      ended_.store(true, std::memory_order_release);
    }
    return force_n;
  }

  void begin() { begun_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool ended() const { return ended_.load(std::memory_order_acquire); }
  // Of the session, at which the experiment began. Precondition of both: the loop is over, or
  // ended().
  [[nodiscard]] std::uint64_t first_tick() const { return first_tick_; }
  [[nodiscard]] const identify::ExperimentFacts& facts() const { return experiment_.facts(); }

 private:
  identify::Experiment experiment_;
  std::uint64_t first_tick_ = 0;
  std::atomic<bool> begun_{false};
  std::atomic<bool> ended_{false};
};

}  // namespace hapticwall::command
