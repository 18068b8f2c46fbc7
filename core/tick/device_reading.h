// Result of one read of a device, simulated or real.
#pragma once

#include <cstdint>

namespace hapticwall {

// A tick with kFault commands no force and keeps the last good position.
enum class DeviceState : std::uint8_t { kOk, kFault };

struct DeviceReading {
  double position_m = 0.0;  // as measured by the encoder
  double age_s = 0.0;       // of the position; 0 for the simulator
  DeviceState state = DeviceState::kOk;
  double device_time_s = 0.0;    // of the position, by the device's clock; 0 for the simulator
  double applied_force_n = 0.0;  // as the device reports it; positive pushes out of the wall
};

}  // namespace hapticwall
