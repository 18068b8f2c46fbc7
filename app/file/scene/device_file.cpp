#include "app/file/scene/device_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

#include "app/file/disk/small_file.h"
#include "app/file/scene/dialect_table.h"
#include "app/file/scene/table_reader.h"
#include "app/file/scene/toml_text.h"
#include "app/file/text/text.h"
#include "core/scene_keys.h"
#include "embedded_devices.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 16U;
constexpr std::size_t kMaxNameBytes = 100;
constexpr std::size_t kMaxSourceBytes = 1000;
constexpr std::size_t kMaxSerialBytes = 126;  // limit of a USB string descriptor

constexpr ValueRange kRate{10.0, 10e3};
constexpr std::array<NumberKey<DeviceDescription>, 1> kDeviceKeys{
    NumberKey<DeviceDescription>{"rate_hz", "Hz", kRate, false, &DeviceDescription::rate_hz}};

constexpr ValueRange kEncoder{1e-9, 0.01};
// Upper end: the largest force that a report can carry.
constexpr ValueRange kForceLimit{0.0, 32.767, true};
constexpr ValueRange kWorkspaceBegin{-10.0, 0.0};
constexpr ValueRange kWorkspaceEnd{0.0, 10.0};
constexpr ValueRange kForceRate{0.0, 1e6, true};
constexpr ValueRange kSpeedLimit{0.0, 100.0, true};
constexpr ValueRange kMass{1e-6, 1e3};
constexpr ValueRange kDamping{0.0, 1e6};
constexpr ValueRange kFriction{0.0, 1e6};
constexpr std::array<NumberKey<AxisDescription>, 9> kAxisKeys{
    NumberKey<AxisDescription>{"encoder_m", "m", kEncoder, false, &AxisDescription::encoder_m},
    NumberKey<AxisDescription>{"force_limit_n", "N", kForceLimit, true,
                               &AxisDescription::force_limit_n},
    NumberKey<AxisDescription>{"min_m", "m", kWorkspaceBegin, false, &AxisDescription::min_m},
    NumberKey<AxisDescription>{"max_m", "m", kWorkspaceEnd, false, &AxisDescription::max_m},
    NumberKey<AxisDescription>{"max_force_rate_n_per_s", "N/s", kForceRate, false,
                               &AxisDescription::max_force_rate_n_per_s},
    NumberKey<AxisDescription>{"max_speed_m_per_s", "m/s", kSpeedLimit, false,
                               &AxisDescription::max_speed_m_per_s},
    NumberKey<AxisDescription>{"mass_kg", "kg", kMass, false, &AxisDescription::mass_kg},
    NumberKey<AxisDescription>{"damping_n_s_per_m", "N·s/m", kDamping, false,
                               &AxisDescription::damping_n_s_per_m},
    NumberKey<AxisDescription>{"friction_n", "N", kFriction, false, &AxisDescription::friction_n}};

constexpr std::array<NumberKey<AxisDescription>, 6> kWheelAxisKeys{
    NumberKey<AxisDescription>{"force_limit_n", "N", kForceLimit, false,
                               &AxisDescription::force_limit_n},
    kAxisKeys[4],
    kAxisKeys[5],
    kAxisKeys[6],
    kAxisKeys[7],
    kAxisKeys[8]};

constexpr ValueRange kRadius{0.01, 1.0};
constexpr ValueRange kTravel{1.0, 3600.0};
constexpr ValueRange kTorque{0.01, 100.0};
constexpr ValueRange kSign{-1.0, 1.0};
constexpr ValueRange kUpdateRate{10.0, 1e3};
constexpr ValueRange kDelay{0.0, 1.0};
constexpr std::array<NumberKey<FfDescription>, 6> kFfKeys{
    NumberKey<FfDescription>{"radius_m", "m", kRadius, false, &FfDescription::radius_m},
    NumberKey<FfDescription>{"travel_deg", "degrees", kTravel, false, &FfDescription::travel_deg},
    NumberKey<FfDescription>{"torque_nm", "N m", kTorque, true, &FfDescription::torque_nm},
    NumberKey<FfDescription>{"sign", "", kSign, false, &FfDescription::sign},
    NumberKey<FfDescription>{"rate_hz", "Hz", kUpdateRate, false, &FfDescription::rate_hz},
    NumberKey<FfDescription>{"delay_s", "s", kDelay, false, &FfDescription::delay_s}};

