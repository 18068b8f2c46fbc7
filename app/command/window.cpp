// hapticwall [SCENE]: the window.
#include "app/ui/window.h"

#include <functional>
#include <memory>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/terminal.h"

namespace hapticwall::command {
namespace {

constexpr const char* kDefaultScene = "press";

// Every session of the window on the device that was chosen.
std::function<Result<std::unique_ptr<runtime::Session>>(const Scene&)> session_starter(
    const DeviceChoice& device, bool allow_no_realtime) {
  if (!device.hardware) return {};
  return [hardware = *device.hardware, allow_no_realtime](const Scene& scene) {
    runtime::SessionOptions options;
    options.allow_no_realtime = allow_no_realtime;
    return runtime::Session::start_on(make_device(hardware, scene), scene, options);
  };
}

int open_window(const SceneOptions& options) {
  const Result<DeviceChoice> device = parse_device_choice(options.device);
  if (!device) return report(device.error());
  Result<file::LoadedScene> loaded = load(options);
  if (!loaded) return report(loaded.error());
  ui::WindowOptions window;
  window.scene = loaded->scene;
  window.start_on_device = session_starter(*device, options.allow_no_realtime);
  const Failure failed = ui::run_window(window);
  return failed ? report(*failed) : 0;
}

}  // namespace

Action add_window(CLI::App& program) {
  const auto options = std::make_shared<SceneOptions>();
  program
      .add_option("SCENE", options->scene,
                  "Scene file, or the name of a built-in scene (default: press)")
      ->type_name("");
  add_algorithm_option(program, *options);
  add_scene_options(program, *options);
  add_device_options(program, *options);
  return [options] {
    if (options->scene.empty()) options->scene = kDefaultScene;
    return open_window(*options);
  };
}

}  // namespace hapticwall::command
