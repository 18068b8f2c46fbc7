// What a wheel is told: newtons at its rim become levels of one constant force, at the pace that
// its bus takes. No thread and no clock.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "device/evdev/wheel_node.h"
#include "device/hid/link.h"

namespace hapticwall::device {

// A wheel's mechanics, of a device file. The defaults are safe for every wheel: one with less
// torque pushes with less than the commanded force.
struct WheelDescription {
  double radius_m = 0.13;      // of the hand's place
  double travel_deg = 900.0;   // from stop to stop, of the axis' whole range
  double torque_nm = 32.0;     // of level 32767: the strongest wheel known
  double sign = 1.0;           // -1: positive levels turn it to the right
  double rate_hz = 0.0;        // of updates at most; 0: of the endpoint or the model
  double delay_s = 0.0;        // from a position to its force, measured once; 0: unknown
  double force_limit_n = 5.0;  // at the radius
  double max_speed_m_per_s = 3.0;
  double max_force_rate_n_per_s = 0.0;  // 0: the whole limit within kForceRiseS
  std::string delay_date{};             // of delay_s

  friend bool operator==(const WheelDescription&, const WheelDescription&) = default;
};

struct WheelOptions {
  std::string path;  // of a node; empty: the first wheel that fits
  // Vendor 0: any wheel.
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string serial;  // empty: any
  std::string name;    // of the device file; empty: the device's own name
  WheelDescription wheel;
  // As ImpulseEngineOptions::prepare_thread.
  std::function<void()> prepare_thread;
};

// Between the units of the kernel and metres and newtons at the hand. Realtime-safe: yes.
class WheelScale {
 public:
  WheelScale(const WheelDescription& wheel, evdev::WheelAxis axis);

  // Greater values are to the right; 0 is the middle of the range.
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
  [[nodiscard]] double travel_m() const { return travel_m_; }

 private:
  double travel_m_;
  double encoder_m_;
  double middle_;
  double full_n_;  // with the sign
  double limit_n_;
};

// Between two plays of the force; the wheel ends it after evdev::kEffectMs without one.
inline constexpr std::int64_t kReplayNs = 25'000'000;
// After the force was made: its reports may still be in the kernel's queue, and would stay there.
inline constexpr std::int64_t kSilenceNs = 10'000'000;

// The writer's thread: at most one report to the wheel per interval, the newest force only. Without
// a fresh command that enables, it takes the force away: level 0, stop, gain 0.
class WheelWriter {
 public:
  // All outlive it. `rate_hz`: of reports, positive.
  WheelWriter(evdev::WheelNode& node, const WheelScale& scale, LinkExchange& exchange,
              std::uint32_t session, double rate_hz, std::int64_t now_ns);

  struct Next {
    std::int64_t at_ns = 0;      // of the next step; a new command may come before
    bool command_counts = true;  // no: the bus takes no report before
  };
  // Sends at most one report. Waits as long as the kernel does.
  Next step(const HostClock& now_ns);
  // Before that no report may go out.
  [[nodiscard]] std::int64_t free_ns() const { return free_ns_; }

  // Any thread: takes the force away, then is over().
  void stop() { stop_.store(true, std::memory_order_release); }
  // It has nothing more to do: stopped, or the wheel took a report no more.
  [[nodiscard]] bool over() const { return over_.load(std::memory_order_acquire); }

 private:
  [[nodiscard]] std::int16_t wanted(std::int64_t now_ns, bool& pushes);
  // Sends the most urgent report; false if there is none.
  [[nodiscard]] bool send(std::int16_t level, bool pushes, std::int64_t now_ns);
  [[nodiscard]] bool take_away();
  bool play(bool starts);
  bool set_level(std::int16_t level);
  bool set_gain(bool full);
  bool sent(bool taken);

  evdev::WheelNode& node_;
  const WheelScale& scale_;
  LinkExchange& exchange_;
  const std::uint32_t session_;
  const std::int64_t interval_ns_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> over_{false};

  LinkCommand newest_;
  std::int64_t free_ns_;
  std::int64_t replay_ns_ = 0;
  std::int16_t level_ = 0;  // in the wheel, as are these two
  bool plays_ = false;
  bool is_fresh_ = false;  // the level was sent again since the last play
  bool has_gain_ = false;
};

}  // namespace hapticwall::device
