// hapticwall scenes: lists the built-in scenes.
#include <fmt/format.h>

#include <algorithm>

#include "app/command/commands.h"
#include "app/command/report/terminal.h"
#include "app/file/scene/scene_file.h"

namespace hapticwall::command {
namespace {

Result<int> list_scenes() {
  std::size_t width = 0;
  for (const file::BuiltinScene& scene : file::builtin_scenes()) {
    width = std::max(width, scene.name.size());
  }
  std::string text;
  for (const file::BuiltinScene& scene : file::builtin_scenes()) {
    text += fmt::format("{:<{}}  {}\n", scene.name, width, scene.description);
  }
  return status_of(write_output(text));
}

}  // namespace

Command add_scenes(CLI::App& program) {
  CLI::App* app = program.add_subcommand("scenes", "List the built-in scenes");
  return {app, list_scenes};
}

}  // namespace hapticwall::command
