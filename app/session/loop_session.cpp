#include "app/session/loop_session.h"

#include <cmath>
#include <utility>

#include "app/session/scene_change.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace hapticwall::session {
namespace {

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

// The scene with the newest revision of its plug-in, so that the history tells which one was in
// force.
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
             spin_ns(options.spin_s, scene.sampling.rate_hz)),
      events_(options.stream, algorithms()[scene.algorithm.index].name) {
  if (options.stream) {  // before the loop, so that tick 0 is in it
    recorder_.stream_into(options.stream, columns_);
    start_recorder(nullptr);
  }
  const double rate_hz = scene.sampling.rate_hz;
  driver_ = options.driver == Driver::kTurnedByOwner
                ? turned_by_owner(loop_, exchange_, rate_hz, clock_)
                : start_loop_thread(loop_, exchange_, rate_hz, clock_, options.affinity_core);
  realtime_ = driver_->status();
}

// Zero force first; the disk may take its time.
LoopSession::~LoopSession() {
  driver_.reset();
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
    events_.algorithm({echo.tick, static_cast<double>(echo.tick) * scene().sampling.period_s()},
                      algorithms()[history_.algorithm_in_force()].name);
  }
  note_recording();
}

Snapshot LoopSession::snapshot() {
  exchange_news();
  exchange_.snapshots.update();
  events_.arming(newest_tick(), exchange_.snapshots.current().arming);
  return exchange_.snapshots.current();
}

EventTick LoopSession::newest_tick() const {
  const Sample& newest = exchange_.snapshots.current().newest.x();
  return {newest.tick, newest.time_s};
}

void LoopSession::add_event(std::string_view name, std::string_view more) {
  events_.other(newest_tick(), name, more);
}

void LoopSession::read_timing(TimingHistograms& timing) const {
  exchange_.wake_latency.read(timing.wake_latency);
  exchange_.compute_time.read(timing.compute_time);
}

std::size_t LoopSession::take_ticks(std::span<Tick> out) {
  driver_->turn();
  exchange_news();
  std::size_t count = 0;
  while (count < out.size() && exchange_.plot.try_pop(out[count])) ++count;
  return count;
}

std::uint64_t LoopSession::dropped_plot_samples() const {
  return exchange_.dropped_plot_samples.load(std::memory_order_relaxed);
}

}  // namespace hapticwall::session
