#include "app/session/loop/obedience.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::session {
namespace {

constexpr double kChunkS = 1e-3;
constexpr double kSpanS = 0.05;
constexpr double kLowLevel = 0.2;
constexpr double kMaxDelayS = 0.02;
// A smaller step of the force, as a share of the mean force, shows nothing.
constexpr double kMinStep = 0.2;
// Number of chunks whose mean is a position.
constexpr std::uint64_t kMeanChunks = 8;
// A smaller response counts as none.
constexpr double kMinResponseCounts = 1.0;
constexpr double kMinResponseM = 0.05e-3;
// The responses in a row differ by no more than this factor.
constexpr double kLike = 12.0;
constexpr std::uint32_t kStepsToObey = 5;
constexpr std::uint32_t kStepsToDisobey = 9;
constexpr std::uint32_t kStepsToGrow = 3;
constexpr double kGrowth = 1.5;

}  // namespace

Obedience::Obedience(double encoder_m, double rate_hz, double untried_share)
    : encoder_m_(encoder_m),
      rate_hz_(rate_hz),
      untried_share_(untried_share),
      ramp_step_(1.0 / std::max(1.0, kObeyedRampS * rate_hz)),
      chunk_ticks_(static_cast<std::uint32_t>(std::max(1.0, std::round(kChunkS * rate_hz)))),
      span_(static_cast<std::uint64_t>(
          std::max(2.0, std::round(kSpanS * rate_hz / static_cast<double>(chunk_ticks_))))),
      share_(untried_share),
      word_(untried_share < 1.0 ? Word::kUnknown : Word::kObeys) {}

void Obedience::begin() {
  const std::uint32_t random = random_;
  *this = Obedience(encoder_m_, rate_hz_, untried_share_);
  random_ = random;
}

void Obedience::hear(double position_m, double force_n, double delay_s) {
  if (word_ == Word::kObeys) share_ = std::min(1.0, share_ + ramp_step_);
  if (word_ != Word::kUnknown) return;
  mixed_ = mixed_ || force_n == 0.0 || sum_n_ * force_n < 0.0;
  sum_n_ += force_n;
  if (++ticks_ < chunk_ticks_) return;
  end_chunk(position_m, delay_s);
}

void Obedience::end_chunk(double position_m, double delay_s) {
  chunks_[count_ % kChunks] = {position_m, sum_n_ / static_cast<double>(ticks_), !mixed_};
  ++count_;
  ticks_ = 0;
  sum_n_ = 0.0;
  mixed_ = false;
  const double chunk_s = kSpanS / static_cast<double>(span_);
  const auto delay =
      static_cast<std::uint64_t>(std::round(std::clamp(delay_s, 0.0, kMaxDelayS) / chunk_s));
  if (!weighed_ && count_ > step_ + span_ + delay) {
    weighed_ = true;
    weigh(step_, delay);
  }
  if (count_ >= next_switch_ && weighed_) switch_force();
}

// The steps come at uneven times, so that no tremor follows them.
void Obedience::switch_force() {
  constexpr std::uint32_t kMultiplier = 1664525;
  constexpr std::uint32_t kIncrement = 1013904223;
  random_ = random_ * kMultiplier + kIncrement;
  high_ = !high_;
  step_ = count_;
  next_switch_ = count_ + 2 * span_ + (random_ >> 16U) % span_;
  weighed_ = false;
}

double Obedience::mean_force(std::uint64_t begin) const {
  double sum_n = 0.0;
  for (std::uint64_t i = begin; i < begin + span_; ++i) sum_n += at(i).force_n;
  return sum_n / static_cast<double>(span_);
}

bool Obedience::pushes_throughout(std::uint64_t begin, std::uint64_t end) const {
  const double sign = at(begin).force_n;
  for (std::uint64_t i = begin; i < end; ++i) {
    if (!at(i).pushes || at(i).force_n * sign <= 0.0) return false;
  }
  return true;
}

// The third difference leaves a constant acceleration of the hand out. The new level first acts in
// the chunk `step`.
void Obedience::weigh(std::uint64_t step, std::uint64_t delay) {
  if (step + delay < 2 * span_ + 1 || step < 2 * span_) return;
  if (!pushes_throughout(step - 2 * span_, step + span_)) return;
  const double before_n = mean_force(step - span_);
  const double after_n = mean_force(step);
  const double step_n = after_n - before_n;
  if (std::abs(step_n) < kMinStep * std::max(std::abs(before_n), std::abs(after_n))) return;
  const std::uint64_t here = step + delay;
  const double moved_m =
      place(here + span_) - 3.0 * place(here) + 3.0 * place(here - span_) - place(here - 2 * span_);
  count(moved_m, step_n);
}

// Mean position before chunk `end`.
double Obedience::place(std::uint64_t end) const {
  const std::uint64_t chunks = std::min({kMeanChunks, span_, end});
  double sum_m = 0.0;
  for (std::uint64_t i = end - chunks; i < end; ++i) sum_m += at(i).position_m;
  return sum_m / static_cast<double>(chunks);
}

void Obedience::count(double moved_m, double step_n) {
  const bool shows = std::abs(moved_m) >= kMinResponseCounts * encoder_m_ + kMinResponseM;
  none_ = shows ? 0 : none_ + 1;
  if (none_ > 0 && none_ % kStepsToGrow == 0)
    share_ = std::max(untried_share_, std::min(kMaxUntriedShare, share_ * kGrowth));
  if (!shows) return;
  const bool obeys = moved_m * step_n < 0.0;  // a positive force moves to smaller positions
  const double m_per_n = std::abs(moved_m / step_n);
  std::uint32_t& row = obeys ? with_ : against_;
  (obeys ? against_ : with_) = 0;
  least_m_per_n_ = row == 0 ? m_per_n : std::min(least_m_per_n_, m_per_n);
  most_m_per_n_ = row == 0 ? m_per_n : std::max(most_m_per_n_, m_per_n);
  ++row;
  if (most_m_per_n_ > kLike * least_m_per_n_) {
    row = 1;
    least_m_per_n_ = most_m_per_n_ = m_per_n;
  }
  if (with_ >= kStepsToObey) word_ = Word::kObeys;
  if (against_ >= kStepsToDisobey) word_ = Word::kDisobeys;
}

double Obedience::level() const { return word_ == Word::kObeys || high_ ? 1.0 : kLowLevel; }

}  // namespace hapticwall::session
