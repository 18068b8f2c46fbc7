// A live session: the real-time loop on a device, seen from the window or from `run --realtime`.
//
// The loop runs on its own thread, or is turned by the owner (Driver). Only start, destruction,
// stop_recording(), a reset() that finishes a recording, and start_recording() beside a stream wait
// for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/recording/sample_stream.h"
#include "app/session/loop/led_hand.h"
#include "app/session/loop/loop_driver.h"
#include "app/session/sample_source.h"
#include "core/result.h"

namespace hapticwall::session {

class Clock;
struct SoundFeed;

enum class RecordingState : std::uint8_t { kIdle, kRecording, kFailed };

struct RecordingStatus {
  RecordingState state = RecordingState::kIdle;
  std::uint64_t rows = 0;
  std::uint64_t dropped_rows = 0;
  std::string path;   // path of the CSV, also after the end
  std::string error;  // one line, only in state kFailed
};

struct SessionOptions {
  QueueCapacities queues;
  int affinity_core = -1;  // -1: left to the scheduler
  double spin_s = 0.0;     // busy waiting before every tick, 0 to kMaxSpinS (spinning_clock.h)
  // kTurnedByOwner: take_ticks() first runs every cycle that is due; simulators only.
  Driver driver = Driver::kOwnThread;
  bool start_paused = false;
  bool allow_no_realtime = false;  // a real device without real-time priority; simulators never ask
  bool allow_slow_device = false;  // a real device whose delay is poor
  // Clock of the loop; must outlive the session. Null: the clock of the machine. Another clock lets
  // hours of simulation pass in seconds.
  Clock* clock = nullptr;
  // Gets every tick, from the recorder's thread. Null: none.
  std::shared_ptr<file::SampleStream> stream{};
  // Signals of algorithms in the stream, and in recordings until record_signals().
  std::vector<file::SignalColumn> signals{};
};

class LiveSession : public SampleSource {
 public:
  // Opens the simulator for a valid scene and starts the loop.
  [[nodiscard]] static Result<std::unique_ptr<LiveSession>> start(
      const Scene& scene, const SessionOptions& options = {});
  // start() on a device that is not open yet. Fails when it does not open, and when a real device
  // would run without real-time priority that was not allowed (exit status 3). The device's
  // resolution, and its force limit if it is smaller, replace those of the scene.
  [[nodiscard]] static Result<std::unique_ptr<LiveSession>> start_on(
      std::unique_ptr<device::Device> device, const Scene& scene,
      const SessionOptions& options = {});
  // The destructor sets the force to zero, joins the loop and finishes the recording.

  // Changes all of `wanted` that may change during a session (scene_change.h), at one tick and
  // without a force jump: device, hand, walls, algorithm, estimator, simulator. The handle keeps
  // its position. Any other difference is a problem, which changes nothing; name, description and
  // duration are ignored. The plant of a real device does not change.
  virtual std::optional<SceneProblem> change_scene(const Scene& wanted) = 0;
  std::optional<SceneProblem> set_algorithm(const AlgorithmSettings& algorithm);
  std::optional<SceneProblem> set_walls(std::span<const WallSettings> walls);
  // Number of the scene() asked for last. It is in force once Snapshot::generation equals it.
  [[nodiscard]] virtual std::uint32_t generation() const = 0;
  // Leads the simulated hands, which then stay where the moves end; reset() gives them back to
  // their scripts. No effect without a hand, or with numbers that make no motion (HandMove).
  virtual void move_hand(const HandMove& move) = 0;

  // Slow motion of a simulator: one tick every this many periods, 1 or more. The samples are those
  // of full speed. No effect on a real device.
  virtual void slow_down(std::uint32_t periods_per_tick) = 0;

  // Asks for the force of a real device (arming.h), or removes it at the next tick. The snapshot
  // has the answer. No effect on a simulator. reset() disarms, and finishes a running recording.
  virtual void arm(bool armed) = 0;

  // Feed for the sound, which may keep it.
  [[nodiscard]] virtual std::shared_ptr<SoundFeed> sound_feed() const = 0;

  virtual void read_timing(TimingHistograms& timing) const = 0;
  // Samples that take_ticks() lost because the owner was too slow.
  [[nodiscard]] virtual std::uint64_t dropped_plot_samples() const = 0;

  // Adds the signals of all algorithms to recordings, or removes them, from the next recording on.
  virtual void record_signals(bool wanted) = 0;
  // Records every tick from the next one on. Fails while another recording runs. A stream loses the
  // ticks of a cycle or two, at the end of a recording as well, and counts them.
  [[nodiscard]] virtual Failure start_recording(const std::string& csv_path) = 0;
  // Writes the rest and gives the files their names. Fails (exit status 4) where the disk failed,
  // and where rows were dropped: then the files exist, marked as incomplete. Harmless when idle.
  [[nodiscard]] virtual Failure stop_recording() = 0;
  [[nodiscard]] virtual RecordingStatus recording_status() const = 0;
  // Marks the newest sample in the running recording, with a short text for its sidecar
  // (file::mark_text() limits it). Fails where nothing is recorded, and after file::kMaxMarks
  // marks. The loop does not notice.
  [[nodiscard]] virtual Failure mark(std::string_view text) = 0;
  // An event for the stream at the newest sample; `more`: further members of its object, as JSON
  // with a leading comma. No effect without a stream.
  virtual void add_event(std::string_view /*name*/, std::string_view /*more*/) {}
  // Gives the newest mark of the running recording this text; harmless without one.
  virtual void name_mark(std::string_view text) = 0;
};

}  // namespace hapticwall::session
