#include "app/sound/live/sound_pump.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hapticwall::sound {
namespace {

constexpr double kMinBacklog = 8.0;  // ticks of a slow loop

constexpr double kFirstHz = 20.0;
constexpr double kStep = 4.0;  // factor from the corner of a part to the next
constexpr double kRms = 0.2;

RingLevels levels_for(double loop_hz, const CardFacts& card) {
  const auto period = static_cast<double>(card.period_frames);
  const double spare = (kSpareS + 1.0 / loop_hz) * card.rate_hz;
  return {static_cast<std::size_t>(period + spare), static_cast<std::size_t>(period + 3.0 * spare),
          0.5 * period + spare};
}

}  // namespace

TickTaker::TickTaker(const SoundSource& source)
    : feed_(source.feed), max_backlog_(std::max(kMinBacklog, kMaxBacklogS * source.rate_hz)) {
  static_cast<void>(take());
}

// A tick that follows a gap counts as the first one.
std::span<const Tick> TickTaker::take() {
  const bool late = static_cast<double>(feed_->ticks.size()) > max_backlog_;
  ticks_.clear();
  for (Tick tick; feed_->ticks.try_pop(tick);) ticks_.push_back(tick);
  if (late) ticks_.clear();
  return ticks_;
}

// Each part is white noise behind a low-pass; equal power of all gives a slope of 3 dB an octave.
MaskingNoise::MaskingNoise(double rate_hz) {
  double corner_hz = kFirstHz;
  for (Part& part : parts_) {
    part.share = 1.0 - std::exp(-2.0 * std::numbers::pi * corner_hz / rate_hz);
    // Variance of its output: share / (2 - share) of 1/3.
    part.gain = kRms * std::sqrt(3.0 * (2.0 - part.share) / part.share /
                                 static_cast<double>(parts_.size()));
    corner_hz *= kStep;
  }
}

double MaskingNoise::next() {
  double sum = 0.0;
  for (Part& part : parts_) {
    // Knuth's linear congruential generator; its upper bits are good enough to be heard.
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    const double white = static_cast<double>(state_ >> 11U) * 0x1p-52 - 1.0;
    part.value += part.share * (white - part.value);
    sum += part.gain * part.value;
  }
  return soft_limited(sum);
}

SoundPump::SoundPump(const SoundSource& source, const CardFacts& card, SoundRing& ring)
    : loop_hz_(source.rate_hz),
      card_(card),
      ring_(ring),
      levels_(levels_for(loop_hz_, card)),
      stream_(loop_hz_, card.rate_hz, source.knows_truth),
      noise_(card.rate_hz) {
  ring_.plan(levels_);
}

void SoundPump::step(std::span<const Tick> ticks, const SoundMix& mix) {
  if (ticks.empty()) return;
  for (const Tick& tick : ticks) stream_.take(tick, samples_);
  mix_in(mix);
  for (const float sample : samples_) static_cast<void>(ring_.push(sample));
  samples_.clear();
  if (!ring_.playing()) return;
  const double excess_s = (static_cast<double>(ring_.size()) - levels_.mean) / card_.rate_hz;
  stream_.correct(drift_.update(excess_s, static_cast<double>(ticks.size()) / loop_hz_));
}

double SoundPump::latency_s() const {
  const auto period = static_cast<double>(card_.period_frames);
  const double ring_s = (levels_.mean + 0.5 * period) / card_.rate_hz + drift_.excess_s();
  return stream_.delay_s() + 0.5 * kPumpPeriodS + ring_s + card_.latency_s;
}

void SoundPump::mix_in(const SoundMix& mix) {
  for (float& sample : samples_) {
    const double signal = mix.masked ? noise_.next() : static_cast<double>(sample);
    sample = static_cast<float>(mix.volume * signal);
  }
}

}  // namespace hapticwall::sound
