// The live session behind live_session.h: the owner's side of the loop, its driver and its
// recorder.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/live_session.h"
#include "app/session/loop/crash_stop.h"
#include "app/session/loop/exchange.h"
#include "app/session/loop/loop_driver.h"
#include "app/session/loop/servo_loop.h"
#include "app/session/loop/spinning_clock.h"
#include "app/session/parameter_history.h"
#include "app/session/plant_keeper.h"
#include "app/session/recorder.h"
#include "app/session/stream_events.h"

namespace hapticwall::session {

// LiveSession::start_on() with `borrowed` in the place of the algorithm of axis x; it must outlive
// the session. `device` null: the simulator of the scene. `borrowed` null: the scene's algorithm.
[[nodiscard]] Result<std::unique_ptr<LiveSession>> start_under(
    BorrowedAlgorithm* borrowed, std::unique_ptr<device::Device> device, const Scene& scene,
    const SessionOptions& options);

class LoopSession final : public LiveSession {
 public:
  // Preconditions: the scene is valid and fits the devices (scene_on()), one for each axis, x
  // first; the devices are open. `borrowed`: as in ServoLoop. Returns when the loop is set up.
  LoopSession(std::vector<std::unique_ptr<device::Device>> devices, const Scene& scene,
              const SessionOptions& options, BorrowedAlgorithm* borrowed = nullptr);
  ~LoopSession() override;

  [[nodiscard]] const Scene& scene() const override { return history_.newest(); }
  std::optional<SceneProblem> change_scene(const Scene& wanted) override;
  [[nodiscard]] std::uint32_t generation() const override { return history_.generation(); }
  void slow_down(std::uint32_t periods_per_tick) override;
  void move_hand(const HandMove& move) override;
  void arm(bool armed) override;
  void pause(bool paused) override;
  void step(std::uint32_t ticks) override;
  void reset() override;
  [[nodiscard]] Snapshot snapshot() override;
  [[nodiscard]] std::shared_ptr<SoundFeed> sound_feed() const override { return exchange_.sound; }
  void read_timing(TimingHistograms& timing) const override;
  std::size_t take_ticks(std::span<Tick> out) override;
  [[nodiscard]] std::uint64_t dropped_plot_samples() const override;
  void record_signals(bool wanted) override;
  [[nodiscard]] Failure start_recording(const std::string& csv_path) override;
  [[nodiscard]] Failure stop_recording() override;
  [[nodiscard]] RecordingStatus recording_status() const override;
  [[nodiscard]] Failure mark(std::string_view text) override;
  void name_mark(std::string_view text) override;
  void add_event(std::string_view name, std::string_view more) override;
  [[nodiscard]] std::span<const file::Mark> marks() const override { return marks_; }
  [[nodiscard]] const RealtimeStatus& realtime_status() const override { return realtime_; }
  [[nodiscard]] const device::DeviceInfo& device_info() const override { return device_info_; }

  [[nodiscard]] std::string device_trouble() const override {
    return devices_.front()->trouble_details();
  }
  [[nodiscard]] bool knows_truth() const override { return device_info_.is_simulated; }

  // start_recording() with an existing writer. Precondition: no recording runs.
  void record_into(std::unique_ptr<file::RecordingWriter> writer);

  // Number of plants kept for the loop, without that of the device.
  [[nodiscard]] std::size_t plants_kept() const;

 private:
  void send(const Command& command);
  void drop_hand_moves();
  void exchange_news();
  // Writer null: for the stream alone.
  void start_recorder(std::unique_ptr<file::RecordingWriter> writer);
  void stop_recorder();
  void wait_for_recording_switch();
  [[nodiscard]] Failure finish_recording();
  // Metadata of the recording, with the changes before `end_tick`.
  [[nodiscard]] file::RecordingMetadata metadata(std::uint64_t end_tick) const;
  [[nodiscard]] bool hand_was_led() const;
  [[nodiscard]] EventTick newest_tick() const;
  void note_recording();
  [[nodiscard]] std::vector<file::Mark> recorded_marks() const;
  [[nodiscard]] std::uint64_t dropped_rows() const;

  CrashStop crash_stop_;            // outlives the loop
  std::deque<PlantKeeper> plants_;  // plants of the axes; outlive the devices
  std::vector<std::unique_ptr<device::Device>> devices_;
  const device::DeviceInfo device_info_;
  file::CsvColumns columns_;  // columns of recordings
  ParameterHistory history_;
  Exchange exchange_;
  ServoLoop loop_;
  Recorder recorder_;
  MonotonicClock monotonic_clock_;
  SpinningClock clock_;
  RealtimeStatus realtime_;

  std::deque<Command> unsent_;  // waits for room in the queue
  std::deque<HandMove> unsent_moves_;
  std::uint32_t recording_switches_sent_ = 0;
  std::uint64_t dropped_rows_before_ = 0;  // rows dropped by earlier recordings
  std::string recording_start_time_;
  std::string recording_path_;
  Failure recording_failure_;  // failure of the newest recording, after its end
  StreamEvents events_;
  std::vector<file::Mark> marks_;
  std::uint64_t marks_revision_ = 0;
  std::size_t first_mark_ = 0;  // first mark of the newest recording
  std::uint32_t resets_sent_ = 0;

  // Metadata that the recorder has, and the earliest time of the next update.
  struct Noted {
    std::uint64_t parameters = 0;  // revision of their history
    std::uint64_t marks = 0;       // revision of the marks
    bool led = false;

    friend bool operator==(const Noted&, const Noted&) = default;
  };
  Noted noted_;
  std::chrono::steady_clock::time_point next_note_;

  std::unique_ptr<LoopDriver> driver_;  // last: it begins and ends the loop
};

}  // namespace hapticwall::session
