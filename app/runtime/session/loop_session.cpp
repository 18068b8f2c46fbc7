#include "app/runtime/live_session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <future>
#include <limits>
#include <utility>

#include "app/file/sidecar.h"
#include "app/runtime/scene_change.h"
#include "core/scene_keys.h"

namespace hapticwall::runtime {
namespace {

// The owner's pause between two looks at whether the loop has answered.
constexpr std::chrono::microseconds kAnswerPollInterval{200};

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[sizeof "9999-12-31T23:59:59Z"] = {};
  const std::size_t length = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text, length};
}

LoopParameters parameters_of(const ParameterHistory& history) {
  const Scene& scene = history.newest();
  LoopParameters parameters;
  parameters.servo = servo_settings(scene);
  parameters.generation = history.generation();
  if (scene.y) parameters.y_servo = servo_settings(second_axis(scene));
  return parameters;
}

// Where a pointer leads a hand.
double pointer_place(std::optional<double> position_m) {
  if (!position_m || !std::isfinite(*position_m)) return kNoPointer;
  return std::clamp(*position_m, kPositionRange.minimum, kPositionRange.maximum);
}

// A recording of which the end is not known yet.
constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();

bool follows_mouse(const std::optional<HandSettings>& hand) { return hand && hand->follows_mouse; }

}  // namespace

LiveSession::LiveSession(std::unique_ptr<device::Device> device,
                         std::unique_ptr<device::Device> y_device, const Scene& scene,
                         const SessionOptions& options)
    : plants_(scene),
      y_plants_(scene.y ? std::optional<PlantKeeper>(second_axis(scene)) : std::nullopt),
      device_(std::move(device)),
      y_device_(std::move(y_device)),
      device_info_(device_->info()),
      history_(scene),
      exchange_(options, parameters_of(history_), y_device_ != nullptr),
      loop_(*device_, exchange_, parameters_of(history_), options.start_paused, y_device_.get()),
      recorder_(exchange_.recorder, y_device_ != nullptr ? &exchange_.y_recorder : nullptr),
      clock_(options.clock != nullptr ? *options.clock : monotonic_clock_,
             spin_ns(options.spin_s, scene.sampling.rate_hz)) {
  std::promise<RealtimeOutcome> set_up;
  std::future<RealtimeOutcome> outcome = set_up.get_future();
  const int core = options.affinity_core;
  const double rate_hz = scene.sampling.rate_hz;
  thread_ = std::thread([this, core, rate_hz, ready = std::move(set_up)]() mutable {
    ready.set_value(set_up_realtime_thread(core));
    run_servo_loop(loop_, exchange_, rate_hz, clock_);
  });
  realtime_ = describe(outcome.get());
}

// Zero force comes first; the disk may take its time after that.
LiveSession::~LiveSession() {
  exchange_.stop.store(true, std::memory_order_relaxed);
  thread_.join();
  static_cast<void>(finish_recording());
}

std::optional<SceneProblem> LiveSession::set_algorithm(const AlgorithmSettings& algorithm) {
  Scene changed = scene();
  changed.algorithm = algorithm;
  return change_scene(changed);
}

std::optional<SceneProblem> LiveSession::set_walls(std::span<const WallSettings> walls) {
  Scene changed = scene();
  changed.walls.assign(walls.begin(), walls.end());
  return change_scene(changed);
}

// What the loop has not seen is taken back first: then this side knows which plant the loop will be
// running with when it takes the new parameters.
std::optional<SceneProblem> LiveSession::change_scene(const Scene& asked) {
  const Scene wanted = scene_on(asked, device_info_);
  if (std::optional<SceneProblem> problem = needs_new_session(scene(), wanted)) return problem;
  if (same_parameters(wanted, scene())) return std::nullopt;
  if (std::optional<SceneProblem> problem = validate(wanted)) return problem;
  exchange_news();
  Scene changed = wanted;
  changed.name = scene().name;
  changed.description = scene().description;
  changed.duration_s = scene().duration_s;
  const bool unread = exchange_.parameters.withdraw();
  history_.add(changed, unread);
  LoopParameters parameters = parameters_of(history_);
  if (device_info_.is_simulated) {
    parameters.plant = plants_.plant_for(history_.newest(), history_.generation(), unread);
    if (y_plants_) {
      parameters.y_plant =
          y_plants_->plant_for(second_axis(history_.newest()), history_.generation(), unread);
    }
  }
  exchange_.parameters.publish(parameters);
  return std::nullopt;
}

