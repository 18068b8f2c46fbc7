#include "app/runtime/servo_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/runtime/crash_stop.h"

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

void LoopAxis::apply(const ServoSettings& settings, PlantModel* new_plant) {
  servo.apply(settings);
  if (new_plant == plant || new_plant == nullptr) return;
  plant = new_plant;
  device.change_plant(*plant);
}

bool LoopAxis::lead_hand(double pointer_m) {
  if (std::isnan(pointer_m)) {
    if (hand_led) device.release_hand();
    hand_led = false;
    return false;
  }
  device.lead_hand_to(pointer_m);
  return !std::exchange(hand_led, true);
}

void LoopAxis::reset() {
  device.reset();
  servo.reset();
  hand_led = false;
}

Sample LoopAxis::at_rest() {
  Sample sample;
  sample.position_m = device.read().position_m;
  sample.penetration_m =
      evaluate_walls(servo.settings().walls, sample.position_m, 0.0).penetration_m;
  if (const PlantTruth* truth = device.truth()) sample.truth = *truth;
  return sample;
}

ServoLoop::ServoLoop(device::Device& device, Exchange& exchange, const LoopParameters& initial,
                     bool start_paused, device::Device* y_device)
    : x_{device, Servo(initial.servo)},
      exchange_(exchange),
      arming_(!device.info().is_simulated, initial.servo.rate_hz) {
  if (y_device != nullptr) y_.emplace(LoopAxis{*y_device, Servo(initial.y_servo)});
  snapshot_.generation = initial.generation;
  snapshot_.paused = start_paused;
  show_start();
  exchange_.snapshots.publish(snapshot_);
}

// A real device has let go of a force that nobody renewed for so long (docs/hid-protocol.md): what
// comes back then must not come back at once.
void ServoLoop::cycle(const Wake& wake, Clock& clock) {
  if (seconds(wake.latency_ns) > kDefaultMaximumAgeS) disarm(ArmingNote::kLate);
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
  snapshot_.link = x_.device.link();
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
  for_each_axis([](LoopAxis& axis) { axis.reset(); });
  steps_left_ = 0;
  echo_due_ = true;
  at_start_ = true;
  ++snapshot_.resets;
  exchange_.pointer_led.store(false, std::memory_order_relaxed);
  show_start();
}

void ServoLoop::show_start() {
  snapshot_.sample = x_.at_rest();
  snapshot_.sample.generation = snapshot_.generation;
  if (!y_) return;
  snapshot_.y = y_->at_rest();
  snapshot_.y.generation = snapshot_.generation;
}

void ServoLoop::take_parameters() {
  if (exchange_.echoes.size() >= kFreeEchoPlaces || !exchange_.parameters.update()) return;
  const LoopParameters& parameters = exchange_.parameters.current();
  x_.apply(parameters.servo, parameters.plant);
  if (y_) y_->apply(parameters.y_servo, parameters.y_plant);
  // Before tick 0 nothing is in force yet: no change to flag, no force to lead over from.
  if (at_start_) for_each_axis([](LoopAxis& axis) { axis.servo.reset(); });
  snapshot_.generation = parameters.generation;
  echo_due_ = true;
}

void ServoLoop::lead_hand() {
  bool begun = x_.lead_hand(exchange_.pointer_m.load(std::memory_order_relaxed));
  if (y_ && y_->lead_hand(exchange_.y_pointer_m.load(std::memory_order_relaxed))) begun = true;
  if (begun) exchange_.pointer_led.store(true, std::memory_order_relaxed);
}

// A simulator's amplifiers need no leave.
void ServoLoop::disarm(ArmingNote why) {
  arming_.disarm(why);
  if (!arming_.enabled()) for_each_axis([](LoopAxis& axis) { axis.device.enable(false); });
}

void ServoLoop::show_arming() {
  ArmingStatus& shown = snapshot_.arming;
  shown.state = arming_.state();
  shown.note = arming_.note();
  shown.gain = arming_.gain();
  shown.asked = arming_.answers();
}

