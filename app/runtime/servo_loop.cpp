#include "app/runtime/servo_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapticwall::runtime {
namespace {

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / kNanosecondsPerSecond;
}

std::uint32_t saturating_sum(std::uint32_t a, std::uint32_t b) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  return a > kMost - b ? kMost : a + b;
}

}  // namespace

ServoLoop::ServoLoop(device::Device& device, Exchange& exchange, const LoopParameters& initial,
                     bool start_paused)
    : device_(device),
      exchange_(exchange),
      servo_(initial.servo),
      arming_(!device.info().is_simulated, initial.servo.rate_hz) {
  snapshot_.generation = initial.generation;
  snapshot_.paused = start_paused;
  show_start();
  exchange_.snapshots.publish(snapshot_);
}

void ServoLoop::cycle(const Wake& wake, Clock& clock) {
  take_commands();
  const bool ticks = !snapshot_.paused || steps_left_ > 0;
  if (ticks) {
    tick();
    if (steps_left_ > 0) --steps_left_;
    ++snapshot_.timing.ticks;
  } else {
    idle();
  }
  show_arming();
  snapshot_.link = device_.link();
  count(wake, clock.now_ns(), ticks);
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
      // Everything recorded before is in the queue by now; the owner waits for this.
      exchange_.recording_switches.fetch_add(1, std::memory_order_release);
      break;
  }
}

void ServoLoop::reset() {
  disarm(ArmingNote::kAsked);
  device_.reset();
  servo_.reset();
  steps_left_ = 0;
  hand_led_ = false;
  echo_due_ = true;
  at_start_ = true;
  ++snapshot_.resets;
  exchange_.pointer_led.store(false, std::memory_order_relaxed);
  show_start();
}

// The snapshot before tick 0: where the device rests, no force, no energies.
void ServoLoop::show_start() {
  Sample sample;
  sample.position_m = device_.read().position_m;
  sample.penetration_m =
      evaluate_walls(servo_.settings().walls, sample.position_m, 0.0).penetration_m;
  if (const PlantTruth* truth = device_.truth()) sample.truth = *truth;
  sample.generation = snapshot_.generation;
  snapshot_.sample = sample;
}

void ServoLoop::take_parameters() {
  if (exchange_.echoes.size() >= kFreeEchoPlaces || !exchange_.parameters.update()) return;
  const LoopParameters& parameters = exchange_.parameters.current();
  servo_.apply(parameters.servo);
  if (parameters.plant != plant_ && parameters.plant != nullptr) {
    plant_ = parameters.plant;
    device_.change_plant(*plant_);
  }
  // Before tick 0 nothing is in force yet: no change to flag, no force to lead over from.
  if (at_start_) servo_.reset();
  snapshot_.generation = parameters.generation;
  echo_due_ = true;
}

void ServoLoop::lead_hand() {
  const double pointer_m = exchange_.pointer_m.load(std::memory_order_relaxed);
  if (!std::isnan(pointer_m)) {
    device_.lead_hand_to(pointer_m);
    if (!hand_led_) exchange_.pointer_led.store(true, std::memory_order_relaxed);
    hand_led_ = true;
  } else if (hand_led_) {
    device_.release_hand();
    hand_led_ = false;
  }
}

// A simulator's amplifiers need no leave.
void ServoLoop::disarm(ArmingNote why) {
  arming_.disarm(why);
  if (!arming_.enabled()) device_.enable(false);
}

void ServoLoop::show_arming() {
  ArmingStatus& shown = snapshot_.arming;
  shown.state = arming_.state();
  shown.note = arming_.note();
  shown.gain = arming_.gain();
  shown.asked = arming_.answers();
}

void ServoLoop::tick() {
  take_parameters();
  lead_hand();
  servo_.state().force_gain = arming_.gain();
  device_.enable(arming_.enabled());
  Sample sample = servo_.tick(device_);
  if (arming_.after_tick(arming_facts(sample, servo_.state().failed))) {
    device_.enable(false);
    device_.write(0.0);
  }
  sample.generation = snapshot_.generation;
  at_start_ = false;
  hand_out(sample);
}

void ServoLoop::hand_out(const Sample& sample) {
  snapshot_.sample = sample;
  if (echo_due_) {
    // Cannot fail: nothing makes an echo due while there is no room for it.
    echo_due_ = !exchange_.echoes.try_push({sample.tick, sample.generation});
  }
  if (!exchange_.plot.try_push(sample)) {
    exchange_.dropped_plot_samples.fetch_add(1, std::memory_order_relaxed);
  }
  if (recording_ && !exchange_.recorder.try_push(sample)) {
    exchange_.dropped_rows.fetch_add(1, std::memory_order_relaxed);
  }
}

// Paused. A simulated plant stands still with the force that it has; in a real device's hands time
// goes on, so it is disarmed, its force is zero and its watchdog is fed.
void ServoLoop::idle() {
  if (device_.truth() != nullptr) return;
  disarm(ArmingNote::kPaused);
  snapshot_.sample.position_m = device_.read().position_m;
  snapshot_.sample.force_n = 0.0;
  device_.write(0.0);
  // The handle is moved meanwhile: the next tick's position is no step from the last one's.
  servo_.state().position_known = false;
  servo_.state().previous_force_n = 0.0;
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
  const CostFigures& cost = cost_.figures();
  timing.cost_ticks = cost.ticks;
  timing.median_cost_s = seconds(cost.median_ns);
  timing.maximum_cost_s = seconds(cost.maximum_ns);
}

void ServoLoop::shut_down(bool by_itself) noexcept {
  // A device that throws here as well is still to be closed, and the owner to be told.
  try {
    device_.enable(false);
    device_.write(0.0);
  } catch (...) {
    by_itself = true;
  }
  try {
    device_.close();
  } catch (...) {
    by_itself = true;
  }
  snapshot_.ended_by_fault = by_itself;
  snapshot_.sample.force_n = 0.0;
  arming_.disarm(by_itself ? ArmingNote::kDevice : ArmingNote::kAsked);
  show_arming();
  if (by_itself) snapshot_.sample.flags |= kFlagDeviceFault;
  exchange_.snapshots.publish(snapshot_);
  exchange_.finished.store(true, std::memory_order_release);
}

void run_servo_loop(ServoLoop& loop, Exchange& exchange, double rate_hz, Clock& clock) noexcept {
  bool failed = false;
  try {
    CycleScheduler scheduler(rate_hz, clock.now_ns());
    while (!exchange.stop.load(std::memory_order_relaxed)) {
      clock.sleep_until_ns(scheduler.deadline_ns());
      loop.cycle(scheduler.wake(clock.now_ns()), clock);
    }
  } catch (...) {
    failed = true;
  }
  loop.shut_down(failed);
}

}  // namespace hapticwall::runtime
