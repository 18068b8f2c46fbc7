// A playing recording: a source of samples without a loop.
//
// Without a thread: snapshot() and take_samples() advance it to the time of its clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/file/recording/recording_reader.h"
#include "app/session/loop/clock.h"
#include "app/session/sample_source.h"

namespace hapticwall::session {

struct ReplayOptions {
  double speed = 1.0;  // recorded seconds per second, kMinReplaySpeed to kMaxReplaySpeed
  bool loop = false;   // restarts at the end
  bool start_paused = false;
  double history_s = 10.0;  // history handed out again after a seek, s
};

inline constexpr double kMinReplaySpeed = 0.01;
inline constexpr double kMaxReplaySpeed = 100.0;

// A re-run to draw over the recording: samples of consecutive ticks.
struct Overlay {
  std::string label;
  std::vector<Sample> samples;

  // The sample of this tick, or null.
  [[nodiscard]] const Sample* at(std::uint64_t tick) const;
};

class ReplaySession final : public SampleSource {
 public:
  ReplaySession(std::unique_ptr<file::RecordingReader> recording, std::unique_ptr<Clock> clock,
                const ReplayOptions& options = {});

  [[nodiscard]] const file::RecordingInfo& recording() const { return recording_->info(); }
  // Any rows, independent of the playback: RecordingReader::read().
  [[nodiscard]] Result<std::size_t> read(std::uint64_t first_row, std::span<Tick> out) {
    return recording_->read(first_row, out);
  }

  // Recorded time, s. begin_s() <= position_s() <= end_s().
  [[nodiscard]] double begin_s() const { return seconds(first_tick()); }
  [[nodiscard]] double end_s() const { return seconds(last_tick()); }
  [[nodiscard]] double duration_s() const { return end_s() - begin_s(); }
  [[nodiscard]] double position_s();
  [[nodiscard]] bool at_end();

  // Goes to the nearest recorded time. The samples of the last history_s before it follow again,
  // and Snapshot::resets increases. Ignores NaN.
  void seek(double time_s);

  [[nodiscard]] double speed() const { return speed_; }
  void set_speed(double speed);  // clamped to its range; ignores NaN
  [[nodiscard]] bool loops() const { return loop_; }
  void set_loop(bool loop) { loop_ = loop; }
  // History before the target of the next seek, s.
  void set_history(double history_s) { history_s_ = history_s; }

  // Null without an overlay.
  [[nodiscard]] const Overlay* overlay() const { return overlay_ ? &*overlay_ : nullptr; }
  void lay_over(std::optional<Overlay> overlay) { overlay_ = std::move(overlay); }

  // The interface of SampleSource.

  // Scene at the present time, including changes.
  [[nodiscard]] const Scene& scene() const override;
  [[nodiscard]] SignalNames signals() const override {
    return file::signal_names(recording().scanned.columns);
  }
  // Resuming at the end starts again. Pauses by itself at the end, unless it loops.
  void pause(bool paused) override;
  void step(std::uint32_t ticks) override;
  void reset() override;  // goes to the first row

  // The sample at the present time. timing.ticks counts the rows up to it; other timing is 0.
  [[nodiscard]] Snapshot snapshot() override;
  // Every row up to the present time, at any speed.
  std::size_t take_ticks(std::span<Tick> out) override;
  // All marks of the recording.
  [[nodiscard]] std::span<const file::Mark> marks() const override {
    return recording().loaded.marks;
  }
  [[nodiscard]] const RealtimeStatus& realtime_status() const override { return realtime_; }
  [[nodiscard]] const device::DeviceInfo& device_info() const override { return device_info_; }
  // Reason why it stopped: the file has changed.
  [[nodiscard]] std::string device_trouble() const override;
  [[nodiscard]] bool knows_truth() const override { return recording().of_simulator(); }

 private:
  [[nodiscard]] std::uint64_t first_tick() const { return recording().scanned.first_tick; }
  [[nodiscard]] std::uint64_t last_tick() const { return recording().scanned.last_tick; }
  [[nodiscard]] double seconds(std::uint64_t tick) const {
    return static_cast<double>(tick) / recording().rate_hz;
  }
  [[nodiscard]] std::uint64_t tick_now() const { return static_cast<std::uint64_t>(place_ticks_); }
  [[nodiscard]] bool all_taken() const { return next_row_ == recording_->rows(); }
  void advance();
  void go_to(double place_ticks, double history_ticks);
  void begin_anew();
  void show_place();
  void fail(const Error& error);

  std::unique_ptr<file::RecordingReader> recording_;
  std::unique_ptr<Clock> clock_;
  double speed_ = 1.0;
  bool loop_;
  bool paused_;
  double history_s_;
  device::DeviceInfo device_info_;
  RealtimeStatus realtime_;
  std::optional<Overlay> overlay_;

  std::int64_t last_ns_;
  double place_ticks_ = 0.0;    // first_tick() to last_tick()
  std::uint64_t next_row_ = 0;  // next row for take_samples()
  std::uint32_t resets_ = 0;
  Tick shown_;  // tick at the present time
  std::uint64_t shown_row_ = 0;
  Failure failure_;
};

// Opens a recording and plays it with the monotonic clock.
[[nodiscard]] Result<std::unique_ptr<ReplaySession>> start_replay(
    const std::string& csv_path, const ReplayOptions& options = {},
    const file::ReadProgress& progress = {});

}  // namespace hapticwall::session
