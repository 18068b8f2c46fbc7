// The real-time loop: one cycle as a function, and the thread's body around it.
#pragma once

#include <cstdint>

#include "app/runtime/arming.h"
#include "app/runtime/clock.h"
#include "app/runtime/cost_window.h"
#include "app/runtime/cycle_scheduler.h"
#include "app/runtime/exchange.h"
#include "core/servo.h"
#include "device/device.h"

namespace hapticwall::runtime {

// The loop's state. The device is open; it and the exchange outlive the loop.
class ServoLoop {
 public:
  // Realtime-safe: no.
  ServoLoop(device::Device& device, Exchange& exchange, const LoopParameters& initial,
            bool start_paused);

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
  void hand_out(const Sample& sample);
  void idle();
  void show_start();
  void count(const Wake& wake, std::int64_t done_ns, bool ticked);

  device::Device& device_;
  Exchange& exchange_;
  Servo servo_;
  Arming arming_;
  PlantModel* plant_ = nullptr;  // in use; nullptr: the device's own
  Snapshot snapshot_;
  CostWindow cost_;
  std::uint32_t steps_left_ = 0;
  bool hand_led_ = false;
  bool recording_ = false;
  bool echo_due_ = true;  // the next tick is the first of a reset or of new parameters
  bool at_start_ = true;  // the next tick is tick 0
};

// The thread's body: cycles at `rate_hz` until the exchange says stop; whatever happens, it ends
// with zero force and a closed device. No exception leaves it. Realtime-safe: yes, from the first
// cycle to the last.
void run_servo_loop(ServoLoop& loop, Exchange& exchange, double rate_hz, Clock& clock) noexcept;

}  // namespace hapticwall::runtime
