#include "app/command/replay_window.h"

#include <utility>

#include "app/command/common_options.h"
#include "app/file/disk/user_folders.h"
#include "app/file/scene/scene_file.h"
#include "app/session/loop/realtime_setup.h"

namespace hapticwall::command {
namespace {

Result<Scene> scene_to_go_back_to(const file::RecordingInfo& recording) {
  if (recording.has_sidecar) return recording.loaded.scene;
  Result<file::LoadedScene> usual = file::load_scene(kDefaultScene);
  if (!usual) return usual.error();
  return std::move(usual->scene);
}

}  // namespace

Failure run_replay_window(std::unique_ptr<file::RecordingReader> recording, ReplayWindow window,
                          const session::OpenWindow& open) {
  const Result<Scene> scene = scene_to_go_back_to(recording->info());
  if (!scene) return scene.error();
  session::WindowOptions options;
  options.scene = *scene;
  options.settings_path = file::settings_path(file::process_environment);
  options.opened_file = recording->info().csv_path;
  options.forced_scale = window.scale;
  // Called once the window is open: the recording starts to play then.
  options.replay = [&] {
    session::ReplayOptions replay;
    replay.speed = window.speed;
    auto session = std::make_unique<session::ReplaySession>(
        std::move(recording), std::make_unique<session::MonotonicClock>(), replay);
    session->lay_over(std::exchange(window.overlay, std::nullopt));
    return session;
  };
  return open(options);
}

}  // namespace hapticwall::command