constexpr std::array<NumberKey<ChaiLimits>, 2> kChaiKeys{
    NumberKey<ChaiLimits>{"max_stiffness_n_per_m", "N/m", kChaiStiffness, true,
                          &ChaiLimits::max_stiffness_n_per_m},
    NumberKey<ChaiLimits>{"max_damping_n_s_per_m", "N·s/m", kChaiDamping, true,
                          &ChaiLimits::max_damping_n_s_per_m}};

template <typename Owner>
void read_numbers(TableReader& reader, const toml::table& table,
                  std::span<const NumberKey<Owner>> keys, Owner& owner) {
  reader.numbers(owner, keys);
  for (const NumberKey<Owner>& key : keys) {
    const toml::node* node = table.get(key.key);
    if (node == nullptr || key.range.contains(*key.get(owner))) continue;
    reader.fail(*node, key.key, out_of_range_text(*key.get(owner), key.range, key.unit));
  }
}

AxisDescription read_axis(const toml::table& table, const std::string& name,
                          const std::string& origin, bool needs_encoder,
                          std::span<const NumberKey<AxisDescription>> keys = kAxisKeys) {
  TableReader reader(table, name + ".", origin);
  AxisDescription axis;
  axis.force_limit_n = kWheelLimitN;
  read_numbers<AxisDescription>(reader, table, keys, axis);
  if (needs_encoder && axis.encoder_m == 0.0) reader.fail_missing("encoder_m", number_in("m"));
  reader.finish();
  return axis;
}

ChaiLimits read_chai3d(const toml::table& table, const std::string& origin) {
  TableReader reader(table, "chai3d.", origin);
  ChaiLimits limits;
  read_numbers<ChaiLimits>(reader, table, kChaiKeys, limits);
  reader.finish();
  return limits;
}

FfDescription read_ff(const toml::table& table, const std::string& origin) {
  TableReader reader(table, "ff.", origin);
  FfDescription ff;
  read_numbers<FfDescription>(reader, table, kFfKeys, ff);
  if (std::abs(ff.sign) != 1.0) reader.fail(*table.get("sign"), "sign", "it takes 1 or -1");
  ff.delay_date = reader.line("delay_date", kMaxNameBytes);
  if (ff.delay_s > 0.0 && ff.delay_date.empty()) {
    reader.fail_missing("delay_date",
                        "the day on which delay_s was measured, as in \"2026-01-31\"");
  }
  reader.finish();
  return ff;
}

// Reads a wheel: [ff], and [x] where a limit is not the default.
void read_wheel(const toml::table& ff, TableReader& reader, const std::string& origin,
                DeviceDescription& device) {
  device.ff = read_ff(ff, origin);
  device.x.force_limit_n = kWheelLimitN;
  if (const toml::table* x = reader.table("x")) {
    device.x = read_axis(*x, "x", origin, false, kWheelAxisKeys);
  }
}

std::uint16_t read_id(TableReader& reader, std::string_view key) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint16_t>::max();
  const std::optional<std::uint64_t> id = reader.count(key);
  if (!id) reader.fail_missing(key, "a number from 0x0001 to 0xffff");
  if (*id < 1 || *id > kMax) {
    reader.fail(*reader.node(key), key,
                fmt::format("{} is out of range; it takes 0x0001 to 0xffff", *id));
  }
  return static_cast<std::uint16_t>(*id);
}

void read_usb(const toml::table& table, const std::string& origin, DeviceDescription& device) {
  TableReader reader(table, "usb.", origin);
  device.vendor_id = read_id(reader, "vendor_id");
  device.product_id = read_id(reader, "product_id");
  device.serial = reader.line("serial", kMaxSerialBytes);
  reader.finish();
}

