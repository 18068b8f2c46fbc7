// hapticwall devices: what is connected and usable, and why not where it is not.
#include <memory>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_list.h"
#include "app/command/output_file.h"
#include "app/command/terminal.h"

namespace hapticwall::command {
namespace {

int list_devices(const std::string& json) {
  OutputFile file;
  if (const Failure failed = file.open(json)) return report(*failed);
  const auto port = device::hid::open_system_port();
  if (!port) return report(port.error());
  const Result<DeviceList> list = look_at_devices(**port);
  if (!list) return report(list.error());
  if (const Failure failed = file.write_whole(device_list_json(*list))) return report(*failed);
  const bool json_to_stdout = json == kStandardOutput;
  const Failure failed =
      write_output(json_to_stdout ? device_list_json(*list) : device_list_text(*list));
  return failed ? report(*failed) : 0;
}

}  // namespace

Command add_devices(CLI::App& program) {
  const auto json = std::make_shared<std::string>();
  CLI::App* app = program.add_subcommand(
      "devices", "List what is connected, whether it can be used, and why not");
  app->add_option("--json", *json, "Write the list as JSON; - is standard output")
      ->type_name("FILE");
  return {app, [json] { return list_devices(*json); }};
}

}  // namespace hapticwall::command