// The arming of both axes is one: what is wrong with either concerns both.
ArmingFacts ServoLoop::facts(const Sample& x, const Sample& y) const {
  ArmingFacts both = arming_facts(x, x_.servo.state().failed);
  if (!y_) return both;
  const ArmingFacts second = arming_facts(y, y_->servo.state().failed);
  both.fault = both.fault || second.fault;
  both.stale = both.stale || second.stale;
  both.failed = both.failed || second.failed;
  both.in_contact = both.in_contact || second.in_contact;
  both.parameters_changed = both.parameters_changed || second.parameters_changed;
  return both;
}

Sample ServoLoop::tick_axis(LoopAxis& axis) {
  axis.servo.state().force_gain = arming_.gain();
  axis.device.enable(arming_.enabled());
  Sample sample = axis.servo.tick(axis.device);
  sample.generation = snapshot_.generation;
  return sample;
}

void ServoLoop::tick() {
  take_parameters();
  lead_hand();
  const Sample x = tick_axis(x_);
  const Sample y = y_ ? tick_axis(*y_) : Sample{};
  if (arming_.after_tick(facts(x, y))) {
    for_each_axis([](LoopAxis& axis) {
      axis.device.enable(false);
      axis.device.write(0.0);
    });
  }
  at_start_ = false;
  hand_out(x, y);
}

void ServoLoop::hand_out(const Sample& x, const Sample& y) {
  snapshot_.sample = x;
  snapshot_.y = y;
  if (echo_due_) {
    // Cannot fail: nothing makes an echo due while there is no room for it.
    echo_due_ = !exchange_.echoes.try_push({x.tick, x.generation});
  }
  const auto push = [&](SpscQueue<Sample>& x_queue, SpscQueue<Sample>& y_queue) {
    return y_ ? push_both(x_queue, y_queue, x, y) : x_queue.try_push(x);
  };
  if (!push(exchange_.plot, exchange_.y_plot)) {
    exchange_.dropped_plot_samples.fetch_add(1, std::memory_order_relaxed);
  }
  if (recording_ && !push(exchange_.recorder, exchange_.y_recorder)) {
    exchange_.dropped_rows.fetch_add(1, std::memory_order_relaxed);
  }
}

// Paused. A simulated plant stands still with the force that it has; in a real device's hands time
// goes on, so it is disarmed, its force is zero and its watchdog is fed.
void ServoLoop::idle() {
  if (x_.device.truth() != nullptr) return;
  disarm(ArmingNote::kPaused);
  for_each_axis([this](LoopAxis& axis) {
    Sample& shown = &axis == &x_ ? snapshot_.sample : snapshot_.y;
    shown.position_m = axis.device.read().position_m;
    shown.force_n = 0.0;
    axis.device.write(0.0);
    // The handle is moved meanwhile: the next tick's position is no step from the last one's.
    axis.servo.state().position_known = false;
    axis.servo.state().previous_force_n = 0.0;
  });
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
  for_each_axis([&](LoopAxis& axis) {
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
  });
  snapshot_.ended_by_fault = by_itself;
  snapshot_.sample.force_n = 0.0;
  snapshot_.y.force_n = 0.0;
  arming_.disarm(by_itself ? ArmingNote::kDevice : ArmingNote::kAsked);
  show_arming();
  if (by_itself) snapshot_.sample.flags |= kFlagDeviceFault;
  exchange_.snapshots.publish(snapshot_);
  exchange_.finished.store(true, std::memory_order_release);
}

void run_servo_loop(ServoLoop& loop, Exchange& exchange, double rate_hz, Clock& clock) noexcept {
  const LoopWithForce until_shut_down;
  bool by_itself = false;
  try {
    CycleScheduler scheduler(rate_hz, clock.now_ns());
    while (!exchange.stop.load(std::memory_order_relaxed) && !must_end_force()) {
      clock.sleep_until_ns(scheduler.deadline_ns());
      loop.cycle(scheduler.wake(clock.now_ns()), clock);
    }
    by_itself = must_end_force();
  } catch (...) {
    by_itself = true;
  }
  loop.shut_down(by_itself);
}

}  // namespace hapticwall::runtime
