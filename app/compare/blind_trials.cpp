#include "app/compare/blind_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace hapticwall::compare {
namespace {

// SplitMix64 [lit, Steele, Lea & Flood 2014]: the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15;
    constexpr std::uint64_t kFirstFactor = 0xBF58476D1CE4E5B9;
    constexpr std::uint64_t kSecondFactor = 0x94D049BB133111EB;
    std::uint64_t z = state_ += kStep;
    z = (z ^ (z >> 30U)) * kFirstFactor;
    z = (z ^ (z >> 27U)) * kSecondFactor;
    return z ^ (z >> 31U);
  }
  // Uniform in 0 to `count` - 1.
  std::uint64_t below(std::uint64_t count) {
    if (count < 2) return 0;
    const std::uint64_t rest = (~std::uint64_t{0} % count + 1) % count;  // 2^64 mod count
    for (;;) {
      const std::uint64_t value = next();
      if (value >= rest) return value % count;
    }
  }

 private:
  std::uint64_t state_;
};

// Shuffled, with equally many trials that begin with A and B; for an odd number the last one is
// random.
std::vector<Slot> balanced_order(std::size_t trials, Random& random) {
  std::vector<Slot> order(trials);
  for (std::size_t i = 0; i < trials; ++i) order[i] = i % 2 == 0 ? Slot::kA : Slot::kB;
  if (trials % 2 == 1 && random.below(2) == 1) order.back() = Slot::kB;
  for (std::size_t i = trials - 1; i > 0; --i) {
    std::swap(order[i], order[random.below(i + 1)]);
  }
  return order;
}

// Balanced for each pair of slots by itself, in practice and in the test.
std::vector<Slot> first_slots(const TrialPlan& plan) {
  std::map<std::tuple<file::TrialKind, std::string, std::string>, std::vector<std::size_t>> pairs;
  for (std::size_t i = 0; i < plan.trials.size(); ++i) {
    const file::TrialSpec& trial = plan.trials[i];
    pairs[{trial.kind, trial.slots[0], trial.slots[1]}].push_back(i);
  }
  Random random(plan.seed);
  std::vector<Slot> first(plan.trials.size());
  for (const auto& [pair, places] : pairs) {
    const std::vector<Slot> order = balanced_order(places.size(), random);
    for (std::size_t i = 0; i < places.size(); ++i) first[places[i]] = order[i];
  }
  return first;
}

std::size_t count_trials(const TrialPlan& plan) {
  return static_cast<std::size_t>(std::ranges::count_if(
      plan.trials,
      [](const file::TrialSpec& trial) { return trial.kind != file::TrialKind::kBreak; }));
}

}  // namespace

Result<BlindTrials> BlindTrials::create(const TrialPlan& plan) {
  const std::size_t trials = count_trials(plan);
  if (trials < 1 || plan.trials.size() > kMaxTrials) {
    return usage_error(fmt::format("{} trials: it takes 1 to {}",
                                   std::max(trials, plan.trials.size()), kMaxTrials));
  }
  if (!(plan.confidence > 0.0 && plan.confidence < 1.0)) {
    return usage_error(
        fmt::format("a confidence of {}: it takes more than 0 and less than 1", plan.confidence));
  }
  return BlindTrials(plan, false);
}

BlindTrials BlindTrials::begin_open(std::uint64_t seed, double confidence) {
  return {{seed, {}, confidence}, true};
}

BlindTrials::BlindTrials(const TrialPlan& plan, bool open)
    : plan_(plan), first_(first_slots(plan)), open_(open), planned_(count_trials(plan)) {}

// The order of a trial depends on the seed and its place alone, as after a restart.
void BlindTrials::add(const file::TrialSpec& trial) {
  plan_.trials.push_back(trial);
  if (trial.kind == file::TrialKind::kBreak) {
    first_.push_back(Slot::kA);
    return;
  }
  if (planned_ % kBalanced == 0) {
    Random random(plan_.seed + planned_ / kBalanced);
    block_ = balanced_order(kBalanced, random);
  }
  first_.push_back(block_[planned_++ % kBalanced]);
}

Slot BlindTrials::slot_of(Presentation presentation) const {
  const Slot first = first_[place_];
  return presentation == Presentation::kFirst ? first : other(first);
}

void BlindTrials::go_on() {
  if (at_break()) ++place_;
}

Slot BlindTrials::present(Presentation presentation, double now_s) {
  if (looks_++ == 0) began_s_ = now_s;
  (presentation == Presentation::kFirst ? felt_first_ : felt_second_) = true;
  return slot_of(presentation);
}

Result<file::Answer> BlindTrials::answer(Presentation presentation, double now_s) const {
  if (finished()) return usage_error("all trials were answered");
  if (awaits()) return usage_error("the next trial has not come yet");
  if (!felt_first_ || !felt_second_) return usage_error("feel both before choosing one");
  file::Answer answer;
  answer.trial = spec().number;
  answer.block = spec().block;
  answer.kind = spec().kind;
  answer.question = spec().question;
  answer.a = spec().slots[0];
  answer.b = spec().slots[1];
  answer.first = first_[place_];
  answer.chosen = slot_of(presentation);
  if (spec().correct) answer.correct = answer.chosen == *spec().correct;
  answer.looks = looks_;
  answer.seconds = now_s - began_s_;
  answer.seed = plan_.seed;
  answer.extras = spec().extras;
  return answer;
}

void BlindTrials::take() {
  while (at_break()) ++place_;  // skips the breaks of an earlier session
  ++place_;
  ++trial_;
  looks_ = 0;
  felt_first_ = false;
  felt_second_ = false;
}

}  // namespace hapticwall::compare
