// The ticks that become sound. They have a queue of their own: plots and rows never wait for it.
#pragma once

#include <atomic>
#include <cstddef>

#include "app/session/loop/spsc_queue.h"
#include "core/sample.h"

namespace hapticwall::session {

struct SoundFeed {
  explicit SoundFeed(std::size_t capacity) : ticks(capacity) {}

  SpscQueue<Tick> ticks;            // loop to sound; a tick that finds no room is dropped
  std::atomic<bool> wanted{false};  // set by the sound; without it the loop pushes nothing
};

}  // namespace hapticwall::session
