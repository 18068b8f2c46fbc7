// Blind trials: which of two walls is stiffer? Each trial presents both slots in an order that only
// the seed decides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/compare/binomial.h"
#include "core/result.h"

namespace hapticwall::compare {

enum class Slot : std::uint8_t { kA, kB };
enum class Presentation : std::uint8_t { kFirst, kSecond };

[[nodiscard]] constexpr Slot other(Slot slot) { return slot == Slot::kA ? Slot::kB : Slot::kA; }
[[nodiscard]] constexpr std::string_view slot_name(Slot slot) {
  return slot == Slot::kA ? "A" : "B";
}

inline constexpr std::size_t kMaxTrials = 1000;

struct TrialPlan {
  std::uint64_t seed = 1;
  std::size_t trials = 20;  // 1 to kMaxTrials
  std::string question = "Which wall is stiffer?";
  double confidence = 0.95;  // of the interval, more than 0 and less than 1
};

// One answered trial.
struct Trial {
  Slot first = Slot::kA;  // slot of the first presentation
  Slot chosen = Slot::kA;
  std::uint32_t looks = 0;  // presentations felt before the choice
  double seconds = 0.0;     // from the first of them to the choice
};

struct TrialResult {
  std::uint32_t trials = 0;  // answered
  std::uint32_t chose_a = 0;
  std::uint32_t chose_first = 0;  // far from one half, the order was judged
  Proportion a;                   // the share of A, with its exact interval
  double p_value = 1.0;           // two-sided, against choosing by chance
};

// The course of the trials. Deterministic: the same plan gives the same order.
class BlindTrials {
 public:
  // Fails (exit status 2) if the plan is out of range.
  [[nodiscard]] static Result<BlindTrials> create(const TrialPlan& plan);

  [[nodiscard]] const TrialPlan& plan() const { return plan_; }
  // Counted from 0; plan().trials at the end.
  [[nodiscard]] std::size_t trial() const { return done_.size(); }
  [[nodiscard]] bool finished() const { return done_.size() == plan_.trials; }

  // Of the present trial.
  [[nodiscard]] bool felt(Presentation presentation) const {
    return presentation == Presentation::kFirst ? felt_first_ : felt_second_;
  }

  // Presents this wall at this time (seconds of any monotonic clock). Returns its slot, for the
  // session only. Precondition: not finished.
  Slot present(Presentation presentation, double now_s);

  // Answers the trial and starts the next one. Fails (exit status 2) before both were felt, and
  // after the end.
  [[nodiscard]] Failure choose(Presentation presentation, double now_s);

  // The answered trials. Looking before the end is the responsibility of the experimenter.
  [[nodiscard]] const std::vector<Trial>& trials() const { return done_; }
  [[nodiscard]] const TrialResult& result() const { return result_; }

  // One line per trial:
  // trial,question,seed,a,b,first,second,chosen,chosen_presentation,looks,seconds. `a` and `b`
  // describe the slots.
  [[nodiscard]] std::string trials_csv(std::string_view a, std::string_view b) const;
  // One line: question,seed,a,b,planned_trials,trials,chose_a,chose_first,share_a,confidence,
  // share_a_low,share_a_high,p_value.
  [[nodiscard]] std::string result_csv(std::string_view a, std::string_view b) const;

 private:
  explicit BlindTrials(const TrialPlan& plan);
  [[nodiscard]] Slot slot_of(Presentation presentation) const;
  void judge();

  TrialPlan plan_;
  std::vector<Slot> first_;  // of every trial
  std::vector<Trial> done_;
  TrialResult result_;
  bool felt_first_ = false;
  bool felt_second_ = false;
  std::uint32_t looks_ = 0;
  double began_s_ = 0.0;
};

}  // namespace hapticwall::compare
