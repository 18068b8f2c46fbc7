// hapticwall scenes: the built-in ones, a line each.
#include <fmt/format.h>

#include <algorithm>

#include "app/command/commands.h"
#include "app/command/terminal.h"
#include "app/file/scene_file.h"

namespace hapticwall::command {
namespace {

int list_scenes() {
  std::size_t width = 0;
  for (const file::BuiltinScene& scene : file::builtin_scenes()) {
    width = std::max(width, scene.name.size());
  }
  std::string text;
  for (const file::BuiltinScene& scene : file::builtin_scenes()) {
    text += fmt::format("{:<{}}  {}\n", scene.name, width, scene.description);
  }
  const Failure failed = write_output(text);
  return failed ? report(*failed) : 0;
}

}  // namespace

Command add_scenes(CLI::App& program) {
  CLI::App* app = program.add_subcommand("scenes", "List the built-in scenes");
  return {app, list_scenes};
}

}  // namespace hapticwall::command
