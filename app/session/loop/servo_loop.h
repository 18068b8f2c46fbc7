// The real-time loop: one cycle as a function. loop_driver.h calls it.
#pragma once

#include <cstdint>
#include <vector>

#include "app/session/loop/arming.h"
#include "app/session/loop/clock.h"
#include "app/session/loop/cost_window.h"
#include "app/session/loop/cycle_scheduler.h"
#include "app/session/loop/exchange.h"
#include "app/session/loop/loop_axis.h"
#include "device/device.h"

namespace hapticwall::session {

// The loop's state. The devices are open; they and the exchange outlive the loop.
class ServoLoop {
 public:
  // One device for each axis, x first; all axes tick together. `borrowed`: instead of the algorithm
  // of axis x, or nullptr. `allow_slow_device`: arms one with a poor delay, too. Precondition: 1 to
  // kMaxAxes devices.
  // Realtime-safe: no.
  ServoLoop(const std::vector<device::Device*>& devices, Exchange& exchange,
            const LoopParameters& initial, bool start_paused, BorrowedAlgorithm* borrowed = nullptr,
            bool allow_slow_device = false);

  // One cycle: takes commands and parameters, ticks unless paused, and publishes the results. Reads
  // `clock` once, after the tick. Throws only what the device throws. Realtime-safe: yes.
  void cycle(const Wake& wake, Clock& clock);
  // Periods to be left out before the next cycle, kRestS of them while a simulator is paused:
  // nothing moves then.
  [[nodiscard]] std::uint64_t rest_periods() const { return rest_periods_; }

  // Commands zero force and nothing else, for a process that ends inside a cycle.
  void remove_force() noexcept;
  // Zero force, closes the devices and informs the owner. Realtime-safe: no.
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
  [[nodiscard]] Tick tick_axes();
  [[nodiscard]] ArmingFacts facts(const Tick& tick) const;
  void count_force(const Tick& tick);
  void hand_out(const Tick& tick);
  void idle();
  void show_start();
  void count(const Wake& wake, std::int64_t done_ns, bool ticked);

  std::vector<LoopAxis> axes_;
  Exchange& exchange_;
  Arming arming_;
  Snapshot snapshot_;
  CostWindow cost_;
  LedHand hand_;
  double elapsed_s_ = 0.0;       // since the previous cycle
  std::int64_t latency_ns_ = 0;  // of the present cycle
  std::uint32_t steps_left_ = 0;
  std::uint32_t periods_since_tick_ = 0;
  bool recording_ = false;
  bool echo_due_ = true;  // the next tick is the first of a reset or of new parameters
  bool at_start_ = true;  // the next tick is tick 0
  std::uint64_t rest_periods_ = 0;
};

// Interval at which a paused simulator checks for commands.
inline constexpr double kRestS = 0.01;

}  // namespace hapticwall::session
