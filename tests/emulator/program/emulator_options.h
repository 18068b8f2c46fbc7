// The options of hapticwall-emulator.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/sample.h"
#include "tests/emulator/firmware/fault_script.h"
#include "tests/emulator/firmware/firmware_emulator.h"
#include "tests/emulator/firmware/uhid_device.h"
#include "tests/emulator/program/device_loop.h"

namespace hapticwall::emulator {

// Options as written.
struct EmulatorOptions {
  std::array<std::string, kMaxAxes> scenes{"press"};  // values of SCENE and --y
  std::vector<std::string> settings;                  // values of --set, for SCENE
  std::string vendor = "1209";
  std::string product = "0001";
  std::string serial = device::hid::HidIdentity{}.serial;
  std::string name = device::hid::HidIdentity{}.name;
  std::string hand = "waits";
  std::string watchdog_ms;
  std::string duration;
  std::string log;
  std::vector<std::string> faults;
  bool in_step = false;
  bool without_info = false;
};

// Options as parsed.
struct Plan {
  device::hid::EmulatorSettings device;
  device::hid::FaultScript faults;
  device::hid::HidIdentity identity;
  LoopSettings loop;
  std::string log;  // empty: none
};

// The names of all kinds of faults, separated by commas.
[[nodiscard]] std::string fault_names();

// A fault: KIND@BEGIN+DURATION in seconds since the start, with /EVERY for every N-th tick only
// ("unplugged@3+1", "bad-crc@1+2/10"), and with =AMOUNT for a lie ("jump=0.2@3+0.001").
[[nodiscard]] Result<device::hid::Fault> parse_fault(std::string_view text);

void add_options(CLI::App& program, EmulatorOptions& options);

// Checks the options and reads the scenes.
[[nodiscard]] Result<Plan> make_plan(const EmulatorOptions& options);

}  // namespace hapticwall::emulator
