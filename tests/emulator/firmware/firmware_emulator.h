// An emulated haptic device: the simulator's plant, firmware by docs/hid-protocol.md, a bus, and a
// script of faults. Deterministic in virtual time: no threads, no I/O, no clock.
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
#include "device/link/report.h"
#include "tests/emulator/firmware/fault_script.h"
#include "tests/emulator/firmware/firmware.h"

namespace hapticwall::device::hid {

struct EmulatorSettings {
  // One or two axes: for each, a scene whose axis x is its device and hand; walls and algorithm
  // belong to the host and are ignored. The common rate is the device's tick, in whole
  // microseconds. Defaults: a count of 1 um, and the largest force of a report.
  std::vector<Scene> axes = std::vector<Scene>(1);
  std::uint16_t watchdog_ms = 50;
  bool has_info = true;  // false: only a device file describes it
  // Hand and handle rest until the amplifiers are first enabled, so that the scene starts with the
  // host's session.
  bool hand_waits = false;
  double temperature_c = 25.0;
  double supply_v = 24.0;
};

// An input report as sent over the bus.
struct InputReport {
  static constexpr std::size_t kMaxBytes = 80;

  std::uint64_t time_us = 0;
  std::size_t size = 0;
  std::array<std::uint8_t, kMaxBytes> bytes{};

  [[nodiscard]] std::span<const std::uint8_t> view() const { return std::span(bytes).first(size); }
};

class FirmwareEmulator {
 public:
  // Precondition: the scenes are valid. Realtime-safe: no.
  explicit FirmwareEmulator(const EmulatorSettings& settings, FaultScript script = {});

  // Advances the time and executes every tick in it. The first is one tick after the start.
  void step(std::uint64_t microseconds);
  [[nodiscard]] std::uint64_t now_us() const { return now_us_; }
  [[nodiscard]] std::uint64_t next_tick_us() const { return next_tick_us_; }
  [[nodiscard]] std::uint64_t tick_us() const { return tick_us_; }
  [[nodiscard]] std::size_t axes() const { return plants_.size(); }

  // The oldest queued report. The queue is unbounded.
  [[nodiscard]] std::optional<InputReport> take_input();

  // While held, no report is sent; the next one sent flags the overrun.
  void hold_reports(bool held) { held_ = held; }

  // True if write_output() would be accepted now; otherwise a host waits.
  [[nodiscard]] bool accepts_output() const;
  // A packet of any bytes to the output endpoint; false if it is not accepted.
  bool write_output(std::span<const std::uint8_t> bytes);

  // A feature report, if the device answers.
  [[nodiscard]] std::optional<ReportBytes> get_feature(std::uint8_t id) const;

  [[nodiscard]] bool is_plugged() const;

  // Force at the amplifiers now, newtons towards growing counts.
  [[nodiscard]] std::array<double, kMaxAxes> amplifier_force_n() const;
  // The newest latched state, sent or not; all zero before the first tick.
  [[nodiscard]] const StateReport& state() const { return state_; }
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
  void receive(std::span<const std::uint8_t> bytes, std::uint64_t at_us);
  void receive_due();
  [[nodiscard]] StateReport as_told();
  [[nodiscard]] double told_offset_m();
  void tell_time(StateReport& told);

  FaultScript script_;
  EmulatorSettings settings_;
  Firmware firmware_;
  std::vector<PlantModel> plants_;
  std::array<double, kMaxAxes> encoder_m_{};
  std::uint64_t tick_us_ = 0;
  std::uint64_t now_us_ = 0;
  std::uint64_t next_tick_us_ = 0;
  std::uint64_t power_up_us_ = 0;  // start of the device's clock
  std::uint64_t on_bus_us_ = 0;    // when it was last on the bus
  std::uint64_t alive_us_ = 0;     // when the firmware last ran
  std::array<std::int32_t, kMaxAxes> encoder_counts_{};
  std::array<std::int32_t, kMaxAxes> counts_at_power_up_{};
  bool calibrated_ = true;
  bool hung_ = false;  // the hardware watchdog expired, and the firmware still hangs
  bool overrun_ = false;
  bool held_ = false;
  bool hand_waits_ = false;
  StateReport state_;
  std::deque<InputReport> on_the_wire_;
  std::optional<InputReport> last_sent_;
  struct Late {
    std::uint64_t due_us = 0;
    std::vector<std::uint8_t> bytes;
  };
  std::deque<Late> late_;  // commands on a slow way
  // Newest states, for an acknowledgement that is withheld.
  std::deque<StateReport> told_;
  double clock_ahead_us_ = 0.0;  // lead of a clock at a wrong rate
  std::uint32_t random_ = 1;     // state of the noise generator
};

}  // namespace hapticwall::device::hid
