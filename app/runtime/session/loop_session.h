// The session behind session.h: the owner's side of the loop, its thread and its recorder.
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
#include <thread>
#include <vector>

#include "app/runtime/crash_stop.h"
#include "app/runtime/exchange.h"
#include "app/runtime/parameter_history.h"
#include "app/runtime/plant_keeper.h"
#include "app/runtime/realtime_setup.h"
#include "app/runtime/recorder.h"
#include "app/runtime/servo_loop.h"
#include "app/runtime/session.h"
#include "app/runtime/spinning_clock.h"

namespace hapticwall::runtime {

class LiveSession final : public Session {
 public:
  // Precondition: the scene is valid and one of this device (scene_on()), the device open. Returns
  // when the loop's set-up is done.
  // `y_device`: of the second axis, where the scene has one.
  LiveSession(std::unique_ptr<device::Device> device, std::unique_ptr<device::Device> y_device,
              const Scene& scene, const SessionOptions& options);
  ~LiveSession() override;

  [[nodiscard]] const Scene& scene() const override { return history_.newest(); }
  std::optional<SceneProblem> set_algorithm(const AlgorithmSettings& algorithm) override;
  std::optional<SceneProblem> set_walls(std::span<const WallSettings> walls) override;
  std::optional<SceneProblem> change_scene(const Scene& wanted) override;
  void lead_hand(std::optional<double> position_m) override;
  void lead_second_hand(std::optional<double> position_m) override;
  void arm(bool armed) override;
  void pause(bool paused) override;
  void step(std::uint32_t ticks) override;
  void reset() override;
  [[nodiscard]] Snapshot snapshot() override;
  void read_timing(TimingHistograms& timing) const override;
  std::size_t take_samples(std::span<Sample> out) override;
  std::size_t take_second_axis(std::span<Sample> out) override;
  [[nodiscard]] std::uint64_t dropped_plot_samples() const override;
  [[nodiscard]] Failure start_recording(const std::string& csv_path) override;
  [[nodiscard]] Failure stop_recording() override;
  [[nodiscard]] RecordingStatus recording_status() const override;
  [[nodiscard]] Failure mark(std::string_view text) override;
  [[nodiscard]] std::span<const file::Mark> marks() const override { return marks_; }
  [[nodiscard]] const RealtimeStatus& realtime_status() const override { return realtime_; }
  [[nodiscard]] const device::DeviceInfo& device_info() const override { return device_info_; }

  [[nodiscard]] std::string device_trouble() const override { return device_->trouble_details(); }

  // start_recording() with a writer of the caller's. Precondition: no recording runs.
  void record_into(std::unique_ptr<file::RecordingWriter> writer);

  // Plants that are kept for the loop at this moment, without the device's own.
  [[nodiscard]] std::size_t plants_kept() const {
    return plants_.count() + (y_plants_ ? y_plants_->count() : 0);
  }

 private:
  void send(const Command& command);
  void exchange_news();
  void wait_for_recording_switch();
  [[nodiscard]] Failure finish_recording();
  // What is known of the recording, with the changes before `end_tick`.
  [[nodiscard]] file::RecordingMetadata metadata(std::uint64_t end_tick) const;
  [[nodiscard]] bool hand_was_led() const;
  void note_recording();
  [[nodiscard]] std::vector<file::Mark> recorded_marks() const;
  [[nodiscard]] std::uint64_t dropped_rows() const;

  CrashStop crash_stop_;  // outlives the loop
  PlantKeeper plants_;    // outlives the device
  std::optional<PlantKeeper> y_plants_;
  std::unique_ptr<device::Device> device_;
  std::unique_ptr<device::Device> y_device_;
  const device::DeviceInfo device_info_;
  ParameterHistory history_;
  Exchange exchange_;
  ServoLoop loop_;
  Recorder recorder_;
  MonotonicClock monotonic_clock_;
  SpinningClock clock_;
  RealtimeStatus realtime_;

  std::deque<Command> unsent_;  // did not fit into the queue yet
  std::uint32_t recording_switches_sent_ = 0;
  std::uint64_t dropped_rows_before_ = 0;  // by earlier recordings
  std::string recording_start_time_;
  std::string recording_path_;
  Failure recording_failure_;  // of the newest recording, once it is over
  std::vector<file::Mark> marks_;
  std::size_t first_mark_ = 0;  // of the newest recording
  std::uint32_t resets_sent_ = 0;

  // What the recorder was told of the recording, and when it may be told again.
  struct Noted {
    std::uint64_t parameters = 0;  // revision of their history
    std::size_t marks = 0;
    bool led = false;

    friend bool operator==(const Noted&, const Noted&) = default;
  };
  Noted noted_;
  std::chrono::steady_clock::time_point next_note_;

  std::thread thread_;
};

}  // namespace hapticwall::runtime
