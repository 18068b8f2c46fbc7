// The data that the owner's thread and the loop's exchange: no mutex, no allocation after set-up,
// and neither side waits for the other.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "app/session/loop/latency_histogram.h"
#include "app/session/loop/led_hand.h"
#include "app/session/loop/snapshot.h"
#include "app/session/loop/sound_feed.h"
#include "app/session/loop/spsc_queue.h"
#include "core/plant/plant_model.h"
#include "core/sample.h"
#include "core/tick/servo_step.h"
#include "core/tick/triple_buffer.h"

namespace hapticwall::session {

// Controller and plant, which change at the same tick. The owner numbers them from 1; the loop puts
// the number into its samples.
struct LoopParameters {
  struct Axis {
    ServoSettings servo;
    // Built by the owner, used by the loop, and freed by the owner once a later generation is
    // echoed. nullptr: the device's own plant.
    PlantModel* plant = nullptr;
  };
  std::array<Axis, kMaxAxes> axes;  // one for each device of the loop; the others are unused
  std::uint32_t generation = 1;
};

enum class CommandKind : std::uint8_t {
  kPause,
  kResume,
  kStep,
  kSlow,
  kReset,
  kArm,
  kDisarm,
  kStartRecording,
  kStopRecording
};

struct Command {
  CommandKind kind = CommandKind::kPause;
  std::uint32_t ticks = 0;  // kStep: number of ticks; kSlow: periods per tick
};

// The tick at which a generation took effect. Sent for every change, and for tick 0 after a reset.
struct ParameterEcho {
  std::uint64_t tick = 0;
  std::uint32_t generation = 0;
};

inline constexpr std::size_t kCommandQueueCapacity = 256;
inline constexpr std::size_t kEchoQueueCapacity = 64;
// The loop takes no commands and parameters while fewer echoes than this fit, so that none is lost.
// One cycle sends at most one.
inline constexpr std::size_t kFreeEchoPlaces = kEchoQueueCapacity / 2;

inline constexpr std::size_t kHandMoveQueueCapacity = 256;

struct Exchange {
  Exchange(const QueueCapacities& capacities, const LoopParameters& initial)
      : parameters(initial),
        plot(capacities.plot),
        recorder(capacities.recorder),
        sound(std::make_shared<SoundFeed>(capacities.sound)) {}

  // Owner to loop.
  TripleBuffer<LoopParameters> parameters;
  SpscQueue<Command> commands{kCommandQueueCapacity};
  SpscQueue<HandMove> hand_moves{kHandMoveQueueCapacity};
  std::atomic<std::uint32_t> hand_gesture{0};  // moves of another gesture are dropped
  std::atomic<bool> stop{false};

  // Loop to owner.
  TripleBuffer<Snapshot> snapshots;
  SpscQueue<Tick> plot;
  SpscQueue<ParameterEcho> echoes{kEchoQueueCapacity};
  std::atomic<std::uint64_t> dropped_plot_samples{0};
  std::atomic<std::uint64_t> dropped_rows{0};        // rows dropped by all recordings
  std::atomic<std::uint32_t> recording_switches{0};  // executed start and stop commands
  std::atomic<bool> pointer_led{false};              // true if it led in any tick since tick 0
  std::atomic<bool> finished{false};                 // force is zero, device closed
  LatencyHistogram wake_latency;                     // latencies of all cycles
  LatencyHistogram compute_time;

  // Loop to recorder.
  SpscQueue<Tick> recorder;

  // Loop to sound. The sound may keep it longer than the session lives.
  const std::shared_ptr<SoundFeed> sound;

  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

}  // namespace hapticwall::session
