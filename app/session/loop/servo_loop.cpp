#include "app/session/loop/servo_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapticwall::session {
namespace {

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / kNanosecondsPerSecond;
}

std::uint32_t saturating_sum(std::uint32_t a, std::uint32_t b) {
  constexpr std::uint32_t kMax = std::numeric_limits<std::uint32_t>::max();
  return a > kMax - b ? kMax : a + b;
}

}  // namespace

ServoLoop::ServoLoop(const std::vector<device::Device*>& devices, Exchange& exchange,
                     const LoopParameters& initial, bool start_paused, BorrowedAlgorithm* borrowed,
                     bool allow_slow_device)
    : exchange_(exchange),
      arming_(!devices.front()->info().is_simulated, initial.axes.front().servo.rate_hz) {
  for (device::Device* device : devices) {
    LoopAxis& axis =
        axes_.emplace_back(LoopAxis{*device, Servo(initial.axes.at(axes_.size()).servo)});
    const JudgeOptions options{axis.servo.settings().rate_hz, allow_slow_device};
    device::DeviceInfo info = device->info();
    // A borrowed algorithm finds the sign by itself.
    if (axes_.size() == 1 && borrowed != nullptr) info.untried_share = 1.0;
    if (!info.is_simulated) axis.judge.emplace(info, options);
  }
  if (borrowed != nullptr) axes_.front().servo.borrow(*borrowed);
  snapshot_.newest.count = static_cast<std::uint8_t>(axes_.size());
  snapshot_.generation = initial.generation;
  snapshot_.paused = start_paused;
  show_start();
  exchange_.snapshots.publish(snapshot_);
}

// After a cycle later than kDefaultMaxAgeS a real device has dropped the force
// (docs/hid-protocol.md). The force must not return abruptly, so the loop disarms.
void ServoLoop::cycle(const Wake& wake, Clock& clock) {
  if (seconds(wake.latency_ns) > kDefaultMaxAgeS) disarm(ArmingNote::kLate);
  take_commands();
  elapsed_s_ = axes_.front().servo.settings().period_s() * static_cast<double>(1 + wake.missed) +
               seconds(wake.latency_ns - latency_ns_);
  latency_ns_ = wake.latency_ns;
  const bool due = ++periods_since_tick_ >= snapshot_.periods_per_tick;
  const bool ticks = steps_left_ > 0 || (due && !snapshot_.paused);
  if (ticks) {
    tick();
    periods_since_tick_ = 0;
    if (steps_left_ > 0) --steps_left_;
    ++snapshot_.timing.ticks;
  } else {
    idle();
  }
  show_arming();
  snapshot_.link = axes_.front().device.link();
  rest_periods_ = 0;
  if (snapshot_.paused && steps_left_ == 0 && axes_.front().device.info().is_simulated)
    rest_periods_ = static_cast<std::uint64_t>(kRestS / axes_.front().servo.settings().period_s());
  snapshot_.timing.rested_periods += rest_periods_;
  count(wake, clock.now_ns(), ticks);
  ++snapshot_.cycles;
  exchange_.snapshots.publish(snapshot_);
}

void ServoLoop::take_commands() {
  Command command;
  while (exchange_.echoes.size() < kFreeEchoPlaces && exchange_.commands.try_pop(command)) {
    execute(command);
  }
}

void ServoLoop::execute(const Command& command) {
  switch (command.kind) {
    case CommandKind::kPause:
      snapshot_.paused = true;
      break;
    case CommandKind::kResume:
      snapshot_.paused = false;
      steps_left_ = 0;
      break;
    case CommandKind::kStep:
      if (snapshot_.paused) steps_left_ = saturating_sum(steps_left_, command.ticks);
      break;
    case CommandKind::kSlow:
      // A hand on a real device must not wait for its force.
      if (axes_.front().device.info().is_simulated)
        snapshot_.periods_per_tick = std::max(command.ticks, 1U);
      break;
    case CommandKind::kReset:
      reset();
      break;
    case CommandKind::kArm:
      arming_.ask();
      break;
    case CommandKind::kDisarm:
      disarm(ArmingNote::kAsked);
      break;
    case CommandKind::kStartRecording:
    case CommandKind::kStopRecording:
      recording_ = command.kind == CommandKind::kStartRecording;
      // The owner waits for this: all earlier rows are in the queue now.
      exchange_.recording_switches.fetch_add(1, std::memory_order_release);
      break;
  }
}

