// A live session: the real-time loop on a device, seen from the window (or from `run --realtime`).
//
// All members are called from one thread, the owner's; the loop runs on its own. Nothing here waits
// for the loop except start, destruction, stop_recording() and a reset() that finishes a recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/file/mark.h"
#include "app/runtime/arming.h"
#include "app/runtime/latency_histogram.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"
#include "device/device.h"

namespace hapticwall::runtime {

class Clock;

// How set-up of the loop went, in words that the window and the sidecar show.
struct RealtimeStatus {
  bool fifo_priority = false;
  bool memory_locked = false;
  bool affinity_set = false;
  std::string text;  // one line: "real-time priority 80, memory locked, core 1", or what is missing
  std::string advice;  // what to do about it; empty where nothing is to be done
};

// Since the start of the session. Latency and compute time are those of every cycle, also of one
// that waits in a pause.
struct TimingStatistics {
  std::uint64_t ticks = 0;
  std::uint64_t missed_ticks = 0;
  double wake_latency_s = 0.0;  // of the newest tick
  double maximum_wake_latency_s = 0.0;
  double compute_time_s = 0.0;  // of the newest tick
  double maximum_compute_time_s = 0.0;
  // Compute time of the ticks of the last second in which it ticked, told four times a second.
  std::uint32_t cost_ticks = 0;  // how many these are; 0: nothing is known yet
  double median_cost_s = 0.0;    // within 4 %
  double maximum_cost_s = 0.0;
};

// Every cycle since the start of the session, whatever it was reset or paused.
struct TimingHistograms {
  LatencyCounts wake_latency;
  LatencyCounts compute_time;
};

// Whether the force of a real device acts, and why not.
struct ArmingStatus {
  ArmingState state = ArmingState::kNotNeeded;
  ArmingNote note = ArmingNote::kNone;
  double gain = 1.0;        // of the force, 0 to 1
  std::uint32_t asked = 0;  // how many requests to arm were answered, either way
};

// The newest tick and the state of the loop. Trivially copyable.
struct Snapshot {
  Sample sample;
  Sample y;  // the same tick of the second axis, where the scene has one
  TimingStatistics timing;
  ArmingStatus arming;
  device::LinkFigures link;      // of a real device
  std::uint32_t generation = 0;  // of the parameters in force
  std::uint32_t resets = 0;      // how often the session went back to tick 0
  bool paused = false;
  bool ended_by_fault = false;  // the loop gave up: force is zero, the device is closed
};

enum class RecordingState : std::uint8_t { kIdle, kRecording, kFailed };

struct RecordingStatus {
  RecordingState state = RecordingState::kIdle;
  std::uint64_t rows = 0;
  std::uint64_t dropped_rows = 0;
  std::string path;   // of the CSV, also after it was finished
  std::string error;  // one line, where state is kFailed
};

struct SessionOptions {
  std::size_t plot_queue_capacity = 1U << 16U;
  std::size_t recorder_queue_capacity = 1U << 17U;
  int affinity_core = -1;  // -1: left to the scheduler
  double spin_s = 0.0;     // awake before every tick, 0 to kMostSpinS (spinning_clock.h)
  bool start_paused = false;
  bool allow_no_realtime = false;  // a real device without real-time priority; simulators never ask
  // What the loop lives by, and what outlives the session; null: the machine's own clock. Another
  // one lets a simulator's hours pass in seconds.
  Clock* clock = nullptr;
};

class Session {
 public:
  // Opens the simulator for a validated scene, sets the loop up and starts it.
  [[nodiscard]] static Result<std::unique_ptr<Session>> start(const Scene& scene,
                                                              const SessionOptions& options = {});
  // The same on a device that is not open yet. Fails where it does not open, and where a real one
  // would run without real-time priority that was not allowed (exit status 3). The device's
  // resolution and, where it is smaller, its force limit take the place of the scene's.
  [[nodiscard]] static Result<std::unique_ptr<Session>> start_on(
      std::unique_ptr<device::Device> device, const Scene& scene,
      const SessionOptions& options = {});
  virtual ~Session() = default;  // zero force, loop joined, recording finished

  // The scene as the owner last asked for it.
  [[nodiscard]] virtual const Scene& scene() const = 0;

  // Take effect at a tick boundary, without a force jump. A problem leaves everything as it was.
  virtual std::optional<SceneProblem> set_algorithm(const AlgorithmSettings& algorithm) = 0;
  virtual std::optional<SceneProblem> set_walls(std::span<const WallSettings> walls) = 0;
  // All of `wanted` that may change while it runs (scene_change.h), at one tick: device, hand,
  // walls, algorithm, simulator. The handle goes on from where it is. Where something else differs
  // that is a problem; name, description and duration are not looked at. A real device's own plant
  // does not change.
  virtual std::optional<SceneProblem> change_scene(const Scene& wanted) = 0;
  // The pointer leads the simulated hand (metres, newest wins, kept within a metre); nothing, or
  // not a finite number: the script does. Without effect in a scene without a hand.
  virtual void lead_hand(std::optional<double> position_m) = 0;

  // The same for the hand of the second axis.
  virtual void lead_second_hand(std::optional<double> position_m) = 0;

  // Asks for the force of a real device (arming.h), or takes it away at the next tick. The answer
  // is in the snapshot. Without effect on a simulator.
  virtual void arm(bool armed) = 0;

  virtual void pause(bool paused) = 0;
  virtual void step(std::uint32_t ticks = 1) = 0;  // while paused: exactly so many; else ignored
  // Back to tick 0, at rest, disarmed. A running recording is finished first (its ticks are
  // numbered without a gap); how that went is in recording_status(). Paused stays paused.
  virtual void reset() = 0;

  [[nodiscard]] virtual Snapshot snapshot() = 0;
  // Nothing but zeros where there is no loop.
  virtual void read_timing(TimingHistograms& timing) const = 0;
  // Moves up to out.size() samples, oldest first, and returns how many. Every tick appears here
  // unless the owner was too slow: then dropped_plot_samples() counts.
  virtual std::size_t take_samples(std::span<Sample> out) = 0;
  // Of the second axis: the same ticks, to be called after take_samples() with as many places as
  // that has filled. 0 where the scene has one axis.
  virtual std::size_t take_second_axis(std::span<Sample> out) = 0;
  [[nodiscard]] virtual std::uint64_t dropped_plot_samples() const = 0;

  // From the next tick on, every tick. Fails while another recording runs.
  [[nodiscard]] virtual Failure start_recording(const std::string& csv_path) = 0;
  // Writes what is left and gives the files their names. Fails (exit status 4) where the disk did,
  // and where rows were dropped: then the files are there, marked as incomplete. Harmless when
  // idle.
  [[nodiscard]] virtual Failure stop_recording() = 0;
  [[nodiscard]] virtual RecordingStatus recording_status() const = 0;

  // Notes the newest sample's place in the running recording, with a few words: for its sidecar.
  // The text is kept as far as it may be (file::mark_text()). Fails where nothing is recorded, and
  // where there are file::kMostMarks already. The loop does not notice.
  [[nodiscard]] virtual Failure mark(std::string_view text) = 0;
  // Those of all recordings since the last reset, in order.
  [[nodiscard]] virtual std::span<const file::Mark> marks() const = 0;

  [[nodiscard]] virtual const RealtimeStatus& realtime_status() const = 0;
  [[nodiscard]] virtual const device::DeviceInfo& device_info() const = 0;
  // What is wrong with the device at this moment, in one line; empty where nothing is.
  [[nodiscard]] virtual std::string device_trouble() const = 0;
};

}  // namespace hapticwall::runtime
