// A scene's device from a device file: `device = "NAME"`, or [device] with file = "NAME".
#include <filesystem>

#include "app/file/scene/device_file.h"
#include "app/file/scene/scene_reader.h"
#include "app/file/scene/table_reader.h"
#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr std::string_view kDeviceFileEnding = ".toml";

// A built-in name, or a file: of the scene beside it, and of --set in the current folder.
std::string file_of(const toml::node& node, std::string name, const std::string& origin) {
  for (const BuiltinDevice& device : builtin_devices()) {
    if (device.name == name) return name;
  }
  if (!name.ends_with(kDeviceFileEnding)) name += kDeviceFileEnding;
  const auto& source = node.source().path;
  const bool of_scene = source && *source == origin;
  return (std::filesystem::path(of_scene ? origin : "").parent_path() / name).string();
}

DeviceDescription read_file(const std::string& file, const toml::node& node,
                            const std::string& origin) {
  const Result<DeviceDescription> device = load_device(file);
  if (device) return *device;
  throw ReadFailure(place_of(node, origin) + ": device: " + device.error().message);
}

// Adds the numbers of the device file. A number that `table` already has is kept where it `wins`.
void add_numbers(const DeviceDescription& device, bool wins, toml::table& table) {
  const auto add = [&](std::string_view key, std::optional<double> value) {
    if (!value || (wins && table.contains(key))) return;
    table.insert_or_assign(key, *value);
  };
  add("mass_kg", device.x.mass_kg);
  add("damping_n_s_per_m", device.x.damping_n_s_per_m);
  add("friction_n", device.x.friction_n);
  if (device.x.encoder_m > 0.0) add("encoder_m", device.x.encoder_m);
  add("force_limit_n", device.x.force_limit_n);
  if (!wins) table.erase("chai3d_stiffness_n_per_m");
  if (!wins) table.erase("chai3d_damping_n_s_per_m");
  if (!device.chai3d) return;
  add("chai3d_stiffness_n_per_m", device.chai3d->max_stiffness_n_per_m);
  add("chai3d_damping_n_s_per_m", device.chai3d->max_damping_n_s_per_m);
}

}  // namespace

std::string resolve_device(toml::table& root, const toml::table& before,
                           const std::string& origin) {
  const toml::node* node = root.get("device");
  if (node == nullptr) return "";
  const bool whole = node->is_string();
  if (!whole) {
    if (!node->is_table() || !node->as_table()->contains("file")) return "";
    node = node->as_table()->get("file");
    if (!node->is_string()) {
      throw ReadFailure(place_of(*node, origin) + ": device.file: not the name of a device file");
    }
  }
  const std::string file = file_of(*node, node->value_or(std::string()), origin);
  const DeviceDescription device = read_file(file, *node, origin);
  toml::table table = whole ? before : *root.get("device")->as_table();
  table.erase("file");
  add_numbers(device, !whole, table);
  root.insert_or_assign("device", std::move(table));
  const std::string own = root["description"].value_or(std::string());
  const std::string& origin_of_numbers =
      device.identified.empty() ? device.source : device.identified;
  root.insert_or_assign("description", own + (own.empty() ? "" : "; ") + "device " + device.name +
                                           ": " + origin_of_numbers);
  return file;
}

}  // namespace hapticwall::file
