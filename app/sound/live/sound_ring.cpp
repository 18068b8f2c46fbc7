#include "app/sound/live/sound_ring.h"

#include <algorithm>

namespace hapticwall::sound {
namespace {

constexpr float kFadeIn = 0.004F;  // a sample
constexpr float kFadeOut = 0.98F;  // factor from a sample to the next

}  // namespace

void SoundRing::plan(const RingLevels& levels) {
  max_.store(levels.max, std::memory_order_relaxed);
  start_.store(levels.start, std::memory_order_relaxed);
}

void SoundRing::fill(std::span<float> out) {
  calls_.fetch_add(1, std::memory_order_relaxed);
  bool plays = ready();
  for (float& sample : out) {
    plays = plays && samples_.try_pop(last_);
    fade_ = plays ? std::min(1.0F, fade_ + kFadeIn) : fade_ * kFadeOut;
    sample = fade_ * last_;
  }
  playing_.store(plays, std::memory_order_relaxed);
}

bool SoundRing::ready() {
  const std::size_t start = start_.load(std::memory_order_relaxed);
  float dropped = 0.0F;
  if (size() > max_.load(std::memory_order_relaxed)) {
    while (size() > start && samples_.try_pop(dropped)) {
    }
  }
  return playing() || size() >= start;
}

}  // namespace hapticwall::sound
