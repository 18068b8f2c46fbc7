// Which of two walls is stiffer, steadier, better? Asked blindly: two presentations a trial, one of
// each slot, in an order that nobody sees and that the seed decides alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/runtime/comparison_statistics.h"
#include "core/result.h"

namespace hapticwall::runtime {

enum class Slot : std::uint8_t { kA, kB };
enum class Presentation : std::uint8_t { kFirst, kSecond };

[[nodiscard]] constexpr Slot other(Slot slot) { return slot == Slot::kA ? Slot::kB : Slot::kA; }
[[nodiscard]] constexpr std::string_view slot_name(Slot slot) {
  return slot == Slot::kA ? "A" : "B";
}

inline constexpr std::size_t kMostTrials = 1000;

struct TrialPlan {
  std::uint64_t seed = 1;
  std::size_t trials = 20;  // 1 to kMostTrials
  std::string question = "Which wall is stiffer?";
  double confidence = 0.95;  // of the interval, more than 0 and less than 1
};

// One trial as it went.
struct Trial {
  Slot first = Slot::kA;  // what the first presentation was
  Slot chosen = Slot::kA;
  std::uint32_t looks = 0;  // how many presentations were felt before the choice
  double seconds = 0.0;     // from the first of them to the choice
};

struct TrialResult {
  std::uint32_t trials = 0;  // answered
  std::uint32_t chose_a = 0;
  std::uint32_t chose_first = 0;  // whichever that was: far from a half, the order was judged
  Proportion a;                   // the share of A, with its exact interval
  double p_value = 1.0;           // two-sided, against choosing by chance
};

// The course of a blind comparison. Deterministic: the same plan, the same order.
class BlindTrials {
 public:
  // Fails (exit status 2) where the plan is out of its range.
  [[nodiscard]] static Result<BlindTrials> create(const TrialPlan& plan);

  [[nodiscard]] const TrialPlan& plan() const { return plan_; }
  // Counted from 0; plan().trials once it is over.
  [[nodiscard]] std::size_t trial() const { return done_.size(); }
  [[nodiscard]] bool finished() const { return done_.size() == plan_.trials; }

  // Of the trial that goes on now.
  [[nodiscard]] bool felt(Presentation presentation) const {
    return presentation == Presentation::kFirst ? felt_first_ : felt_second_;
  }

  // Someone feels this presentation now, at this time (seconds from any instant that stays the
  // same, never going back). Returns what it is: for the session, not for eyes. Precondition: not
  // finished.
  Slot present(Presentation presentation, double now_s);

  // The answer; goes on to the next trial. Fails (exit status 2) before both were felt, and once it
  // is over.
  [[nodiscard]] Failure choose(Presentation presentation, double now_s);

  // Of the trials that were answered. Looking before the end is possible, and an experimenter's
  // own responsibility.
  [[nodiscard]] const std::vector<Trial>& trials() const { return done_; }
  [[nodiscard]] const TrialResult& result() const { return result_; }

  // A line a trial: trial,question,seed,a,b,first,second,chosen,chosen_presentation,looks,seconds.
  // `a` and `b` say what the slots held.
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

}  // namespace hapticwall::runtime
