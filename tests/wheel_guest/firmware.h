// The firmware and the mechanics of the emulated wheel: PID reports in, a force at the rim, the
// steering angle out. No I/O and no clock.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "device/simulated_device.h"

namespace hapticwall::wheel {

struct Settings {
  double full_force_n = 20.0;  // at the rim, for level 32767
  double travel_m = 2.0420;    // of the rim from stop to stop: 900 degrees at 0.13 m
  double report_hz = 1000.0;   // of positions; only changes are sent
  bool autocentres = false;    // a spring of its own, until FF_AUTOCENTER 0
  bool is_held = true;         // by a hand that trembles, until the first effect
  double deaf_after_s = 1e9;   // takes output reports and does not act on them
};

class Firmware {
 public:
  // `scene` gives plant and hand, ticking at 1 kHz. The hand starts with the first effect.
  Firmware(const Scene& scene, const Settings& settings) : plant_(scene), settings_(settings) {}

  // An output or feature report with its id first.
  void take(std::span<const std::uint8_t> report);
  // A feature report with its id; empty if there is none.
  [[nodiscard]] std::vector<std::uint8_t> feature(std::uint8_t id) const;
  // One millisecond.
  void tick();
  // The input report to send now.
  [[nodiscard]] std::optional<std::array<std::uint8_t, 3>> news();

  [[nodiscard]] double position_m() const { return position_m_; }
  // Force of the motor, positive to smaller positions.
  [[nodiscard]] double force_n() const { return force_n_; }
  [[nodiscard]] std::int16_t level() const { return ours_.level; }
  [[nodiscard]] unsigned taken() const { return taken_; }
  [[nodiscard]] bool started() const { return ticks_ > 0; }

 private:
  struct Effect {
    bool there = false;
    std::uint16_t length_ms = 0;
    std::uint16_t delay_ms = 0;
    std::uint8_t gain = kFull;
    std::uint16_t direction = 0;
    std::int16_t level = 0;
    unsigned left_ms = 0;  // of the present play
  };
  static constexpr std::uint8_t kFull = 255;
  static constexpr std::size_t kEffects = 8;
  static constexpr unsigned kForever = 1'000'000'000;

  [[nodiscard]] Effect& effect(std::uint8_t block) { return effects_.at(block % kEffects); }
  void operate(std::span<const std::uint8_t> report);
  void control(std::uint8_t what);
  [[nodiscard]] double motor_n() const;
  [[nodiscard]] double tremble_m();

  device::SimulatedDevice plant_;
  Settings settings_;
  std::array<Effect, kEffects> effects_{};
  Effect ours_;  // the newest constant force, for the log
  std::uint8_t loaded_ = 0;
  bool enabled_ = false;
  std::uint8_t gain_ = kFull;
  std::uint64_t ticks_ = 0;
  unsigned held_ms_ = 0;
  unsigned taken_ = 0;
  double position_m_ = 0.0;
  double force_n_ = 0.0;
  double next_report_ms_ = 0.0;
  std::optional<std::int16_t> sent_;
};

}  // namespace hapticwall::wheel
