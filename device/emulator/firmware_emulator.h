// A haptic device that is not there: the plant of the simulator, a firmware that keeps every duty
// of docs/hid-protocol.md, a bus, and a script of faults. In virtual time: no threads, no I/O, no
// clock; the same calls give the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/plant/plant_model.h"
#include "core/scene.h"
#include "device/emulator/fault_script.h"
#include "device/emulator/firmware.h"
#include "device/hid_report.h"

namespace hapticwall::device::hid {

struct EmulatorSettings {
  // Device and hand of each axis; walls and algorithm are the host's and are not read. Their rate
  // is the device's tick, of whole microseconds and the same for both. Without an encoder a count
  // is a micrometre, without a force limit the maximum is what a report can carry.
  Scene x;
  std::optional<Scene> y;
  std::uint16_t watchdog_ms = 50;
  bool has_info = true;  // false: a device that must be described by a file
  // The hand and the handle stand still until the amplifiers are enabled for the first time: what
  // follows is the scene from its start, however long the host took to come.
  bool hand_waits = false;
  double temperature_c = 25.0;
  double supply_v = 24.0;
};

// An input report as it went over the bus.
struct InputReport {
  static constexpr std::size_t kMostBytes = 80;

  std::uint64_t time_us = 0;
  std::size_t size = 0;
  std::array<std::uint8_t, kMostBytes> bytes{};

  [[nodiscard]] std::span<const std::uint8_t> view() const { return std::span(bytes).first(size); }
};

class FirmwareEmulator {
 public:
  // Precondition: the scenes are valid. Realtime-safe: no.
  explicit FirmwareEmulator(const EmulatorSettings& settings, FaultScript script = {});

  // Time passes; every tick in it happens, at its microsecond. The first is one tick after the
  // start.
  void step(std::uint64_t microseconds);
  [[nodiscard]] std::uint64_t now_us() const { return now_us_; }
  [[nodiscard]] std::uint64_t next_tick_us() const { return next_tick_us_; }
  [[nodiscard]] std::uint64_t tick_us() const { return tick_us_; }
  [[nodiscard]] std::size_t axes() const { return plants_.size(); }

  // The oldest report that has not been taken yet. The bus of a host that never takes one keeps
  // them all.
  [[nodiscard]] std::optional<InputReport> take_input();

  // While held nobody fetches reports: none goes out, and the next one that does tells of it.
  void hold_reports(bool held) { held_ = held; }

  // True where a packet of the output endpoint would be taken at this moment; else a host waits.
  [[nodiscard]] bool accepts_output() const;
  // Any bytes, at this moment; false where they are not taken.
  bool write_output(std::span<const std::uint8_t> bytes);

  // A feature report, where the device answers.
  [[nodiscard]] std::optional<ReportBytes> get_feature(std::uint8_t id) const;

  // False while the device is off the bus.
  [[nodiscard]] bool is_plugged() const;

  // Really at the amplifiers now, newtons towards growing counts.
  [[nodiscard]] std::array<double, kMostAxes> amplifier_force_n() const;
  // What the firmware latched last, sent or not; all zero before its first tick.
  [[nodiscard]] const StateReport& state() const { return state_; }
  // Axis 0 or, where there is a second one, 1.
  [[nodiscard]] const PlantTruth& truth(std::size_t axis) const { return plants_.at(axis).truth(); }
  [[nodiscard]] PlantModel& plant(std::size_t axis) { return plants_.at(axis); }

 private:
  [[nodiscard]] bool lasts(FaultKind kind) const { return script_.lasts(kind, now_us_); }
  [[nodiscard]] bool has_power() const { return !lasts(FaultKind::kRestart) && !hung_; }
  [[nodiscard]] HardwareState hardware() const;
  [[nodiscard]] StateReport latch();
  void pass_tick();
  void move_plants();
  void read_encoders();
  void lose_power();
  void send();
  void spoil(InputReport& report) const;

  FaultScript script_;
  EmulatorSettings settings_;
  Firmware firmware_;
  std::vector<PlantModel> plants_;
  std::array<double, kMostAxes> encoder_m_{};
  std::uint64_t tick_us_ = 0;
  std::uint64_t now_us_ = 0;
  std::uint64_t next_tick_us_ = 0;
  std::uint64_t power_up_us_ = 0;  // where the device's clock begins
  std::uint64_t on_bus_us_ = 0;    // when it was last seen there
  std::uint64_t alive_us_ = 0;     // when the firmware last ran
  std::array<std::int32_t, kMostAxes> encoder_counts_{};
  std::array<std::int32_t, kMostAxes> counts_at_power_up_{};
  bool calibrated_ = true;
  bool hung_ = false;  // the watchdog in hardware has struck, the firmware is not back yet
  bool overrun_ = false;
  bool held_ = false;
  bool hand_waits_ = false;  // still
  StateReport state_;
  std::deque<InputReport> on_the_wire_;
  std::optional<InputReport> last_sent_;
};

}  // namespace hapticwall::device::hid
