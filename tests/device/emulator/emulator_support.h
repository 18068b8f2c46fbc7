// A simple host for the emulated device: it commands every tick.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/emulator/firmware/firmware_emulator.h"

namespace hapticwall::device::hid::testing {

inline constexpr std::uint64_t kTickUs = 1000;
inline constexpr std::uint64_t kMillisecondUs = 1000;
inline constexpr double kLimitN = 8.9;
inline constexpr double kPushN = 2.0;
inline constexpr int kWatchdogMs = 50;
inline constexpr double kEncoderM = 0.254e-3;

// A handle held by a hand, always far from its end stops.
inline Scene held_scene() {
  Scene scene;
  scene.x().device.mass_kg = 0.05;
  scene.x().device.damping_n_s_per_m = 1.0;
  scene.x().device.encoder_m = kEncoderM;
  scene.x().device.force_limit_n = kLimitN;
  scene.x().device.start_m = 0.03;
  HandSettings hand;
  hand.stiffness_n_per_m = 250.0;
  hand.damping_n_s_per_m = 10.0;
  hand.path = {{0.0, 0.03}, {0.1, 0.03}};
  scene.x().hand = hand;
  return scene;
}

inline EmulatorSettings one_axis() {
  EmulatorSettings settings;
  settings.axes = {held_scene()};
  return settings;
}

inline EmulatorSettings two_axes() {
  EmulatorSettings settings = one_axis();
  settings.axes.push_back(held_scene());
  settings.axes[1].x().device.start_m = -0.02;
  settings.axes[1].x().hand->path = {{0.0, -0.02}, {0.1, -0.02}};
  settings.axes[1].x().device.force_limit_n = 5.0;
  return settings;
}

class Bench {
 public:
  explicit Bench(FaultScript script = {}) : Bench(one_axis(), std::move(script)) {}
  explicit Bench(const EmulatorSettings& settings, FaultScript script = {})
      : device(settings, std::move(script)) {}

  // Steps to the next tick, and takes everything that comes out of it.
  void tick() { step(device.next_tick_us() - device.now_us()); }
  void step(std::uint64_t microseconds) {
    device.step(microseconds);
    while (const auto report = device.take_input()) {
      reports.push_back(*report);
      const auto decoded = decode_state(report->view());
      if (decoded.report() != nullptr) state = *decoded.report();
    }
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }

  // The next command of this session from the newest state, with defaults.
  [[nodiscard]] ForceReport next_command(double force_n) {
    ForceReport command;
    command.enable = true;
    command.sequence = ++sequence;
    command.echoed_state_sequence = state.sequence;
    command.force_n = {force_n, 0.0};
    return command;
  }
  bool send(const ForceReport& command) { return device.write_output(encode_force(command)); }
  bool push(double force_n) { return send(next_command(force_n)); }
  void send_without_enable() {
    ForceReport command = next_command(0.0);
    command.enable = false;
    send(command);
  }
  void clear_faults() {
    ForceReport command = next_command(0.0);
    command.enable = false;
    command.clear_faults = true;
    send(command);
  }
  // Commands and ticks in turn.
  void drive(double force_n, int count = 1) {
    for (int i = 0; i < count; ++i) {
      push(force_n);
      tick();
    }
  }

  [[nodiscard]] double force_n() const { return device.amplifier_force_n()[0]; }
  [[nodiscard]] bool has(std::uint16_t status) const { return (state.status & status) == status; }

  FirmwareEmulator device;
  std::vector<InputReport> reports;
  StateReport state;  // the newest valid one
  std::uint16_t sequence = 0;
};

}  // namespace hapticwall::device::hid::testing
