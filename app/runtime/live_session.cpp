#include "app/runtime/live_session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <future>
#include <utility>

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

LoopParameters parameters_of(const ParameterHistory& history, PlantModel* plant = nullptr) {
  return {servo_settings(history.newest()), history.generation(), plant};
}

}  // namespace

LiveSession::LiveSession(std::unique_ptr<device::Device> device, const Scene& scene,
                         const SessionOptions& options)
    : plants_(scene),
      device_(std::move(device)),
      device_info_(device_->info()),
      history_(scene),
      exchange_(options, parameters_of(history_)),
      loop_(*device_, exchange_, parameters_of(history_), options.start_paused),
      recorder_(exchange_.recorder) {
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
  PlantModel* plant = nullptr;
  if (device_info_.is_simulated) {
    plant = plants_.plant_for(history_.newest(), history_.generation(), unread);
  }
  exchange_.parameters.publish(parameters_of(history_, plant));
  return std::nullopt;
}

void LiveSession::lead_hand(std::optional<double> position_m) {
  if (!scene().hand) return;
  double pointer_m = kNoPointer;
  if (position_m && std::isfinite(*position_m)) {
    pointer_m = std::clamp(*position_m, kPositionRange.minimum, kPositionRange.maximum);
  }
  exchange_.pointer_m.store(pointer_m, std::memory_order_relaxed);
}

void LiveSession::arm(bool armed) { send({armed ? CommandKind::kArm : CommandKind::kDisarm, 0}); }

void LiveSession::pause(bool paused) {
  send({paused ? CommandKind::kPause : CommandKind::kResume, 0});
}

void LiveSession::step(std::uint32_t ticks) { send({CommandKind::kStep, ticks}); }

void LiveSession::reset() {
  if (recorder_.running()) static_cast<void>(stop_recording());
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
  }
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
  auto writer = file::RecordingWriter::create(csv_path, device_info_.is_simulated
                                                            ? file::MoreColumns::kSimulator
                                                            : file::MoreColumns::kDevice);
  if (!writer) return writer.error();
  record_into(std::move(*writer));
  return std::nullopt;
}

void LiveSession::record_into(std::unique_ptr<file::RecordingWriter> writer) {
  recording_path_ = writer->csv_path();
  recording_start_time_ = utc_now();
  recording_failure_.reset();
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
  recording_failure_ = recorder_.finish(history_.scene_at_start(), metadata());
  if (!recording_failure_ && dropped_rows() > 0) {
    recording_failure_ = Error{
        ErrorKind::kFile, recording_path_ + ": " + std::to_string(dropped_rows()) +
                              " rows are missing (the disk was too slow); marked as incomplete"};
  }
  return recording_failure_;
}

file::RecordingMetadata LiveSession::metadata() const {
  file::RecordingMetadata metadata;
  metadata.start_time = recording_start_time_;
  metadata.device = device_info_.name;
  metadata.realtime_status = realtime_.text;
  metadata.dropped_rows = dropped_rows();
  metadata.changes = history_.changes_before(recorder_.end_tick());
  const bool led = exchange_.pointer_led.load(std::memory_order_relaxed) ||
                   (history_.newest().hand && history_.newest().hand->follows_mouse);
  if (!device_info_.is_simulated) {
    metadata.not_repeatable_because = "a device was used, not the simulator";
  } else if (led) {
    metadata.not_repeatable_because = "the pointer led the hand";
  }
  metadata.repeatable = metadata.not_repeatable_because.empty();
  return metadata;
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