void ServoLoop::reset() {
  disarm(ArmingNote::kAsked);
  for (LoopAxis& axis : axes_) axis.reset();
  hand_ = {};
  steps_left_ = 0;
  echo_due_ = true;
  at_start_ = true;
  ++snapshot_.resets;
  exchange_.pointer_led.store(false, std::memory_order_relaxed);
  show_start();
}

void ServoLoop::show_start() {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Sample& sample = snapshot_.newest.axes[i];
    sample = axes_[i].at_rest();
    sample.generation = snapshot_.generation;
  }
}

void ServoLoop::take_parameters() {
  if (exchange_.echoes.size() >= kFreeEchoPlaces || !exchange_.parameters.update()) return;
  const LoopParameters& parameters = exchange_.parameters.current();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].apply(parameters.axes[i].servo, parameters.axes[i].plant);
    // Before tick 0 there is no change to flag and no force to blend from.
    if (at_start_) axes_[i].servo.reset();
  }
  snapshot_.generation = parameters.generation;
  echo_due_ = true;
}

void ServoLoop::lead_hand() {
  LedHand::Places present_m{};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const PlantTruth* truth = axes_[i].device.truth();
    if (truth == nullptr) return;
    present_m[i] = truth->hand_path_m;
  }
  hand_.next_tick(exchange_.hand_moves, exchange_.hand_gesture.load(std::memory_order_acquire),
                  axes_.front().servo.settings().period_s(), present_m);
  if (!hand_.leads()) return;
  exchange_.pointer_led.store(true, std::memory_order_relaxed);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!std::isnan(hand_.target_m()[i])) axes_[i].device.lead_hand_to(hand_.target_m()[i]);
  }
}

// A simulator stays enabled.
void ServoLoop::disarm(ArmingNote why) {
  arming_.disarm(why);
  if (arming_.enabled()) return;
  for (LoopAxis& axis : axes_) axis.device.enable(false);
}

void ServoLoop::show_arming() {
  ArmingStatus& shown = snapshot_.arming;
  if (shown.state != arming_.state()) shown.since_s = snapshot_.newest.x().time_s;
  shown.state = arming_.state();
  shown.note = arming_.note();
  shown.gain = arming_.gain();
  shown.asked = arming_.answers();
  shown.limit_share = axes_.front().servo.state().limit_share;
}

// All axes are armed together: a fault of one disarms all.
ArmingFacts ServoLoop::facts(const Tick& tick) const {
  ArmingFacts all;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const ArmingFacts one = arming_facts(tick.axes[i], axes_[i].servo.state().failed,
                                         axes_[i].servo.settings().environment == nullptr);
    all.fault = all.fault || one.fault;
    all.stale = all.stale || one.stale;
    all.failed = all.failed || one.failed;
    all.in_contact = all.in_contact || one.in_contact;
    all.parameters_changed = all.parameters_changed || one.parameters_changed;
    if (all.judged == ArmingNote::kNone) all.judged = axes_[i].judged;
    const bool waits = axes_[i].judge && axes_[i].judge->waits_for_answer();
    all.waits_for_answer = all.waits_for_answer || waits;
  }
  return all;
}

Tick ServoLoop::tick_axes() {
  Tick tick;
  tick.count = static_cast<std::uint8_t>(axes_.size());
  const auto read = [&](LoopAxis& axis) {
    return axis.read(elapsed_s_, arming_.gain(), arming_.enabled());
  };
  if (axes_.size() == 2 && axes_.front().servo.settings().both_axes) {
    ReadDevice x = read(axes_.front());
    ReadDevice y = read(axes_.back());
    tick.axes = Servo::tick_together(axes_.front().servo, x, axes_.back().servo, y);
  } else {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      ReadDevice device = read(axes_[i]);
      tick.axes[i] = axes_[i].servo.tick(device);
    }
  }
  for (Sample& sample : tick.in_use()) sample.generation = snapshot_.generation;
  return tick;
}

