// hapticwall [SCENE]: the window.
#include "app/ui/window.h"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/replay_window.h"
#include "app/command/terminal.h"
#include "app/command/usage.h"
#include "app/file/text.h"
#include "app/file/user_folders.h"
#include "app/ui/recent_files.h"
#include "app/ui/scale_range.h"

namespace hapticwall::command {
namespace {

// Every session of the window on the device that was chosen.
std::function<Result<std::unique_ptr<runtime::Session>>(const Scene&)> session_starter(
    const DeviceChoice& device, bool allow_no_realtime, double spin_s) {
  if (!device.hardware) return {};
  return [hardware = *device.hardware, allow_no_realtime, spin_s](const Scene& scene) {
    runtime::SessionOptions options;
    options.allow_no_realtime = allow_no_realtime;
    options.spin_s = spin_s;
    return runtime::Session::start_on(make_device(hardware, scene), scene, options);
  };
}

constexpr float kFullScalePercent = 100.0F;
constexpr const char* kSimulator = "sim";

// Of the window alone.
struct LookOptions {
  double scale = 0.0;  // 0: not given
};

// The scene is a file that the user may want to open again.
std::string opened_file(const std::string& scene) {
  std::error_code error;
  return std::filesystem::is_regular_file(scene, error) ? scene : std::string();
}

std::optional<float> forced_scale(const LookOptions& look) {
  return look.scale > 0.0 ? std::optional(static_cast<float>(look.scale)) : std::nullopt;
}

// A recording in the place of a scene: nothing of it can be chosen.
int open_recording(const SceneOptions& options, const LookOptions& look) {
  if (!options.algorithm.empty() || !options.settings.empty() || options.device != kSimulator) {
    return report({ErrorKind::kUsage,
                   fmt::format("{}: a recording is shown as it is; `hapticwall replay` re-runs its "
                               "hand with --algorithm and --set",
                               file::shown(options.scene))});
  }
  ReplayWindow window;
  window.scale = forced_scale(look);
  return run_replay_window(options.scene, std::move(window));
}

int open_window(const SceneOptions& options, const LookOptions& look) {
  if (ui::is_recording(options.scene)) return open_recording(options, look);
  const Result<DeviceChoice> device = parse_device_choice(options.device);
  if (!device) return report(device.error());
  const Result<double> spin_s = spin_seconds(options.spin_us);
  if (!spin_s) return report(spin_s.error());
  Result<file::LoadedScene> loaded = load(options);
  if (!loaded) return report(loaded.error());
  ui::WindowOptions window;
  window.scene = loaded->scene;
  window.start_on_device = session_starter(*device, options.allow_no_realtime, *spin_s);
  window.spin_s = *spin_s;
  window.settings_path = file::settings_path(file::process_environment);
  window.opened_file = opened_file(options.scene);
  window.forced_scale = forced_scale(look);
  const Failure failed = ui::run_window(window);
  return failed ? report(*failed) : 0;
}

}  // namespace

Action add_window(CLI::App& program) {
  const auto options = std::make_shared<SceneOptions>();
  const auto look = std::make_shared<LookOptions>();
  program
      .add_option("SCENE", options->scene,
                  "Scene file, name of a built-in scene (default: press), or a recording")
      ->type_name("");
  add_algorithm_option(program, *options);
  add_scene_options(program, *options);
  add_device_options(program, *options);
  constexpr float kSmallest = ui::kSmallestScalePercent / kFullScalePercent;
  constexpr float kLargest = ui::kLargestScalePercent / kFullScalePercent;
  program
      .add_option("--scale", look->scale,
                  "How large the window's content is drawn: 1 as designed, 0.5 to 3")
      ->check(is_number_within(kSmallest, kLargest))
      ->type_name("FACTOR");
  return [options, look] {
    if (options->scene.empty()) options->scene = kDefaultScene;
    return open_window(*options, *look);
  };
}

}  // namespace hapticwall::command
