#include "app/runtime/session/loop_session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <utility>

#include "app/file/recording/sidecar.h"
#include "app/file/text/text.h"
#include "app/runtime/session/scene_change.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace hapticwall::runtime {
namespace {

// Polling interval of the owner while it waits for the loop.
constexpr std::chrono::microseconds kAnswerPollInterval{200};

// Each axis of a scene as a scene of one axis.
std::vector<Scene> axes_of(const Scene& scene) {
  std::vector<Scene> axes;
  for (std::size_t i = 0; i < scene.axes.size(); ++i) axes.push_back(axis_scene(scene, i));
  return axes;
}

LoopParameters parameters_of(const ParameterHistory& history) {
  const std::vector<Scene> axes = axes_of(history.newest());
  LoopParameters parameters;
  for (std::size_t i = 0; i < axes.size(); ++i) parameters.axes[i].servo = servo_settings(axes[i]);
  parameters.generation = history.generation();
  return parameters;
}

std::deque<PlantKeeper> plant_keepers(const Scene& scene) {
  std::deque<PlantKeeper> keepers;
  for (const Scene& axis : axes_of(scene)) keepers.emplace_back(axis);
  return keepers;
}

std::vector<device::Device*> pointers_to(
    const std::vector<std::unique_ptr<device::Device>>& devices) {
  std::vector<device::Device*> pointers;
  pointers.reserve(devices.size());
  for (const auto& device : devices) pointers.push_back(device.get());
  return pointers;
}

// With the revision of a plug-in that is the newest one now, so that the history tells which one
// was in force.
Scene with_revision(Scene scene) {
  scene.algorithm.revision = plugin_revision(scene.algorithm.index);
  return scene;
}

file::CsvColumns columns_of(const device::DeviceInfo& device, std::size_t axes,
                            const SessionOptions& options) {
  file::CsvColumns columns = file::csv_columns(device.is_simulated, axes);
  columns.signals = options.signals;
  return columns;
}

// The move for the axes that have a hand; nullopt where it is no motion.
std::optional<HandMove> hand_move(const Scene& scene, HandMove move) {
  bool any = false;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    if (i >= scene.axes.size() || !scene.axes[i].hand) move.m[i] = std::nan("");
    if (std::isinf(move.m[i])) return std::nullopt;
    any = any || !std::isnan(move.m[i]);
  }
  const double pace = move.to_place ? move.speed_m_per_s : move.duration_s;
  const bool evenly = std::isfinite(pace) && (move.to_place ? pace > 0.0 : pace >= 0.0);
  return any && evenly ? std::optional(move) : std::nullopt;
}

// End of a recording that still runs.
constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();

}  // namespace

LoopSession::LoopSession(std::vector<std::unique_ptr<device::Device>> devices, const Scene& scene,
                         const SessionOptions& options, BorrowedAlgorithm* borrowed)
    : plants_(plant_keepers(scene)),
      devices_(std::move(devices)),
      device_info_(devices_.front()->info()),
      columns_(columns_of(device_info_, devices_.size(), options)),
      history_(with_revision(scene)),
      exchange_(options.queues, parameters_of(history_)),
      loop_(pointers_to(devices_), exchange_, parameters_of(history_), options.start_paused,
            borrowed, options.allow_slow_device),
      recorder_(exchange_.recorder),
      clock_(options.clock != nullptr ? *options.clock : monotonic_clock_,
             spin_ns(options.spin_s, scene.sampling.rate_hz)) {
  if (options.stream) {  // before the loop, so that tick 0 is in it
    recorder_.stream_into(options.stream, columns_);
    start_recorder(nullptr);
  }
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

// Zero force first; the disk may take its time.
LoopSession::~LoopSession() {
  exchange_.stop.store(true, std::memory_order_relaxed);
  thread_.join();
  static_cast<void>(finish_recording());
}

// Withdraws parameters that the loop has not read, so that the owner knows which plant the loop
// uses when it reads the new ones.
std::optional<SceneProblem> LoopSession::change_scene(const Scene& asked) {
  const Scene wanted = with_revision(scene_on(asked, device_info_));
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
    const std::vector<Scene> axes = axes_of(history_.newest());
    for (std::size_t i = 0; i < axes.size(); ++i) {
      parameters.axes[i].plant = plants_[i].plant_for(axes[i], history_.generation(), unread);
    }
  }
  exchange_.parameters.publish(parameters);
  return std::nullopt;
}

void LoopSession::move_hand(const HandMove& wanted) {
  std::optional<HandMove> move = hand_move(scene(), wanted);
  if (!move) return;
  if (move->at_once) drop_hand_moves();
  move->gesture = exchange_.hand_gesture.load(std::memory_order_relaxed);
  unsent_moves_.push_back(*move);
  exchange_news();
}

void LoopSession::drop_hand_moves() {
  unsent_moves_.clear();
  exchange_.hand_gesture.fetch_add(1, std::memory_order_release);
}

std::size_t LoopSession::plants_kept() const {
  std::size_t count = 0;
  for (const PlantKeeper& plants : plants_) count += plants.count();
  return count;
}

void LoopSession::arm(bool armed) { send({armed ? CommandKind::kArm : CommandKind::kDisarm, 0}); }

void LoopSession::pause(bool paused) {
  send({paused ? CommandKind::kPause : CommandKind::kResume, 0});
}

void LoopSession::slow_down(std::uint32_t periods_per_tick) {
  send({CommandKind::kSlow, periods_per_tick});
}

void LoopSession::step(std::uint32_t ticks) { send({CommandKind::kStep, ticks}); }

void LoopSession::reset() {
  if (recorder_.running()) static_cast<void>(stop_recording());
  marks_.clear();
  first_mark_ = 0;
  ++resets_sent_;
  history_.restart();
  drop_hand_moves();
  send({CommandKind::kReset, 0});
}

// No command is lost: commands that do not fit wait here.
void LoopSession::send(const Command& command) {
  unsent_.push_back(command);
  exchange_news();
}

void LoopSession::exchange_news() {
  while (!unsent_.empty() && exchange_.commands.try_push(unsent_.front())) unsent_.pop_front();
  while (!unsent_moves_.empty() && exchange_.hand_moves.try_push(unsent_moves_.front()))
    unsent_moves_.pop_front();
  ParameterEcho echo;
  while (exchange_.echoes.try_pop(echo)) {
    history_.came_into_force(echo);
    for (PlantKeeper& plants : plants_) plants.came_into_force(echo.generation);
  }
  note_recording();
}

Snapshot LoopSession::snapshot() {
  exchange_news();
  exchange_.snapshots.update();
  return exchange_.snapshots.current();
}

void LoopSession::read_timing(TimingHistograms& timing) const {
  exchange_.wake_latency.read(timing.wake_latency);
  exchange_.compute_time.read(timing.compute_time);
}

std::size_t LoopSession::take_ticks(std::span<Tick> out) {
  exchange_news();
  std::size_t count = 0;
  while (count < out.size() && exchange_.plot.try_pop(out[count])) ++count;
  return count;
}

std::uint64_t LoopSession::dropped_plot_samples() const {
  return exchange_.dropped_plot_samples.load(std::memory_order_relaxed);
}

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
    std::this_thread::sleep_for(kAnswerPollInterval);
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
  return std::nullopt;
}

void LoopSession::name_mark(std::string_view text) {
  if (!recorder_.running() || marks_.size() <= first_mark_) return;
  marks_.back().text = file::mark_text(text);
  ++marks_revision_;
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

}  // namespace hapticwall::runtime
