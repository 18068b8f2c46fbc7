// Descriptions of devices: any text.
#include <cmath>
#include <string>

#include "app/file/scene/device_file.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

using file::AxisDescription;
using file::DeviceDescription;

constexpr std::size_t kMaxNameBytes = 100;
constexpr std::size_t kMaxSourceBytes = 1000;
constexpr std::size_t kMaxSerialBytes = 126;

bool is_within(double value, double least, double most) { return value >= least && value <= most; }

// A file that opens no device of docs/hid-protocol.md may lack the encoder.
bool is_axis(const AxisDescription& axis, bool opens) {
  const bool lacks_encoder = !opens && axis.encoder_m == 0.0;
  return (lacks_encoder || is_within(axis.encoder_m, 1e-9, 0.01)) && axis.force_limit_n > 0.0 &&
         axis.force_limit_n <= 32.767 && is_within(axis.min_m, -10.0, 0.0) &&
         is_within(axis.max_m, 0.0, 10.0) && is_within(axis.max_force_rate_n_per_s, 0.0, 1e6) &&
         axis.max_speed_m_per_s > 0.0 && axis.max_speed_m_per_s <= 100.0;
}

bool is_wheel(const DeviceDescription& device) {
  return is_within(device.ff->radius_m, 0.01, 1.0) &&
         is_within(device.ff->torque_nm, 0.01, 100.0) && std::abs(device.ff->sign) == 1.0 &&
         device.x.force_limit_n > 0.0 && device.x.force_limit_n <= 32.767;
}

// A field is inside its report, and each axis has one.
bool is_layout(const ReportLayout& layout, bool has_y) {
  const auto fits = [&](const std::optional<ReportField>& field) {
    return field->offset + bytes_of(field->type) <= layout.bytes && field->per_unit != 0.0 &&
           std::isfinite(field->per_unit) && is_within(field->clamp, 0.0, 1e9);
  };
  return layout.bytes >= 1 && layout.bytes <= kMaxDialectBytes && layout.axes[0] &&
         fits(layout.axes[0]) && layout.axes[1].has_value() == has_y &&
         (!has_y || fits(layout.axes[1]));
}

bool is_dialect(const DeviceDescription& device) {
  const bool has_y = device.y.has_value();
  return is_layout(device.dialect->in, has_y) && is_layout(device.dialect->out, has_y) &&
         device.dialect->keep_alive_ms >= 1 && device.dialect->keep_alive_ms <= 20;
}

void require_texts(const DeviceDescription& device) {
  require(!device.name.empty() && device.name.size() <= kMaxNameBytes, "a device has a name");
  require(!device.source.empty() && device.source.size() <= kMaxSourceBytes,
          "a device's numbers have a source");
  require(device.serial.size() <= kMaxSerialBytes, "a serial number fits into a descriptor");
  require(is_clean(device.name) && is_clean(device.source) && is_clean(device.serial),
          "the texts of a device are clean lines");
}

Outcome fuzz_one(Bytes input) {
  const std::string origin = "fuzz.toml";
  const Result<DeviceDescription> device = file::parse_device(text_of(input), origin);
  if (!device) {
    require_one_clean_line(device.error(), origin);
    return Outcome::kRefused;
  }
  require_texts(*device);
  require(is_within(device->rate_hz, 10.0, 10e3), "a rate is in its range");
  require((device->vendor_id > 0) == (device->product_id > 0), "a device has both numbers or none");
  require(!device->dialect || is_dialect(*device), "a dialect has its fields inside its reports");
  const bool opens = device->vendor_id > 0;
  require(device->ff ? is_wheel(*device)
                     : is_axis(device->x, opens) && (!device->y || is_axis(*device->y, opens)),
          "an axis is in its ranges");
  require(!device->chai3d || (is_within(device->chai3d->max_stiffness_n_per_m, 1e-300, 1e9) &&
                              is_within(device->chai3d->max_damping_n_s_per_m, 1e-300, 1e4)),
          "limits of CHAI3D are in their ranges");
  const Result<DeviceDescription> again = file::parse_device(device_to_toml(*device), origin);
  require(again && *again == *device, "a written description reads back the same");
  return Outcome::kTaken;
}

const Registered kRegistered({"device", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
