// The recording of a live session: its start and end, its marks, and its notes for the sidecar.
#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "app/file/recording/sidecar.h"
#include "app/file/text/text.h"
#include "app/session/loop_session.h"

namespace hapticwall::session {
namespace {

// End of a recording that still runs.
constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();

}  // namespace

std::uint64_t LoopSession::dropped_rows() const {
  return exchange_.dropped_rows.load(std::memory_order_relaxed) - dropped_rows_before_;
}

void LoopSession::record_signals(bool wanted) {
  columns_.signals = wanted ? file::all_signal_columns() : std::vector<file::SignalColumn>{};
}

Failure LoopSession::start_recording(const std::string& csv_path) {
  // A failed recording does not block a new one.
  if (recorder_.running() && recorder_.failure()) static_cast<void>(stop_recording());
  if (recorder_.running()) {
    return Error{ErrorKind::kUsage,
                 "a recording to " + recording_path_ + " is running: stop it first"};
  }
  auto writer = file::RecordingWriter::create(csv_path, columns_);
  if (!writer) return writer.error();
  recording_start_time_ = file::utc_now();
  first_mark_ = marks_.size();
  exchange_news();
  if (Failure failed = (*writer)->note(history_.scene_at_start(), metadata(kEndless)))
    return failed;
  record_into(std::move(*writer));
  return std::nullopt;
}

void LoopSession::record_into(std::unique_ptr<file::RecordingWriter> writer) {
  recording_path_ = writer->csv_path();
  recording_start_time_ = file::utc_now();
  noted_ = {history_.revision(), marks_revision_, hand_was_led()};
  recording_failure_.reset();
  first_mark_ = marks_.size();
  dropped_rows_before_ = exchange_.dropped_rows.load(std::memory_order_relaxed);
  if (recorder_.streams()) {
    stop_recorder();
    recorder_.drain_and_join();
  }
  start_recorder(std::move(writer));
}

void LoopSession::start_recorder(std::unique_ptr<file::RecordingWriter> writer) {
  recorder_.start(std::move(writer));
  ++recording_switches_sent_;
  send({CommandKind::kStartRecording, 0});
}

// Returns when no more rows come.
void LoopSession::stop_recorder() {
  ++recording_switches_sent_;
  send({CommandKind::kStopRecording, 0});
  wait_for_recording_switch();
}

Failure LoopSession::stop_recording() {
  if (!recorder_.running()) return std::nullopt;
  stop_recorder();
  Failure failed = finish_recording();
  if (recorder_.streams()) start_recorder(nullptr);
  return failed;
}

// Waits until the loop has pushed the last row or has ended.
void LoopSession::wait_for_recording_switch() {
  while (exchange_.recording_switches.load(std::memory_order_acquire) != recording_switches_sent_ &&
         !exchange_.finished.load(std::memory_order_acquire)) {
    driver_->wait();
    exchange_news();
  }
}

// Precondition: the loop pushes no more rows.
Failure LoopSession::finish_recording() {
  if (!recorder_.running()) return std::nullopt;
  exchange_news();
  recorder_.drain_and_join();
  file::RecordingMetadata whole = metadata(recorder_.end_tick());
  whole.marks = recorded_marks();
  recording_failure_ = recorder_.finish(history_.scene_at_start(), std::move(whole));
  if (!recording_failure_ && dropped_rows() > 0) {
    recording_failure_ = Error{
        ErrorKind::kFile, recording_path_ + ": " + std::to_string(dropped_rows()) +
                              " rows are missing (the disk was too slow); marked as incomplete"};
  }
  return recording_failure_;
}

bool LoopSession::hand_was_led() const {
  return exchange_.pointer_led.load(std::memory_order_relaxed) ||
         std::ranges::any_of(history_.newest().axes, [](const AxisSettings& axis) {
           return axis.hand && axis.hand->follows_mouse;
         });
}

file::RecordingMetadata LoopSession::metadata(std::uint64_t end_tick) const {
  file::RecordingMetadata metadata;
  metadata.start_time = recording_start_time_;
  metadata.device = device_info_.name;
  metadata.realtime_status = realtime_.text;
  metadata.dropped_rows = dropped_rows();
  metadata.changes = history_.changes_before(end_tick);
  metadata.marks.assign(marks_.begin() + static_cast<std::ptrdiff_t>(first_mark_), marks_.end());
  if (!device_info_.is_simulated) {
    metadata.not_repeatable_because = "a device was used, not the simulator";
  } else if (hand_was_led()) {
    metadata.not_repeatable_because = "the pointer led the hand";
  } else if (!history_.knows_start()) {
    metadata.not_repeatable_because = "the session was cut off before it was known how it began";
  } else if (history_.has_lost_changes()) {
    metadata.not_repeatable_because = "there were more changes of parameters than the " +
                                      std::to_string(file::kMaxChanges) + " that are kept";
  }
  metadata.repeatable = metadata.not_repeatable_because.empty();
  return metadata;
}

// Rate-limited by its cost: a dragged slider makes sixty changes a second.
void LoopSession::note_recording() {
  constexpr auto kMinPause = Recorder::kFlushInterval;
  constexpr int kPauseToCost = 50;
  if (!recorder_.running()) return;
  const Noted present{history_.revision(), marks_revision_, hand_was_led()};
  const auto now = std::chrono::steady_clock::now();
  if (present == noted_ || now < next_note_) return;
  noted_ = present;
  recorder_.note(history_.scene_at_start(), metadata(kEndless));
  const auto cost = std::chrono::steady_clock::now() - now;
  next_note_ = now + std::max<std::chrono::steady_clock::duration>(kMinPause, kPauseToCost * cost);
}

Failure LoopSession::mark(std::string_view text) {
  if (!recorder_.running()) {
    return Error{ErrorKind::kUsage, "marks belong to a recording: start one first"};
  }
  if (marks_.size() - first_mark_ >= file::kMaxMarks) {
    return Error{ErrorKind::kUsage, "a recording has at most " + std::to_string(file::kMaxMarks) +
                                        " marks, and this one has them"};
  }
  // Before the loop has executed the reset, its newest sample is an old one.
  const Snapshot present = snapshot();
  const std::uint64_t tick = present.resets == resets_sent_ ? present.newest.x().tick : 0;
  marks_.push_back({tick, file::mark_text(text)});
  ++marks_revision_;
  events_.mark({tick, static_cast<double>(tick) * scene().sampling.period_s()}, marks_.back().text);
  return std::nullopt;
}

void LoopSession::name_mark(std::string_view text) {
  if (!recorder_.running() || marks_.size() <= first_mark_) return;
  marks_.back().text = file::mark_text(text);
  ++marks_revision_;
  events_.mark(
      {marks_.back().tick, static_cast<double>(marks_.back().tick) * scene().sampling.period_s()},
      marks_.back().text);
}

// Clamps every mark to a recorded row, because the loop may start or end later than asked.
std::vector<file::Mark> LoopSession::recorded_marks() const {
  if (recorder_.rows() == 0) return {};
  std::vector<file::Mark> marks(marks_.begin() + static_cast<std::ptrdiff_t>(first_mark_),
                                marks_.end());
  for (file::Mark& mark : marks) {
    mark.tick = std::clamp(mark.tick, recorder_.first_tick(), recorder_.end_tick() - 1);
  }
  return marks;
}

RecordingStatus LoopSession::recording_status() const {
  RecordingStatus status;
  status.rows = recorder_.rows();
  status.dropped_rows = dropped_rows();
  status.path = recording_path_;
  Failure failure = recording_failure_;
  if (recorder_.running()) {
    status.state = RecordingState::kRecording;
    failure = recorder_.failure();
  }
  if (failure) {
    status.state = RecordingState::kFailed;
    status.error = failure->message;
  }
  return status;
}

}  // namespace hapticwall::session
