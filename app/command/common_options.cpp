#include "app/command/common_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "app/command/usage.h"
#include "app/file/sidecar.h"
#include "app/file/text.h"
#include "app/runtime/spinning_clock.h"
#include "core/scene_keys.h"
#include "core/stabiliser/stabiliser.h"
#include "core/units.h"
#include "core/usage_error.h"

namespace hapticwall::command {
namespace {

Failure check_duration(const std::string& text) {
  const NumberKey<Scene>& key = scene_number_keys().front();
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  if (code == std::errc{} && rest == end && key.range.contains(value)) return {};
  return usage_error(fmt::format("--duration {}: it takes seconds, more than {} and at most {}",
                                 file::in_quotes(text), number_text(key.range.minimum),
                                 number_text(key.range.maximum)));
}

}  // namespace

Failure check_algorithm_name(std::string_view option, const std::string& name) {
  if (find_algorithm(name)) return {};
  std::vector<std::string_view> names;
  for (const AlgorithmDescription& algorithm : algorithms()) names.push_back(algorithm.name);
  return usage_error(fmt::format("{} {}: no algorithm is called so{}; known: {}", option,
                                 file::in_quotes(name), file::suggestion(name, names),
                                 file::joined(names)));
}

void add_scene_options(CLI::App& app, SceneOptions& options) {
  app.add_option("--set", options.settings,
                 "A key of the scene, e.g. hand.mass_kg=0.3 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_simulator_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--device", options.device, "Only the simulator, sim")->type_name("NAME");
}

void add_device_options(CLI::App& app, SceneOptions& options) {
  app.add_option("--device", options.device,
                 "sim, the simulator; ie2000, a device on the bus; ie2000:PATH, that one, or as a "
                 "device file describes it")
      ->type_name("NAME");
  app.add_flag("--allow-no-realtime", options.allow_no_realtime,
               "Drive a device without real-time priority too: its force may come late");
  add_spin_option(app, options.spin_us);
}

void add_spin_option(CLI::App& app, double& spin_us) {
  app.add_option("--spin", spin_us,
                 "Microseconds before every tick that the loop waits awake: it wakes up sooner and "
                 "takes processor time (default: 0; at most 90 % of a period)")
      ->type_name("US")
      ->check(is_number());
}

Result<double> spin_seconds(double spin_us) {
  const double spin_s = spin_us / kMicrosecondsPerSecond;
  if (spin_s >= 0.0 && spin_s <= runtime::kMostSpinS) return spin_s;
  return usage_error(fmt::format("--spin {:g}: it takes 0 to {:g} us", spin_us,
                                 runtime::kMostSpinS * kMicrosecondsPerSecond));
}

void add_algorithm_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--algorithm", options.algorithm, "Stabilising algorithm, instead of the scene's")
      ->type_name("NAME");
}

void add_headless_options(CLI::App& app, SceneOptions& options) {
  app.add_option("SCENE", options.scene, "Scene file, or the name of a built-in scene")
      ->type_name("")
      ->required();
  app.add_option("--duration", options.duration, "Seconds, instead of the scene's")->type_name("S");
}

void add_output_options(CLI::App& app, OutputOptions& options) {
  app.add_option("--json", options.json, "Write the summary as JSON; - is standard output")
      ->type_name("FILE");
  app.add_option("--expect", options.expectations,
                 "Exit status 1 where it does not hold of the summary, e.g. verdict=settled or "
                 "'tail_peak_to_peak_m<1e-4' (repeatable)")
      ->type_name("EXPR")
      ->allow_extra_args(false);
  app.add_option("--seed", options.seed,
                 "Accepted for scripts; nothing of the present model is random")
      ->type_name("N")
      ->check(is_whole_number());
  app.add_flag("--quiet", options.quiet, "No summary and no progress, errors only");
}

void add_algorithms_option(CLI::App& app, std::vector<std::string>& names) {
  app.add_option("--algorithms,--algorithm", names, "Only these, separated by commas")
      ->type_name("A,B,...")
      ->delimiter(',')
      ->allow_extra_args(false);
}

Result<std::vector<std::size_t>> chosen_algorithms(const std::vector<std::string>& names) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; names.empty() && i < algorithms().size(); ++i) indices.push_back(i);
  for (const std::string& name : names) {
    if (Failure failed = check_algorithm_name("--algorithms", name)) return *failed;
    indices.push_back(*find_algorithm(name));
  }
  return indices;
}

Result<file::LoadedScene> load(const SceneOptions& options) {
  std::vector<std::string> overrides = options.settings;
  if (!options.algorithm.empty()) {
    if (Failure failed = check_algorithm_name("--algorithm", options.algorithm)) return *failed;
    overrides.push_back(fmt::format("algorithm.name=\"{}\"", options.algorithm));
  }
  if (!options.duration.empty()) {
    if (Failure failed = check_duration(options.duration)) return *failed;
    overrides.push_back("duration_s=" + options.duration);
  }
  Result<file::LoadedScene> loaded = file::load_scene(options.scene, overrides);
  if (loaded || options.duration.empty()) return loaded;
  // As it was given.
  const std::string set = "--set duration_s=" + file::shown(options.duration);
  Error error = loaded.error();
  if (error.message.starts_with(set)) {
    error.message.replace(0, set.size(), "--duration " + file::shown(options.duration));
  }
  return error;
}

Failure check_unchanging(const std::string& command, const SceneOptions& options,
                         const file::LoadedScene& loaded) {
  if (loaded.changes.empty()) return {};
  return usage_error(
      fmt::format("{}: a recording in which parameters changed; 'run' repeats it, '{}' takes a "
                  "scene that stays as it is",
                  file::shown(options.scene), command));
}

Result<file::LoadedScene> load_headless(const SceneOptions& options) {
  Result<file::LoadedScene> loaded = load(options);
  if (loaded && loaded->scene.hand && loaded->scene.hand->follows_mouse) {
    return usage_error(
        fmt::format("{}: hand.path: the hand follows the mouse, which only the window "
                    "has; --set 'hand.path=[[0, 0.03], [1, 0.06]]' gives it a path",
                    file::shown(options.scene)));
  }
  return loaded;
}

Failure check_outputs(const OutputOptions& options, std::initializer_list<std::string> read) {
  if (options.csv == kStandardOutput) return usage_error("--csv -: it takes the name of a file");
  if (options.plot == kStandardOutput) return usage_error("--plot -: it takes the name of a file");
  std::vector<std::pair<std::string_view, std::string>> files{
      {"--csv", options.csv}, {"--json", options.json}, {"--plot", options.plot}};
  if (!options.csv.empty())
    files.emplace_back("the sidecar of --csv", file::sidecar_path_of(options.csv));
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [option, path] = files[i];
    for (const std::string& original : read) {
      std::error_code ignored;
      if (path.empty() || !std::filesystem::equivalent(path, original, ignored)) continue;
      return usage_error(
          fmt::format("{}, {}, is what is read and would be gone; choose another name", option,
                      file::in_quotes(path)));
    }
    for (std::size_t j = i + 1; j < files.size(); ++j) {
      if (path.empty() || path != files[j].second) continue;
      return usage_error(fmt::format("{} and {} are the same file, {}", option, files[j].first,
                                     file::in_quotes(path)));
    }
  }
  return {};
}

}  // namespace hapticwall::command
