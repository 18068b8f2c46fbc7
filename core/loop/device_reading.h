// What one read of a device gives: simulated or real, the servo step knows nothing else of it.
#pragma once

#include <cstdint>

namespace hapticwall {

enum class DeviceState : std::uint8_t { kOk, kFault };

struct DeviceReading {
  double position_m = 0.0;  // as the encoder tells it
  double age_s = 0.0;       // of the position; 0 for the simulator
  DeviceState state = DeviceState::kOk;
  double device_time_s = 0.0;  // of the position, by the device's own clock; 0 for the simulator
};

}  // namespace hapticwall
