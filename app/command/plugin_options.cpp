// The options that take an algorithm or an environment, by its name or from a plug-in.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/file/plugin/plugin_file.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "core/environment/environment.h"

namespace hapticwall::command {
namespace {

// Replaces a plug-in's path by the name of what it brings. `load` gives the name.
template <class Load>
CLI::Validator loads(const Load& load) {
  return CLI::Validator(
      [load](std::string& text) -> std::string {
        if (!file::names_plugin(text)) return "";
        const Result<std::string> name = load(text);
        if (!name) return name.error().message;
        text = *name;
        return "";
      },
      "");
}

CLI::Validator loads_environment() {
  return loads([](const std::string& path) -> Result<std::string> {
    const Result<std::size_t> index = file::load_environment(path);
    if (!index) return index.error();
    return std::string(environments()[*index].description.name);
  });
}

CLI::Validator names_environment() {
  return CLI::Validator(
      [](const std::string& name) -> std::string {
        if (find_environment(name)) return "";
        const auto names = file::names_of(environments());
        return fmt::format("unknown environment{}; known: {}", file::suggestion(name, names),
                           file::joined(names));
      },
      "");
}

// True if a plug-in brought an environment.
bool has_environment_plugin() {
  return std::ranges::any_of(
      environments(), [](const Environment& environment) { return environment.plugin != nullptr; });
}

}  // namespace

void add_environment_option(CLI::App& app, SceneOptions& options) {
  const auto choose = [&options](const std::string& name) {
    options.settings.insert(options.settings.begin(), fmt::format("environment.name=\"{}\"", name));
  };
  app.add_option_function<std::string>(
         "--environment", choose,
         "What the handle touches, instead of the scene's walls; or a plug-in, ./MINE.so")
      ->type_name("NAME")
      ->transform(loads_environment())
      ->check(names_environment());
}

CLI::Validator loads_plugin() {
  return loads([](const std::string& path) -> Result<std::string> {
    const Result<std::size_t> index = file::load_plugin(path);
    if (!index) return index.error();
    return std::string(algorithms()[*index].name);
  });
}

void add_algorithm_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--algorithm", options.algorithm,
                 "Stabilising algorithm, instead of the scene's; or a plug-in, ./MINE.so")
      ->type_name("NAME")
      ->transform(loads_plugin());
}

Failure check_plugin(const SceneOptions& options) {
  const bool any = algorithms().size() != first_plugin() || has_environment_plugin() ||
                   names_device_plugin(options.device);
  if (options.allow_plugin || options.device == kSimulator || !any) return {};
  return usage_error(
      fmt::format("--device {}: a plug-in drives a device only with --allow-plugin; try it on the "
                  "simulator first",
                  file::in_quotes(options.device)));
}

}  // namespace hapticwall::command
