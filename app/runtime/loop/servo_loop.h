// The real-time loop: one cycle as a function, and the thread's body around it.
#pragma once

#include <cstdint>
#include <optional>

#include "app/runtime/arming.h"
#include "app/runtime/clock.h"
#include "app/runtime/cost_window.h"
#include "app/runtime/cycle_scheduler.h"
#include "app/runtime/exchange.h"
#include "core/servo.h"
#include "device/device.h"

namespace hapticwall::runtime {

// One axis of the loop: its device, its controller, its plant.
struct LoopAxis {
  device::Device& device;
  Servo servo;
  PlantModel* plant = nullptr;  // in use; nullptr: the device's own
  bool hand_led = false;

  // Realtime-safe: yes, all of it.
  void apply(const ServoSettings& settings, PlantModel* new_plant);
  // Nothing, or not a number: the script leads the hand. True where the pointer has begun to.
  bool lead_hand(double pointer_m);
  void reset();
  // The sample before tick 0: where the device rests, no force, no energies.
  [[nodiscard]] Sample at_rest();
};

// The loop's state. The devices are open; it and the exchange outlive the loop.
class ServoLoop {
 public:
  // Realtime-safe: no.
  // `y_device`: of the second axis, or null. Both axes tick together, each by itself.
  ServoLoop(device::Device& device, Exchange& exchange, const LoopParameters& initial,
            bool start_paused, device::Device* y_device = nullptr);

  // One cycle: commands, newest parameters, a tick (unless paused), and its results handed out.
  // `clock` is asked once, after the tick, for the time that the tick took.
  // Throws only what the device throws. Realtime-safe: yes.
  void cycle(const Wake& wake, Clock& clock);

  // Zero force, device closed, the owner told. Realtime-safe: no.
  void shut_down(bool by_itself) noexcept;

 private:
  void take_commands();
  void execute(const Command& command);
  void reset();
  void take_parameters();
  void lead_hand();
  void disarm(ArmingNote why);
  void show_arming();
  void tick();
  [[nodiscard]] Sample tick_axis(LoopAxis& axis);
  [[nodiscard]] ArmingFacts facts(const Sample& x, const Sample& y) const;
  void hand_out(const Sample& x, const Sample& y);
  void idle();
  void show_start();
  void count(const Wake& wake, std::int64_t done_ns, bool ticked);

  template <typename Action>
  void for_each_axis(Action&& action) {
    action(x_);
    if (y_) action(*y_);
  }

  LoopAxis x_;
  std::optional<LoopAxis> y_;
  Exchange& exchange_;
  Arming arming_;
  Snapshot snapshot_;
  CostWindow cost_;
  std::uint32_t steps_left_ = 0;
  bool recording_ = false;
  bool echo_due_ = true;  // the next tick is the first of a reset or of new parameters
  bool at_start_ = true;  // the next tick is tick 0
};

// The thread's body: cycles at `rate_hz` until the exchange says stop; whatever happens, it ends
// with zero force and a closed device. No exception leaves it. Realtime-safe: yes, from the first
// cycle to the last.
void run_servo_loop(ServoLoop& loop, Exchange& exchange, double rate_hz, Clock& clock) noexcept;

}  // namespace hapticwall::runtime
