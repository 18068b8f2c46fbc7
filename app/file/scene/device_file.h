// Device descriptions, built in or from TOML files. They serve devices that cannot describe
// themselves (docs/hid-protocol.md) or describe themselves wrongly.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/dialect.h"
#include "core/result.h"

namespace hapticwall::file {

struct AxisDescription {
  double encoder_m = 0.0;               // travel of the hand per count, 1e-9 to 0.01; 0: not given
  double force_limit_n = 0.0;           // more than 0, at most 32.767
  double min_m = -0.3;                  // workspace, -10 to 0
  double max_m = 0.3;                   // 0 to 10
  double max_force_rate_n_per_s = 0.0;  // more than 0, at most 1e6; 0: not given
  double max_speed_m_per_s = 3.0;       // of the handle, more than 0, at most 100
  // Values as in a scene, for sessions on the simulator.
  std::optional<double> mass_kg{};
  std::optional<double> damping_n_s_per_m{};
  std::optional<double> friction_n{};

  friend bool operator==(const AxisDescription&, const AxisDescription&) = default;
};

// A wheel or stick of the kernel (docs/wheels.md).
struct FfDescription {
  double radius_m = 0.13;     // of the hand on the wheel, 0.01 to 1
  double travel_deg = 900.0;  // from stop to stop, 1 to 3600
  double torque_nm = 0.0;     // the largest one of the wheel, 0.01 to 100
  double sign = 1.0;          // 1 or -1: positive levels turn it to the right
  double rate_hz = 0.0;       // max rate of updates, 10 to 1000; 0: not given
  double delay_s = 0.0;       // from a position to its force, 0 to 1; 0: not known
  std::string delay_date{};   // date of the measurement; empty: delay_s is not known

  friend bool operator==(const FfDescription&, const FfDescription&) = default;
};
inline constexpr double kWheelLimitN = 5.0;  // for a file that gives no limit

// The stiffest and the most damped wall that CHAI3D's source sets for the device.
struct ChaiLimits {
  double max_stiffness_n_per_m = 0.0;  // more than 0, at most 1e9
  double max_damping_n_s_per_m = 0.0;  // more than 0, at most 1e4

  friend bool operator==(const ChaiLimits&, const ChaiLimits&) = default;
};

struct DeviceDescription {
  std::string name;
  std::string source;  // where the numbers come from
  double rate_hz = 1000.0;
  // 0: the file has no [usb]. It opens no device, and may lack the encoder: scenes name it.
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string serial;  // empty: any
  AxisDescription x;   // with `ff`: encoder and workspace follow from the wheel
  std::optional<AxisDescription> y{};
  std::optional<FfDescription> ff{};  // set: a wheel, not a device of docs/hid-protocol.md
  std::string identified{};  // result, date and quality of `hapticwall identify`; may be empty
  std::optional<ChaiLimits> chai3d{};
  std::optional<Dialect> dialect{};  // nullopt: it speaks docs/hid-protocol.md

  friend bool operator==(const DeviceDescription&, const DeviceDescription&) = default;
};

// `origin` names the text in messages ("paddle.toml:12: x.encoder_m …"). Realtime-safe: no.
[[nodiscard]] Result<DeviceDescription> parse_device(std::string_view toml_text,
                                                     const std::string& origin);

// `name_or_path`: a built-in description or a file. Realtime-safe: no.
[[nodiscard]] Result<DeviceDescription> load_device(const std::string& name_or_path);

// The text of a file that parse_device() reads back the same.
[[nodiscard]] std::string device_to_toml(const DeviceDescription& device);

struct BuiltinDevice {
  std::string name;  // name of the file, without ".toml"
  std::string_view toml_text;
};
[[nodiscard]] const std::vector<BuiltinDevice>& builtin_devices();

}  // namespace hapticwall::file
