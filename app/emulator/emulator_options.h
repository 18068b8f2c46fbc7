// The options of hapticwall-emulator, and what is to be done by them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/emulator/device_loop.h"
#include "core/result.h"
#include "device/emulator/fault_script.h"
#include "device/emulator/firmware_emulator.h"
#include "device/emulator/uhid_device.h"

namespace hapticwall::emulator {

// As they were written.
struct EmulatorOptions {
  std::string scene = "press";
  std::string y_scene;
  std::vector<std::string> settings;  // of --set
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

// As they are meant.
struct Plan {
  device::hid::EmulatorSettings device;
  device::hid::FaultScript faults;
  device::hid::HidIdentity identity;
  LoopSettings loop;
  std::string log;  // empty: none
};

void add_options(CLI::App& program, EmulatorOptions& options);

// Reads the scenes. The first thing that is wrong, in one line.
[[nodiscard]] Result<Plan> make_plan(const EmulatorOptions& options);

}  // namespace hapticwall::emulator