DeviceDescription read_description(const toml::table& root, const std::string& origin) {
  TableReader reader(root, "", origin);
  DeviceDescription device;
  device.name = reader.line("name", kMaxNameBytes);
  if (device.name.empty()) device.name = shown(std::filesystem::path(origin).stem().string());
  device.source = reader.line("source", kMaxSourceBytes);
  if (device.source.empty()) {
    reader.fail_missing("source", "a line that says where the numbers come from");
  }
  device.identified = reader.line("identified", kMaxSourceBytes);
  read_numbers<DeviceDescription>(reader, root, kDeviceKeys, device);
  if (const toml::table* usb = reader.table("usb")) read_usb(*usb, origin, device);
  if (const toml::table* ff = reader.table("ff")) {
    read_wheel(*ff, reader, origin, device);
    reader.finish();
    return device;
  }
  const toml::table* x = reader.table("x");
  if (x == nullptr) reader.fail_missing("x", "a table [x], the first axis");
  const bool opens = device.vendor_id != 0;
  device.x = read_axis(*x, "x", origin, opens);
  if (const toml::table* y = reader.table("y")) device.y = read_axis(*y, "y", origin, opens);
  if (const toml::table* chai3d = reader.table("chai3d")) {
    device.chai3d = read_chai3d(*chai3d, origin);
  }
  device.dialect = read_dialect(reader, origin, device.y.has_value());
  reader.finish();
  return device;
}

template <typename Owner>
void write_numbers(TomlText& out, std::string_view table, const Owner& owner,
                   std::span<const NumberKey<Owner>> keys) {
  out.table(table);
  for (const NumberKey<Owner>& key : keys) {
    if (const std::optional<double> value = key.get(owner); value && key.range.contains(*value)) {
      out.number(key.key, *value);
    }
  }
}

}  // namespace

std::string device_to_toml(const DeviceDescription& device) {
  TomlText out;
  out.string("name", device.name);
  out.string("source", device.source);
  if (!device.identified.empty()) out.string("identified", device.identified);
  out.number("rate_hz", device.rate_hz);
  if (device.vendor_id != 0) {
    out.table("usb");
    out.integer("vendor_id", device.vendor_id);
    out.integer("product_id", device.product_id);
    if (!device.serial.empty()) out.string("serial", device.serial);
  }
  if (device.ff) {
    write_numbers<FfDescription>(out, "ff", *device.ff, kFfKeys);
    if (!device.ff->delay_date.empty()) out.string("delay_date", device.ff->delay_date);
    write_numbers<AxisDescription>(out, "x", device.x, kWheelAxisKeys);
    return out.text();
  }
  write_numbers<AxisDescription>(out, "x", device.x, kAxisKeys);
  if (device.y) write_numbers<AxisDescription>(out, "y", *device.y, kAxisKeys);
  if (device.chai3d) write_numbers<ChaiLimits>(out, "chai3d", *device.chai3d, kChaiKeys);
  if (device.dialect) write_dialect(out, *device.dialect);
  return out.text();
}

Result<DeviceDescription> parse_device(std::string_view toml_text, const std::string& origin) {
  try {
    return read_description(parse_toml(toml_text, origin, "device description"), origin);
  } catch (const ReadFailure& failure) {
    return usage_error(failure.what());
  }
}

Result<DeviceDescription> load_device(const std::string& name_or_path) {
  const std::vector<BuiltinDevice>& builtin = builtin_devices();
  const std::vector<std::string_view> names = names_of(builtin, &BuiltinDevice::name);
  const Result<std::optional<std::size_t>> index = find_builtin(name_or_path, "device", names);
  if (!index) return index.error();
  if (*index) {
    const BuiltinDevice& device = builtin[**index];
    return parse_device(device.toml_text, device.name + " (built in)");
  }
  const Result<std::string> text =
      read_small_file(name_or_path, "device description", kMaxFileBytes, problem_of_named);
  if (!text) return text.error();
  return parse_device(*text, name_or_path);
}

const std::vector<BuiltinDevice>& builtin_devices() {
  static const std::vector<BuiltinDevice> kDevices = [] {
    std::vector<BuiltinDevice> devices;
    for (const EmbeddedFile& file : embedded_devices()) {
      devices.push_back({std::filesystem::path(file.name).stem().string(), file.bytes});
    }
    std::sort(devices.begin(), devices.end(),
              [](const BuiltinDevice& a, const BuiltinDevice& b) { return a.name < b.name; });
    return devices;
  }();
  return kDevices;
}

}  // namespace hapticwall::file
