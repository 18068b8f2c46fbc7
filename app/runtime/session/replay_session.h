// A recording that plays: a session without a loop, seen through the same door as a live one.
//
// No thread: whoever calls snapshot() or take_samples() moves it on, to where its clock says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/recording_reader.h"
#include "app/runtime/clock.h"
#include "app/runtime/session.h"

namespace hapticwall::runtime {

struct ReplayOptions {
  double speed = 1.0;  // recorded seconds a second, kSlowestReplay to kFastestReplay
  bool loop = false;   // from the end to the beginning again
  bool start_paused = false;
  double history_s = 10.0;  // so much before the place is handed out again after a seek
};

inline constexpr double kSlowestReplay = 0.01;
inline constexpr double kFastestReplay = 100.0;

// The same hand under another algorithm, to be drawn over the recording: samples of consecutive
// ticks.
struct Overlay {
  std::string label;
  std::vector<Sample> samples;

  // The one of this tick, or null.
  [[nodiscard]] const Sample* at(std::uint64_t tick) const;
};

class ReplaySession final : public Session {
 public:
  ReplaySession(std::unique_ptr<file::RecordingReader> recording, std::unique_ptr<Clock> clock,
                const ReplayOptions& options = {});

  // Of the recording.

  [[nodiscard]] const file::RecordingInfo& recording() const { return recording_->info(); }
  // Any rows, whatever is played (an overview): RecordingReader::read().
  [[nodiscard]] Result<std::size_t> read(std::uint64_t first_row, std::span<Sample> out) {
    return recording_->read(first_row, out);
  }

  // Recorded time: that of the samples. begin_s() <= position_s() <= end_s().
  [[nodiscard]] double begin_s() const { return seconds(first_tick()); }
  [[nodiscard]] double end_s() const { return seconds(last_tick()); }
  [[nodiscard]] double duration_s() const { return end_s() - begin_s(); }
  [[nodiscard]] double position_s();
  [[nodiscard]] bool at_end();

  // Goes to the nearest place there is; the samples of the last history_s before it follow again,
  // and Snapshot::resets counts it. Not a number: without effect.
  void seek(double time_s);

  [[nodiscard]] double speed() const { return speed_; }
  void set_speed(double speed);  // kept within its range; not a number: without effect
  [[nodiscard]] bool loops() const { return loop_; }
  void set_loop(bool loop) { loop_ = loop; }
  // So much before the place follows again after the next seek.
  void set_history(double history_s) { history_s_ = history_s; }

  // Null where nothing is laid over.
  [[nodiscard]] const Overlay* overlay() const { return overlay_ ? &*overlay_ : nullptr; }
  void lay_over(std::optional<Overlay> overlay) { overlay_ = std::move(overlay); }

  // Of any session.

  // As it was at the present place, with the changes up to it.
  [[nodiscard]] const Scene& scene() const override;
  // What was recorded does not change: a problem, unless nothing differs.
  std::optional<SceneProblem> set_algorithm(const AlgorithmSettings& algorithm) override;
  std::optional<SceneProblem> set_walls(std::span<const WallSettings> walls) override;
  std::optional<SceneProblem> change_scene(const Scene& wanted) override;
  void lead_hand(std::optional<double> /*position_m*/) override {}
  void lead_second_hand(std::optional<double> /*position_m*/) override {}
  void arm(bool /*armed*/) override {}

  // Going on at the end begins anew. At the end it pauses by itself, unless it loops.
  void pause(bool paused) override;
  void step(std::uint32_t ticks) override;
  void reset() override;  // to the first row

  // Its sample is that of the present place. timing.ticks counts the rows up to it, the rest is 0.
  [[nodiscard]] Snapshot snapshot() override;
  void read_timing(TimingHistograms& timing) const override { timing = {}; }
  // Every row up to the present place, however fast it plays.
  std::size_t take_samples(std::span<Sample> out) override;
  std::size_t take_second_axis(std::span<Sample> out) override;
  [[nodiscard]] std::uint64_t dropped_plot_samples() const override { return 0; }

  [[nodiscard]] Failure start_recording(const std::string& csv_path) override;
  [[nodiscard]] Failure stop_recording() override { return std::nullopt; }
  [[nodiscard]] RecordingStatus recording_status() const override { return {}; }
  [[nodiscard]] Failure mark(std::string_view text) override;
  // Of the recording, whatever its place.
  [[nodiscard]] std::span<const file::Mark> marks() const override {
    return recording().loaded.marks;
  }
  [[nodiscard]] const RealtimeStatus& realtime_status() const override { return realtime_; }
  [[nodiscard]] const device::DeviceInfo& device_info() const override { return device_info_; }
  // Why it stopped, where the file is no longer what it was.
  [[nodiscard]] std::string device_trouble() const override;

 private:
  [[nodiscard]] bool has_second_axis() const {
    return file::has_second_axis(recording().scanned.columns);
  }
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
  double place_ticks_ = 0.0;    // from first_tick() to last_tick()
  std::uint64_t next_row_ = 0;  // the next to be handed out
  std::uint32_t resets_ = 0;
  Sample shown_;                 // of the present place
  Sample shown_y_;               // the same of the second axis
  std::vector<Sample> taken_y_;  // of the newest take_samples()
  std::uint64_t shown_row_ = 0;
  Failure failure_;
};

// Opens a recording and plays it by the monotonic clock. The hook of a window.
[[nodiscard]] Result<std::unique_ptr<ReplaySession>> start_replay(
    const std::string& csv_path, const ReplayOptions& options = {},
    const file::ReadProgress& progress = {});

}  // namespace hapticwall::runtime
