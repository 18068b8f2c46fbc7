// Everything that passes between the owner's thread and the loop's: no mutex, no allocation after
// set-up, and no side that waits for the other.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "app/runtime/latency_histogram.h"
#include "app/runtime/session.h"
#include "app/runtime/spsc_queue.h"
#include "core/plant/plant_model.h"
#include "core/sample.h"
#include "core/servo_step.h"
#include "device/triple_buffer.h"

namespace hapticwall::runtime {

// What the loop runs with, controller and plant at the same tick. The owner numbers them from 1;
// the loop puts the number into its samples.
struct LoopParameters {
  ServoSettings servo;
  std::uint32_t generation = 1;
  // The owner's, built for these parameters and untouched until the loop takes it; the loop's to
  // use from then on, and the owner's to free once a later generation is echoed. nullptr: the plant
  // that the device has brought itself.
  PlantModel* plant = nullptr;
  // Of the second axis; without meaning where the session has one.
  ServoSettings y_servo{};
  PlantModel* y_plant = nullptr;
};

enum class CommandKind : std::uint8_t {
  kPause,
  kResume,
  kStep,
  kReset,
  kArm,
  kDisarm,
  kStartRecording,
  kStopRecording
};

struct Command {
  CommandKind kind = CommandKind::kPause;
  std::uint32_t ticks = 0;  // of kStep
};

// At which tick a generation came into force. Sent for every change and for tick 0 after every
// reset.
struct ParameterEcho {
  std::uint64_t tick = 0;
  std::uint32_t generation = 0;
};

inline constexpr std::size_t kCommandQueueCapacity = 256;
inline constexpr std::size_t kEchoQueueCapacity = 64;
// The loop leaves commands and parameters where they are while fewer places than this are free for
// echoes, so that none is ever lost. One cycle sends at most one.
inline constexpr std::size_t kFreeEchoPlaces = kEchoQueueCapacity / 2;

inline constexpr double kNoPointer = std::numeric_limits<double>::quiet_NaN();

struct Exchange {
  Exchange(const SessionOptions& options, const LoopParameters& initial, bool second_axis = false)
      : parameters(initial),
        plot(options.plot_queue_capacity),
        y_plot(second_axis ? options.plot_queue_capacity : 1),
        recorder(options.recorder_queue_capacity),
        y_recorder(second_axis ? options.recorder_queue_capacity : 1) {}

  // Owner to loop.
  TripleBuffer<LoopParameters> parameters;
  SpscQueue<Command> commands{kCommandQueueCapacity};
  std::atomic<double> pointer_m{
      kNoPointer};  // newest wins; not a number: the script leads the hand
  std::atomic<double> y_pointer_m{kNoPointer};
  std::atomic<bool> stop{false};

  // Loop to owner.
  TripleBuffer<Snapshot> snapshots;
  SpscQueue<Sample> plot;
  SpscQueue<Sample> y_plot;  // see push_both()
  SpscQueue<ParameterEcho> echoes{kEchoQueueCapacity};
  std::atomic<std::uint64_t> dropped_plot_samples{0};
  std::atomic<std::uint64_t> dropped_rows{0};        // of all recordings
  std::atomic<std::uint32_t> recording_switches{0};  // how many start and stop commands are done
  std::atomic<bool> pointer_led{false};              // in any tick since tick 0
  std::atomic<bool> finished{false};                 // force is zero, device closed
  LatencyHistogram wake_latency;                     // of every cycle
  LatencyHistogram compute_time;

  // Loop to recorder.
  SpscQueue<Sample> recorder;
  SpscQueue<Sample> y_recorder;

  static_assert(std::atomic<double>::is_always_lock_free);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

// Both axes of a tick into two queues of the same capacity, or neither. The taker takes x first and
// then y: what is there of x has its y, and where y finds a place x does too. Realtime-safe: yes.
[[nodiscard]] inline bool push_both(SpscQueue<Sample>& x_queue, SpscQueue<Sample>& y_queue,
                                    const Sample& x, const Sample& y) {
  return y_queue.try_push(y) && x_queue.try_push(x);
}

}  // namespace hapticwall::runtime
