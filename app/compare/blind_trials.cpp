#include "app/compare/blind_trials.h"

#include <fmt/format.h>

#include <utility>

#include "core/scene_keys.h"
#include "core/text.h"

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
std::vector<Slot> balanced_order(std::size_t trials, std::uint64_t seed) {
  Random random(seed);
  std::vector<Slot> order(trials);
  for (std::size_t i = 0; i < trials; ++i) order[i] = i % 2 == 0 ? Slot::kA : Slot::kB;
  if (trials % 2 == 1 && random.below(2) == 1) order.back() = Slot::kB;
  for (std::size_t i = trials - 1; i > 0; --i) {
    std::swap(order[i], order[random.below(i + 1)]);
  }
  return order;
}

}  // namespace

Result<BlindTrials> BlindTrials::create(const TrialPlan& plan) {
  if (plan.trials < 1 || plan.trials > kMaxTrials) {
    return usage_error(fmt::format("{} trials: it takes 1 to {}", plan.trials, kMaxTrials));
  }
  if (!(plan.confidence > 0.0 && plan.confidence < 1.0)) {
    return usage_error(
        fmt::format("a confidence of {}: it takes more than 0 and less than 1", plan.confidence));
  }
  return BlindTrials(plan);
}

BlindTrials::BlindTrials(const TrialPlan& plan)
    : plan_(plan), first_(balanced_order(plan.trials, plan.seed)) {
  done_.reserve(plan.trials);
}

Slot BlindTrials::slot_of(Presentation presentation) const {
  const Slot first = first_[done_.size()];
  return presentation == Presentation::kFirst ? first : other(first);
}

Slot BlindTrials::present(Presentation presentation, double now_s) {
  if (looks_++ == 0) began_s_ = now_s;
  (presentation == Presentation::kFirst ? felt_first_ : felt_second_) = true;
  return slot_of(presentation);
}

Failure BlindTrials::choose(Presentation presentation, double now_s) {
  if (finished()) return usage_error("all trials were answered");
  if (!felt_first_ || !felt_second_) return usage_error("feel both before choosing one");
  done_.push_back(
      {first_[done_.size()], slot_of(presentation), std::exchange(looks_, 0), now_s - began_s_});
  felt_first_ = false;
  felt_second_ = false;
  judge();
  return std::nullopt;
}

void BlindTrials::judge() {
  result_ = {};
  for (const Trial& trial : done_) {
    ++result_.trials;
    result_.chose_a += trial.chosen == Slot::kA ? 1U : 0U;
    result_.chose_first += trial.chosen == trial.first ? 1U : 0U;
  }
  result_.a = clopper_pearson(result_.chose_a, result_.trials, plan_.confidence);
  result_.p_value = binomial_two_sided(result_.chose_a, result_.trials);
}

std::string BlindTrials::trials_csv(std::string_view a, std::string_view b) const {
  std::string text =
      "trial,question,seed,a,b,first,second,chosen,chosen_presentation,looks,seconds\n";
  for (std::size_t i = 0; i < done_.size(); ++i) {
    const Trial& trial = done_[i];
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", i + 1, csv_field(plan_.question),
                    plan_.seed, csv_field(a), csv_field(b), slot_name(trial.first),
                    slot_name(other(trial.first)), slot_name(trial.chosen),
                    trial.chosen == trial.first ? 1 : 2, trial.looks, number_text(trial.seconds));
  }
  return text;
}

std::string BlindTrials::result_csv(std::string_view a, std::string_view b) const {
  return fmt::format(
      "question,seed,a,b,planned_trials,trials,chose_a,chose_first,share_a,confidence,share_a_low,"
      "share_a_high,p_value\n{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
      csv_field(plan_.question), plan_.seed, csv_field(a), csv_field(b), plan_.trials,
      result_.trials, result_.chose_a, result_.chose_first, number_text(result_.a.share),
      number_text(plan_.confidence), number_text(result_.a.low), number_text(result_.a.high),
      number_text(result_.p_value));
}

}  // namespace hapticwall::compare
