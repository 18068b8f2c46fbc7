// The ticks that wait for the sound, without thread and clock.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "app/runtime/loop/sound_feed.h"
#include "core/sample.h"

namespace hapticwall::sound {

// A session that can be heard.
struct SoundSource {
  std::shared_ptr<runtime::SoundFeed> feed;  // null: none
  double rate_hz = 1000.0;
  bool knows_truth = true;
};

// Older ticks are dropped.
inline constexpr double kMaxBacklogS = 0.05;

class TickTaker {
 public:
  // Drops what waits in the feed, which is not null.
  explicit TickTaker(const SoundSource& source);

  // All ticks that wait; none where they waited too long. Valid until the next call. Realtime-safe:
  // no.
  [[nodiscard]] std::span<const Tick> take();

 private:
  std::shared_ptr<runtime::SoundFeed> feed_;
  double max_backlog_;  // in ticks
  std::vector<Tick> ticks_;
};

}  // namespace hapticwall::sound
