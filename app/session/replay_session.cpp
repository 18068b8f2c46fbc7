#include "app/session/replay_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "app/session/loop/realtime_setup.h"

namespace hapticwall::session {
const Sample* Overlay::at(std::uint64_t tick) const {
  if (samples.empty() || tick < samples.front().tick) return nullptr;
  const std::uint64_t index = tick - samples.front().tick;
  return index < samples.size() ? &samples[index] : nullptr;
}

ReplaySession::ReplaySession(std::unique_ptr<file::RecordingReader> recording,
                             std::unique_ptr<Clock> clock, const ReplayOptions& options)
    : recording_(std::move(recording)),
      clock_(std::move(clock)),
      loop_(options.loop),
      paused_(options.start_paused),
      history_s_(options.history_s),
      last_ns_(clock_->now_ns()),
      place_ticks_(static_cast<double>(first_tick())) {
  set_speed(options.speed);
  const file::RecordingInfo& info = this->recording();
  device_info_.name = "recording " + std::filesystem::path(info.csv_path).filename().string();
  device_info_.is_simulated = true;  // a replay exerts no force
  realtime_.text = "no loop: a recording";
  if (!info.realtime.empty()) realtime_.text += " (of one with " + info.realtime + ")";
  show_place();
}

double ReplaySession::position_s() {
  advance();
  return place_ticks_ / recording().rate_hz;
}

bool ReplaySession::at_end() {
  advance();
  return tick_now() >= last_tick();
}

void ReplaySession::seek(double time_s) {
  if (!std::isfinite(time_s)) return;
  advance();
  // Rounds to the tick when the time is that of a tick.
  constexpr double kSameTick = 1e-6;
  const double ticks = time_s * recording().rate_hz;
  const double nearest = std::round(ticks);
  go_to(std::abs(ticks - nearest) < kSameTick ? nearest : ticks, history_s_ * recording().rate_hz);
}

void ReplaySession::set_speed(double speed) {
  if (!std::isfinite(speed)) return;
  advance();
  speed_ = std::clamp(speed, kMinReplaySpeed, kMaxReplaySpeed);
}

// Advances to the time of the clock. At the end it restarts only after every row was taken.
void ReplaySession::advance() {
  const std::int64_t now_ns = clock_->now_ns();
  const double passed_s =
      static_cast<double>(now_ns - std::exchange(last_ns_, now_ns)) / kNanosecondsPerSecond;
  if (paused_ || failure_) return;
  const auto end = static_cast<double>(last_tick());
  if (place_ticks_ >= end && loop_ && all_taken()) return begin_anew();
  place_ticks_ = std::min(place_ticks_ + passed_s * speed_ * recording().rate_hz, end);
  show_place();
  if (place_ticks_ >= end && !loop_) paused_ = true;
}

void ReplaySession::go_to(double place_ticks, double history_ticks) {
  if (failure_) return;
  place_ticks_ =
      std::clamp(place_ticks, static_cast<double>(first_tick()), static_cast<double>(last_tick()));
  const double begin = std::max(0.0, place_ticks_ - std::max(0.0, history_ticks));
  const auto row = recording_->row_at(static_cast<std::uint64_t>(begin));
  if (!row) return fail(row.error());
  // In a gap the last row before it is shown.
  next_row_ = std::min(*row, recording_->rows() - 1);
  ++resets_;
  show_place();
}

void ReplaySession::begin_anew() { go_to(static_cast<double>(first_tick()), 0.0); }

void ReplaySession::show_place() {
  const auto behind = recording_->row_at(tick_now() + 1);
  if (!behind) return fail(behind.error());
  shown_row_ = *behind == 0 ? 0 : *behind - 1;
  const auto count = recording_->read(shown_row_, {&shown_, 1});
  if (!count) fail(count.error());
}

void ReplaySession::fail(const Error& error) {
  failure_ = error;
  paused_ = true;
}

const Scene& ReplaySession::scene() const {
  const file::LoadedScene& loaded = recording().loaded;
  const std::uint32_t generation = shown_.x().generation;
  return generation == 0 ? loaded.scene : loaded.changes[generation - 1].scene;
}

void ReplaySession::pause(bool paused) {
  advance();
  if (failure_) return;
  if (paused_ && !paused && tick_now() >= last_tick()) begin_anew();
  paused_ = paused;
}

void ReplaySession::step(std::uint32_t ticks) {
  advance();
  if (!paused_ || failure_) return;
  place_ticks_ = std::min(std::floor(place_ticks_) + static_cast<double>(ticks),
                          static_cast<double>(last_tick()));
  show_place();
}

void ReplaySession::reset() {
  advance();
  begin_anew();
}

Snapshot ReplaySession::snapshot() {
  advance();
  Snapshot snapshot;
  snapshot.newest = shown_;
  snapshot.timing.ticks = shown_row_ + 1;
  snapshot.generation = shown_.x().generation;
  snapshot.resets = resets_;
  snapshot.paused = paused_;
  snapshot.ended_by_fault = failure_.has_value();
  return snapshot;
}

std::size_t ReplaySession::take_ticks(std::span<Tick> out) {
  advance();
  if (failure_ || next_row_ > shown_row_) return 0;
  const std::uint64_t due = shown_row_ + 1 - next_row_;
  const auto places = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), due));
  const auto count = recording_->read(next_row_, out.first(places));
  if (!count) {
    fail(count.error());
    return 0;
  }
  next_row_ += *count;
  return *count;
}

std::string ReplaySession::device_trouble() const { return failure_ ? failure_->message : ""; }

Result<std::unique_ptr<ReplaySession>> start_replay(const std::string& csv_path,
                                                    const ReplayOptions& options,
                                                    const file::ReadProgress& progress) {
  auto recording = file::RecordingReader::open(csv_path, progress);
  if (!recording) return recording.error();
  return std::make_unique<ReplaySession>(std::move(*recording), std::make_unique<MonotonicClock>(),
                                         options);
}

}  // namespace hapticwall::session
