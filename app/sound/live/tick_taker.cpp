#include "app/sound/live/tick_taker.h"

#include <algorithm>

namespace hapticwall::sound {
namespace {

constexpr double kMinBacklog = 8.0;  // ticks of a slow loop

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

}  // namespace hapticwall::sound
