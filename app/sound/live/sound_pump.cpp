#include "app/sound/live/sound_pump.h"

#include <algorithm>
#include <utility>

namespace hapticwall::sound {
namespace {

constexpr double kMinBacklog = 8.0;  // ticks of a slow loop

RingLevels levels_for(double loop_hz, const CardFacts& card) {
  const auto period = static_cast<double>(card.period_frames);
  const double spare = (kSpareS + 1.0 / loop_hz) * card.rate_hz;
  return {static_cast<std::size_t>(period + spare), static_cast<std::size_t>(period + 3.0 * spare),
          0.5 * period + spare};
}

}  // namespace

SoundPump::SoundPump(SoundSource source, const CardFacts& card, SoundRing& ring)
    : source_(std::move(source)),
      card_(card),
      ring_(ring),
      levels_(levels_for(source_.rate_hz, card)),
      stream_(source_.rate_hz, card.rate_hz, source_.knows_truth),
      noise_(card.rate_hz) {
  Tick old;
  while (source_.feed->ticks.try_pop(old)) {
  }
  ring_.plan(levels_);
}

void SoundPump::step(const SoundMix& mix) {
  const std::size_t ticks = take_ticks();
  if (ticks == 0) return;
  mix_in(mix);
  for (const float sample : samples_) static_cast<void>(ring_.push(sample));
  samples_.clear();
  if (!ring_.playing()) return;
  const double excess_s = (static_cast<double>(ring_.size()) - levels_.mean) / card_.rate_hz;
  stream_.correct(drift_.update(excess_s, static_cast<double>(ticks) / source_.rate_hz));
}

double SoundPump::latency_s() const {
  const auto period = static_cast<double>(card_.period_frames);
  const double ring_s = (levels_.mean + 0.5 * period) / card_.rate_hz + drift_.excess_s();
  return stream_.delay_s() + 0.5 * kPumpPeriodS + ring_s + card_.latency_s;
}

// A tick that follows a gap counts as the first one.
std::size_t SoundPump::take_ticks() {
  const double max = std::max(kMinBacklog, kMaxBacklogS * source_.rate_hz);
  const bool late = static_cast<double>(source_.feed->ticks.size()) > max;
  std::size_t count = 0;
  for (Tick tick; source_.feed->ticks.try_pop(tick); ++count) {
    if (!late) stream_.take(tick, samples_);
  }
  return late ? 0 : count;
}

void SoundPump::mix_in(const SoundMix& mix) {
  for (float& sample : samples_) {
    const double signal = mix.masked ? noise_.next() : static_cast<double>(sample);
    sample = static_cast<float>(mix.volume * signal);
  }
}

}  // namespace hapticwall::sound
