// hapticwall [SCENE]: the window.
#include "app/ui/window.h"

#include <memory>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/terminal.h"

namespace hapticwall::command {
namespace {

constexpr const char* kDefaultScene = "press";

int open_window(const SceneOptions& options) {
  Result<file::LoadedScene> loaded = load(options);
  if (!loaded) return report(loaded.error());
  ui::WindowOptions window;
  window.scene = loaded->scene;
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
  return [options] {
    if (options->scene.empty()) options->scene = kDefaultScene;
    return open_window(*options);
  };
}

}  // namespace hapticwall::command
