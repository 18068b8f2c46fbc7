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

bool is_axis(const AxisDescription& axis) {
  return is_within(axis.encoder_m, 1e-9, 0.01) && axis.force_limit_n > 0.0 &&
         axis.force_limit_n <= 32.767 && is_within(axis.min_m, -10.0, 0.0) &&
         is_within(axis.max_m, 0.0, 10.0) && is_within(axis.max_force_rate_n_per_s, 0.0, 1e6) &&
         axis.max_speed_m_per_s > 0.0 && axis.max_speed_m_per_s <= 100.0;
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
  require(device->vendor_id > 0 && device->product_id > 0, "a device has numbers on the bus");
  require(is_axis(device->x) && (!device->y || is_axis(*device->y)), "an axis is in its ranges");
  return Outcome::kTaken;
}

const Registered kRegistered({"device", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