void LiveSession::lead_hand(std::optional<double> position_m) {
  if (!scene().hand) return;
  exchange_.pointer_m.store(pointer_place(position_m), std::memory_order_relaxed);
}

void LiveSession::lead_second_hand(std::optional<double> position_m) {
  if (!scene().y || !scene().y->hand) return;
  exchange_.y_pointer_m.store(pointer_place(position_m), std::memory_order_relaxed);
}

void LiveSession::arm(bool armed) { send({armed ? CommandKind::kArm : CommandKind::kDisarm, 0}); }

void LiveSession::pause(bool paused) {
  send({paused ? CommandKind::kPause : CommandKind::kResume, 0});
}

void LiveSession::step(std::uint32_t ticks) { send({CommandKind::kStep, ticks}); }

void LiveSession::reset() {
  if (recorder_.running()) static_cast<void>(stop_recording());
  marks_.clear();
  first_mark_ = 0;
  ++resets_sent_;
  history_.restart();
  send({CommandKind::kReset, 0});
}

// No command is lost, however many there are at once: what does not fit waits on this side.
void LiveSession::send(const Command& command) {
  unsent_.push_back(command);
  exchange_news();
}

void LiveSession::exchange_news() {
  while (!unsent_.empty() && exchange_.commands.try_push(unsent_.front())) unsent_.pop_front();
  ParameterEcho echo;
  while (exchange_.echoes.try_pop(echo)) {
    history_.came_into_force(echo);
    plants_.came_into_force(echo.generation);
    if (y_plants_) y_plants_->came_into_force(echo.generation);
  }
  note_recording();
}

Snapshot LiveSession::snapshot() {
  exchange_news();
  exchange_.snapshots.update();
  return exchange_.snapshots.current();
}

void LiveSession::read_timing(TimingHistograms& timing) const {
  exchange_.wake_latency.read(timing.wake_latency);
  exchange_.compute_time.read(timing.compute_time);
}

std::size_t LiveSession::take_samples(std::span<Sample> out) {
  exchange_news();
  std::size_t count = 0;
  while (count < out.size() && exchange_.plot.try_pop(out[count])) ++count;
  return count;
}

std::size_t LiveSession::take_second_axis(std::span<Sample> out) {
  std::size_t count = 0;
  while (count < out.size() && exchange_.y_plot.try_pop(out[count])) ++count;
  return count;
}

std::uint64_t LiveSession::dropped_plot_samples() const {
  return exchange_.dropped_plot_samples.load(std::memory_order_relaxed);
}

std::uint64_t LiveSession::dropped_rows() const {
  return exchange_.dropped_rows.load(std::memory_order_relaxed) - dropped_rows_before_;
}

Failure LiveSession::start_recording(const std::string& csv_path) {
  // One that failed has nothing more to say than it said; it does not stand in the way.
  if (recorder_.running() && recorder_.failure()) static_cast<void>(stop_recording());
  if (recorder_.running()) {
    return Error{ErrorKind::kUsage,
                 "a recording to " + recording_path_ + " is running: stop it first"};
  }
  auto writer = file::RecordingWriter::create(
      csv_path, file::more_columns(device_info_.is_simulated, y_device_ != nullptr));
  if (!writer) return writer.error();
  recording_start_time_ = utc_now();
  first_mark_ = marks_.size();
  exchange_news();
  if (Failure failed = (*writer)->note(history_.scene_at_start(), metadata(kEndless)))
    return failed;
  record_into(std::move(*writer));
  return std::nullopt;
}

