#include "app/command/replay_window.h"

#include <functional>
#include <utility>

#include "app/command/common_options.h"
#include "app/command/terminal.h"
#include "app/file/scene_file.h"
#include "app/file/user_folders.h"
#include "app/runtime/realtime_setup.h"
#include "app/ui/window.h"

namespace hapticwall::command {
namespace {

Result<Scene> scene_to_go_back_to(const file::RecordingInfo& recording) {
  if (recording.has_sidecar) return recording.loaded.scene;
  Result<file::LoadedScene> usual = file::load_scene(kDefaultScene);
  if (!usual) return usual.error();
  return std::move(usual->scene);
}

}  // namespace

int run_replay_window(std::unique_ptr<file::RecordingReader> recording, ReplayWindow window) {
  const Result<Scene> scene = scene_to_go_back_to(recording->info());
  if (!scene) return report(scene.error());
  ui::WindowOptions options;
  options.scene = *scene;
  options.settings_path = file::settings_path(file::process_environment);
  options.opened_file = recording->info().csv_path;
  options.forced_scale = window.scale;
  // Called once, when the window is there: only then the recording begins to play.
  options.first = [&]() -> Result<std::unique_ptr<runtime::Session>> {
    runtime::ReplayOptions replay;
    replay.speed = window.speed;
    auto session = std::make_unique<runtime::ReplaySession>(
        std::move(recording), std::make_unique<runtime::MonotonicClock>(), replay);
    session->lay_over(std::exchange(window.overlay, std::nullopt));
    return std::unique_ptr<runtime::Session>(std::move(session));
  };
  const Failure failed = ui::run_window(options);
  return failed ? report(*failed) : 0;
}

int run_replay_window(const std::string& csv_path, ReplayWindow window) {
  auto recording = file::RecordingReader::open(csv_path);
  if (!recording) return report(recording.error());
  return run_replay_window(std::move(*recording), std::move(window));
}

}  // namespace hapticwall::command
