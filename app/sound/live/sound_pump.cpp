#include "app/sound/live/sound_pump.h"

namespace hapticwall::sound {
namespace {

RingLevels levels_for(double loop_hz, const CardFacts& card) {
  const auto period = static_cast<double>(card.period_frames);
  const double spare = (kSpareS + 1.0 / loop_hz) * card.rate_hz;
  return {static_cast<std::size_t>(period + spare), static_cast<std::size_t>(period + 3.0 * spare),
          0.5 * period + spare};
}

}  // namespace

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