void ServoLoop::tick() {
  take_parameters();
  lead_hand();
  const Tick tick = tick_axes();
  if (arming_.after_tick(facts(tick))) {
    for (LoopAxis& axis : axes_) {
      axis.device.enable(false);
      axis.device.write(0.0);
    }
  }
  at_start_ = false;
  count_force(tick);
  hand_out(tick);
}

// Counts the armed ticks for the note about a force that is mostly at its limit.
void ServoLoop::count_force(const Tick& tick) {
  const ServoSettings& settings = axes_.front().servo.settings();
  if (!arming_.enabled()) return;
  ++snapshot_.arming.armed_ticks;
  if (full_force(tick.x().force_n, settings.force_limit_n) != 0) ++snapshot_.arming.limit_ticks;
}

void ServoLoop::hand_out(const Tick& tick) {
  snapshot_.newest = tick;
  if (echo_due_) {
    // Cannot fail: no echo becomes due while the queue lacks room.
    echo_due_ = !exchange_.echoes.try_push({tick.x().tick, tick.x().generation});
  }
  if (!exchange_.plot.try_push(tick)) {
    exchange_.dropped_plot_samples.fetch_add(1, std::memory_order_relaxed);
  }
  if (recording_ && !exchange_.recorder.try_push(tick)) {
    exchange_.dropped_rows.fetch_add(1, std::memory_order_relaxed);
  }
  if (exchange_.sound->wanted.load(std::memory_order_relaxed)) {
    static_cast<void>(exchange_.sound->ticks.try_push(tick));  // a full queue is a gap in the sound
  }
}

// Paused. A simulated plant freezes with its force. A real device is disarmed, and zero forces keep
// its watchdog from expiring.
void ServoLoop::idle() {
  if (axes_.front().device.truth() != nullptr) return;
  disarm(ArmingNote::kPaused);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    LoopAxis& axis = axes_[i];
    snapshot_.newest.axes[i].position_m = axis.device.read().position_m;
    snapshot_.newest.axes[i].force_n = 0.0;
    axis.device.write(0.0);
    // Motion during a pause is unobserved: the next tick must not derive a velocity from it.
    axis.servo.state().position_known = false;
    if (axis.judge) axis.judge->forget();
    axis.servo.state().previous_force_n = 0.0;
  }
}

void ServoLoop::count(const Wake& wake, std::int64_t done_ns, bool ticked) {
  TimingStatistics& timing = snapshot_.timing;
  timing.missed_ticks += wake.missed;
  timing.wake_latency_s = seconds(wake.latency_ns);
  timing.maximum_wake_latency_s = std::max(timing.maximum_wake_latency_s, timing.wake_latency_s);
  timing.compute_time_s = seconds(done_ns - wake.now_ns);
  timing.maximum_compute_time_s = std::max(timing.maximum_compute_time_s, timing.compute_time_s);
  exchange_.wake_latency.add(wake.latency_ns);
  exchange_.compute_time.add(done_ns - wake.now_ns);
  if (!ticked) return;
  cost_.add(wake.now_ns, done_ns - wake.now_ns);
  const CostStats& cost = cost_.stats();
  timing.cost_ticks = cost.ticks;
  timing.median_cost_s = seconds(cost.median_ns);
  timing.maximum_cost_s = seconds(cost.maximum_ns);
}

void ServoLoop::remove_force() noexcept {
  for (LoopAxis& axis : axes_) {
    try {
      axis.device.enable(false);
      axis.device.write(0.0);
    } catch (...) {  // the other axes, too
    }
  }
}

void ServoLoop::shut_down(bool by_itself) noexcept {
  // If a device throws here too, the others must still be closed and the owner informed.
  for (LoopAxis& axis : axes_) {
    try {
      axis.device.enable(false);
      axis.device.write(0.0);
    } catch (...) {
      by_itself = true;
    }
    try {
      axis.device.close();
    } catch (...) {
      by_itself = true;
    }
  }
  snapshot_.ended_by_fault = by_itself;
  for (Sample& sample : snapshot_.newest.in_use()) sample.force_n = 0.0;
  arming_.disarm(by_itself ? ArmingNote::kDevice : ArmingNote::kAsked);
  show_arming();
  if (by_itself) snapshot_.newest.axes[0].flags |= kFlagDeviceFault;
  exchange_.snapshots.publish(snapshot_);
  exchange_.finished.store(true, std::memory_order_release);
}

}  // namespace hapticwall::session
