// Drive of a wheel: newtons at its rim become levels of one constant force, at the pace that its
// bus takes. No thread and no clock.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <string>

#include "device/link/report.h"
#include "device/port/wheel_node.h"

namespace hapticwall::device {

// A wheel's mechanics, of a device file. The defaults are safe for every wheel: one with less
// torque pushes with less than the commanded force.
struct WheelDescription {
  double radius_m = 0.13;      // of the hand on the wheel
  double travel_deg = 900.0;   // from stop to stop, of the axis' whole range
  double torque_nm = 32.0;     // torque at level 32767: the strongest wheel known
  double sign = 1.0;           // -1: positive levels turn it to the right
  double rate_hz = 0.0;        // max rate of updates; 0: that of the endpoint or the model
  double delay_s = 0.0;        // from a position to its force, measured once; 0: unknown
  double force_limit_n = 5.0;  // at the radius
  double max_speed_m_per_s = 3.0;
  double max_force_rate_n_per_s = 0.0;  // 0: the whole limit within kForceRiseS
  std::string delay_date{};             // date of the measurement of delay_s

  [[nodiscard]] double travel_m() const;
  // At the radius, of level 32767.
  [[nodiscard]] double full_n() const { return torque_nm / radius_m; }
  [[nodiscard]] double limit_n() const { return std::fmin(force_limit_n, full_n()); }

  friend bool operator==(const WheelDescription&, const WheelDescription&) = default;
};

// Between the units of the kernel and metres and newtons at the hand. Realtime-safe: yes.
class WheelScale {
 public:
  WheelScale(const WheelDescription& wheel, evdev::WheelAxis axis);

  // Whole counts; greater values are to the right. 0 is the middle of the range, or half a count
  // to its right.
  [[nodiscard]] double position_m(std::int32_t value) const {
    return (value - middle_) * encoder_m_;
  }
  // 0 for a force that is not finite; clamped to the limit. `force_n` pushes to smaller positions.
  [[nodiscard]] std::int16_t level(double force_n) const;
  // The inverse of level().
  [[nodiscard]] double force_n(std::int16_t level) const {
    return level * full_n_ / evdev::kFullLevel;
  }
  [[nodiscard]] double encoder_m() const { return encoder_m_; }
  [[nodiscard]] double limit_n() const { return limit_n_; }

 private:
  double encoder_m_;
  double middle_;
  double full_n_;  // with the sign
  double limit_n_;
};

// Between two plays of the force; the wheel ends it after evdev::kEffectMs without one.
inline constexpr std::int64_t kReplayNs = 25'000'000;
// Silence after the force was made: its reports may still be in the kernel's queue, and would stay
// there.
inline constexpr std::int64_t kSilenceNs = 10'000'000;

// At most one report to the wheel per interval, for the newest command only. A command that does
// not enable takes the force away: level 0, stop, gain 0. One thread, except taken_n().
class WheelWriter {
 public:
  // Both outlive it. `rate_hz`: of reports, positive.
  WheelWriter(evdev::WheelNode& node, const WheelScale& scale, double rate_hz, std::int64_t now_ns);
  WheelWriter(const WheelWriter&) = delete;
  WheelWriter& operator=(const WheelWriter&) = delete;
  // Takes away what is left of the force.
  ~WheelWriter();

  // Sends the most urgent report of the command, if there is one. One that enables is ignored
  // before free_ns(). Waits as long as the kernel does. False: the wheel did not take the report,
  // and is gone.
  [[nodiscard]] bool write(const hid::ForceReport& command, std::int64_t now_ns);
  // When the bus takes the next report.
  [[nodiscard]] std::int64_t free_ns() const { return free_ns_; }
  // The force that the kernel took last. Any thread.
  [[nodiscard]] double taken_n() const { return taken_n_; }

 private:
  enum class Sent : std::uint8_t { kNothing, kTaken, kRefused };
  [[nodiscard]] Sent send(std::int16_t level, std::int64_t now_ns);
  [[nodiscard]] Sent take_away();
  Sent set_level(std::int16_t level);
  Sent play(bool starts);
  Sent set_gain(bool full);
  Sent sent(bool taken);

  evdev::WheelNode& node_;
  const WheelScale scale_;
  const std::int64_t interval_ns_;
  std::int64_t free_ns_;
  std::int64_t replay_ns_ = 0;
  std::int16_t level_ = 0;  // in the wheel, like the next two
  bool plays_ = false;
  bool has_gain_ = false;
  bool is_fresh_ = false;  // the level was sent again since the last play
  std::atomic<double> taken_n_{0.0};
};

}  // namespace hapticwall::device
