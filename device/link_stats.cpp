#include "device/link_stats.h"

namespace hapticwall::device {

std::string_view trouble_text(Trouble trouble) {
  switch (trouble) {
    case Trouble::kNone:
      return "";
    case Trouble::kNotFound:
      return "no haptic device is connected";
    case Trouble::kSilent:
      return "the device was silent for 20 ms";
    case Trouble::kRefused:
      return "the device cannot be used";
    case Trouble::kRestarted:
      return "the device has restarted";
    case Trouble::kCalibration:
      return "the calibration of the device has changed";
    case Trouble::kWatchdog:
      return "the watchdog of the device has expired: it received no command in time";
    case Trouble::kEmergencyStop:
      return "the emergency stop of the device is pressed";
    case Trouble::kOverTemperature:
      return "the amplifiers of the device are too hot";
    case Trouble::kOverCurrent:
      return "the amplifiers of the device draw too much current";
    case Trouble::kEncoder:
      return "an encoder of the device has failed";
    case Trouble::kOwnFault:
      return "the device reports a fault specific to it";
  }
  return "";
}

}  // namespace hapticwall::device