void LiveSession::record_into(std::unique_ptr<file::RecordingWriter> writer) {
  recording_path_ = writer->csv_path();
  recording_start_time_ = utc_now();
  noted_ = {history_.revision(), marks_.size(), hand_was_led()};
  recording_failure_.reset();
  first_mark_ = marks_.size();
  dropped_rows_before_ = exchange_.dropped_rows.load(std::memory_order_relaxed);
  recorder_.start(std::move(writer));
  ++recording_switches_sent_;
  send({CommandKind::kStartRecording, 0});
}

Failure LiveSession::stop_recording() {
  if (!recorder_.running()) return std::nullopt;
  ++recording_switches_sent_;
  send({CommandKind::kStopRecording, 0});
  wait_for_recording_switch();
  return finish_recording();
}

// Until the loop has pushed the last row, or is no more.
void LiveSession::wait_for_recording_switch() {
  while (exchange_.recording_switches.load(std::memory_order_acquire) != recording_switches_sent_ &&
         !exchange_.finished.load(std::memory_order_acquire)) {
    std::this_thread::sleep_for(kAnswerPollInterval);
    exchange_news();
  }
}

// Precondition: the loop pushes no more rows.
Failure LiveSession::finish_recording() {
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

bool LiveSession::hand_was_led() const {
  return exchange_.pointer_led.load(std::memory_order_relaxed) ||
         follows_mouse(history_.newest().hand) ||
         (history_.newest().y && follows_mouse(history_.newest().y->hand));
}

file::RecordingMetadata LiveSession::metadata(std::uint64_t end_tick) const {
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
                                      std::to_string(file::kMostChanges) + " that are kept";
  }
  metadata.repeatable = metadata.not_repeatable_because.empty();
  return metadata;
}

// Not more often than it costs little: a dragged slider makes sixty changes a second.
void LiveSession::note_recording() {
  constexpr auto kShortestPause = Recorder::kFlushInterval;
  constexpr int kPauseToCost = 50;
  if (!recorder_.running()) return;
  const Noted present{history_.revision(), marks_.size(), hand_was_led()};
  const auto now = std::chrono::steady_clock::now();
  if (present == noted_ || now < next_note_) return;
  noted_ = present;
  recorder_.note(history_.scene_at_start(), metadata(kEndless));
  const auto cost = std::chrono::steady_clock::now() - now;
  next_note_ =
      now + std::max<std::chrono::steady_clock::duration>(kShortestPause, kPauseToCost * cost);
}

Failure LiveSession::mark(std::string_view text) {
  if (!recorder_.running()) {
    return Error{ErrorKind::kUsage, "marks belong to a recording: start one first"};
  }
  if (marks_.size() - first_mark_ >= file::kMostMarks) {
    return Error{ErrorKind::kUsage, "a recording has at most " + std::to_string(file::kMostMarks) +
                                        " marks, and this one has them"};
  }
  // Until the loop has gone back its newest sample is one of before.
  const Snapshot newest = snapshot();
  const std::uint64_t tick = newest.resets == resets_sent_ ? newest.sample.tick : 0;
  marks_.push_back({tick, file::mark_text(text)});
  return std::nullopt;
}

// Every mark is at a row: the loop may have begun, or ended, a moment later than the owner asked.
std::vector<file::Mark> LiveSession::recorded_marks() const {
  if (recorder_.rows() == 0) return {};
  std::vector<file::Mark> marks(marks_.begin() + static_cast<std::ptrdiff_t>(first_mark_),
                                marks_.end());
  for (file::Mark& mark : marks) {
    mark.tick = std::clamp(mark.tick, recorder_.first_tick(), recorder_.end_tick() - 1);
  }
  return marks;
}

RecordingStatus LiveSession::recording_status() const {
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

}  // namespace hapticwall::runtime
