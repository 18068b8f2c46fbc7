// Blind trials: which of two walls is stiffer? Each trial presents both slots in an order that only
// the seed decides. The trials are those of a trial list.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/file/trials/answers_file.h"
#include "app/file/trials/trial_list.h"
#include "core/result.h"

namespace hapticwall::compare {

using file::kMaxTrials;
using file::other;
using file::Slot;
using file::slot_name;

enum class Presentation : std::uint8_t { kFirst, kSecond };

struct TrialPlan {
  std::uint64_t seed = 1;
  std::vector<file::TrialSpec> trials;  // 1 to kMaxTrials, and breaks between them
  double confidence = 0.95;             // level of the intervals, more than 0 and less than 1
};

// The course of the trials. Deterministic: the same plan gives the same order, in which A and B of
// equal trials are first equally often.
class BlindTrials {
 public:
  // Fails (exit status 2) if the plan is out of range.
  [[nodiscard]] static Result<BlindTrials> create(const TrialPlan& plan);

  // Trials that come one at a time, with add(). Within each kBalanced of them A and B are first
  // equally often, whatever they are.
  [[nodiscard]] static BlindTrials begin_open(std::uint64_t seed, double confidence);
  static constexpr std::size_t kBalanced = 8;

  // Adds a trial or a break. Preconditions: open(), fewer than kMaxTrials rows.
  void add(const file::TrialSpec& trial);
  // No trial will be added.
  void close() { open_ = false; }
  [[nodiscard]] bool open() const { return open_; }
  // True if the next trial was not added yet: there is no present row.
  [[nodiscard]] bool awaits() const { return open_ && place_ == plan_.trials.size(); }

  [[nodiscard]] const TrialPlan& plan() const { return plan_; }
  // Number of trials, breaks not counted; those so far while open()
  [[nodiscard]] std::size_t planned() const { return planned_; }
  // Counted from 0; planned() at the end.
  [[nodiscard]] std::size_t trial() const { return trial_; }
  [[nodiscard]] bool finished() const { return !open_ && trial_ == planned_; }

  // The present row of the list: a trial, or a break. Precondition: neither finished nor awaits().
  [[nodiscard]] std::size_t place() const { return place_; }
  [[nodiscard]] const file::TrialSpec& spec() const { return plan_.trials[place_]; }
  [[nodiscard]] bool at_break() const {
    return !finished() && !awaits() && spec().kind == file::TrialKind::kBreak;
  }
  // Ends the break.
  void go_on();

  // True if this presentation of the present trial was felt.
  [[nodiscard]] bool felt(Presentation presentation) const {
    return presentation == Presentation::kFirst ? felt_first_ : felt_second_;
  }

  // Presents this wall at this time (seconds of any monotonic clock). Returns its slot, for the
  // session only. Precondition: neither finished nor at a break nor awaits().
  Slot present(Presentation presentation, double now_s);

  // The answer to the present trial, with everything known about it. Fails (exit status 2) before
  // both slots were felt, at a break, and after the end.
  [[nodiscard]] Result<file::Answer> answer(Presentation presentation, double now_s) const;
  // The present trial is answered, now or in a session before: starts the next one. Skips breaks.
  // Precondition: not finished, and not awaits().
  void take();

 private:
  BlindTrials(const TrialPlan& plan, bool open);
  [[nodiscard]] Slot slot_of(Presentation presentation) const;

  TrialPlan plan_;
  std::vector<Slot> first_;  // slot of the first presentation, for every row
  bool open_ = false;
  std::vector<Slot> block_;  // first slots of the present kBalanced trials
  std::size_t planned_ = 0;
  std::size_t trial_ = 0;
  std::size_t place_ = 0;
  bool felt_first_ = false;
  bool felt_second_ = false;
  std::uint32_t looks_ = 0;
  double began_s_ = 0.0;
};

}  // namespace hapticwall::compare
