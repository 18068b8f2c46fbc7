#include "app/command/common_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/command/device_choice.h"
#include "app/command/recorded_hand.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/command/usage.h"
#include "app/file/plugin/plugin_file.h"
#include "app/file/recording/recording_reader.h"
#include "app/file/recording/sidecar.h"
#include "app/file/text/text.h"
#include "app/session/hand_rerun.h"
#include "app/session/loop/spinning_clock.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "core/environment/environment.h"
#include "core/scene_keys.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

// Refuses the same values as --set duration_s, but names the option that the user gave.
Failure set_duration(const std::string& text, Scene& scene) {
  const NumberKey<Scene>& key = number_keys<Scene>().front();
  const std::optional<double> value = file::parsed<double>(text);
  if (!value || !key.range.contains(*value)) {
    return usage_error(fmt::format("--duration {}: it takes seconds, more than {} and at most {}",
                                   file::in_quotes(text), number_text(key.range.minimum),
                                   number_text(key.range.maximum)));
  }
  scene.duration_s = *value;
  const std::optional<SceneProblem> problem = validate(scene);
  if (!problem) return {};
  return usage_error(fmt::format("--duration {}: {}", file::shown(text), problem->message));
}

// Another ending promises a format that is not written.
Failure check_ending(std::string_view option, const std::string& path,
                     std::initializer_list<std::string_view> written) {
  const std::string ending = std::filesystem::path(path).extension();
  if (ending.empty() || std::ranges::count(written, CLI::detail::to_lower(ending)) > 0) return {};
  return usage_error(fmt::format("{} {}: {} is not written; end the name in {}", option,
                                 file::in_quotes(path), file::in_quotes(ending),
                                 fmt::join(written, " or ")));
}

Failure check_endings(const OutputOptions& options) {
  if (Failure failed = check_ending("--csv", options.csv, {".csv"})) return failed;
  if (Failure failed = check_ending("--plot", options.plot, {".png", ".svg", ".pdf"}))
    return failed;
  if (!options.device_file.empty() && !options.device_file.ends_with(".toml")) {
    return usage_error(fmt::format("--device-file {}: end the name in .toml: a scene names it so",
                                   file::in_quotes(options.device_file)));
  }
  if (Failure failed = check_ending("--scene-file", options.scene_file, {".toml"})) return failed;
  return check_ending("--wav", options.wav, {".wav"});
}

Failure check_changes(const std::string& command, const SceneOptions& options,
                      const file::LoadedScene& loaded) {
  if (loaded.changes.empty()) return {};
  return usage_error(
      fmt::format("{}: a recording in which parameters changed; 'run' repeats it, '{}' takes a "
                  "scene without changes",
                  file::shown(options.scene), command));
}

Result<file::LoadedScene> load_recorded(const std::string& command, const SceneOptions& options,
                                        bool quiet) {
  Result<OpenedRecording> opened = open_for_rerun(options, !quiet);
  if (!opened) return opened.error();
  if (Failure failed = check_changes(command, options, opened->loaded)) return *failed;
  Result<Scene> scene = session::recorded_scene(*opened->reader, opened->loaded);
  if (!scene) return scene.error();
  file::LoadedScene loaded;
  loaded.scene = std::move(*scene);
  return loaded;
}

}  // namespace

Failure check_algorithm_name(std::string_view option, const std::string& name) {
  if (find_algorithm(name)) return {};
  const auto names = file::names_of(algorithms(), &AlgorithmDescription::name);
  return usage_error(fmt::format("{} {}: unknown algorithm{}; known: {}", option,
                                 file::in_quotes(name), file::suggestion(name, names),
                                 file::joined(names)));
}

void add_scene_options(CLI::App& app, SceneOptions& options) {
  app.add_option("--set", options.settings,
                 "A key of the scene, e.g. hand.mass_kg=0.3 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  // After --set, whose parsing replaces all settings.
  add_environment_option(app, options);
}

void add_simulator_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--device", options.device, "sim: this command runs on the simulator only")
      ->type_name("NAME");
}

void add_device_options(CLI::App& app, SceneOptions& options) {
  app.add_option(
         "--device", options.device,
         "sim: the simulator; ie2000: a connected device; ff: a force-feedback wheel; with "
         ":PATH the one at this path, or of this device file; plugin:FILE.so: the device of "
         "this library")
      ->type_name("NAME");
  app.add_flag("--allow-no-realtime", options.allow_no_realtime,
               "Drive a device also without real-time priority; its force may be late");
  app.add_flag("--allow-plugin", options.allow_plugin,
               "Let a plug-in drive a device: a crash of its code ends the program");
  app.add_flag("--allow-slow-device", options.allow_slow_device,
               "Arm a device also if its force acts more than 5 ticks late");
  add_spin_option(app, options.spin_us);
}

void add_spin_option(CLI::App& app, double& spin_us) {
  app.add_option("--spin", spin_us,
                 "Microseconds of busy waiting before every tick: wakes up sooner, takes processor "
                 "time (default: 0; at most 90 % of a period)")
      ->type_name("US")
      ->check(is_number());
}

Result<double> spin_seconds(double spin_us) {
  const double spin_s = spin_us / kMicrosecondsPerSecond;
  if (spin_s >= 0.0 && spin_s <= session::kMaxSpinS) return spin_s;
  return usage_error(fmt::format("--spin {:g}: it takes 0 to {:g} us", spin_us,
                                 session::kMaxSpinS * kMicrosecondsPerSecond));
}

void add_headless_options(CLI::App& app, SceneOptions& options) {
  app.add_option("SCENE", options.scene, "Scene file, or the name of a built-in scene")
      ->type_name("")
      ->required();
  app.add_option("--duration", options.duration, "Seconds, instead of the scene's")->type_name("S");
}

void add_csv_option(CLI::App& app, OutputOptions& options, const std::string& description) {
  app.add_option("--csv", options.csv, description)->type_name("FILE");
}

void add_plot_option(CLI::App& app, OutputOptions& options, const std::string& description) {
  app.add_option("--plot", options.plot, description + "; .png, .svg or .pdf; needs no display")
      ->type_name("FILE");
  app.add_option("--width", options.width,
                 fmt::format("Printed width of --plot: single ({:g} mm), double ({:g} mm, the "
                             "default) or millimetres, {:g} to {:g}",
                             draw::kSingleWidthMm, draw::kDoubleWidthMm, draw::kMinWidthMm,
                             draw::kMaxWidthMm))
      ->type_name("MM");
}

void add_signals_option(CLI::App& app, bool& signals, const std::string& outputs) {
  app.add_flag("--signals", signals,
               "The algorithm's own signals in " + outputs + ", such as its energy or its bound");
}

void add_stream_options(CLI::App& app, StreamChoice& choice) {
  app.add_option(
         "--stream", choice.path,
         "Write every tick as a line of JSON to a pipe, a FIFO or a new file while it runs; "
         "- is standard output")
      ->type_name("FILE");
  app.add_option("--stream-every", choice.every, "Stream every N-th tick only (default: 1)")
      ->type_name("N");
}

Result<std::shared_ptr<file::SampleStream>> open_stream(const StreamChoice& choice,
                                                        file::StreamOptions options) {
  constexpr std::uint64_t kMaxEvery = 1'000'000;
  const std::string every = choice.every.empty() ? "1" : choice.every;
  const std::uint64_t ticks = file::parsed<std::uint64_t>(every).value_or(0);
  if (ticks < 1 || ticks > kMaxEvery) {
    return usage_error(fmt::format("--stream-every {}: it takes a whole number, 1 to {}",
                                   file::in_quotes(every), kMaxEvery));
  }
  options.every = ticks;
  options.tell = tell;
  options.stopped = [] { return stop_signal() != 0; };
  if (!choice.path.empty()) return file::SampleStream::open(choice.path, std::move(options));
  if (choice.every.empty()) return std::shared_ptr<file::SampleStream>();
  return usage_error("--stream-every: it needs --stream FILE");
}

void add_output_options(CLI::App& app, OutputOptions& options) {
  app.add_option("--json", options.json, "Write the summary as JSON; - is standard output")
      ->type_name("FILE");
  app.add_option("--expect", options.expectations,
                 "Exit with status 1 unless the summary fulfils it, e.g. verdict=settled or "
                 "'tail_peak_to_peak_m<1e-4' (repeatable)")
      ->type_name("EXPR")
      ->allow_extra_args(false);
  app.add_flag("--quiet", options.quiet, "Print errors only");
}

void add_algorithms_option(CLI::App& app, std::vector<std::string>& names) {
  app.add_option("--algorithms,--algorithm", names,
                 "These algorithms only, separated by commas; or plug-ins, ./MINE.so")
      ->type_name("A,B,...")
      ->delimiter(',')
      ->transform(loads_plugin())
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
  Result<file::LoadedScene> loaded = file::load_scene(options.scene, overrides);
  if (!loaded || options.duration.empty()) return loaded;
  if (Failure failed = set_duration(options.duration, loaded->scene)) return *failed;
  return loaded;
}

Result<file::LoadedScene> load_headless(const SceneOptions& options) {
  Result<file::LoadedScene> loaded = load(options);
  if (loaded && loaded->scene.x().hand && loaded->scene.x().hand->follows_mouse) {
    return usage_error(
        fmt::format("{}: hand.path: the hand follows the mouse, which only the window "
                    "has; --set 'hand.path=[[0, 0.03], [1, 0.06]]' gives it a path",
                    file::shown(options.scene)));
  }
  return loaded;
}

Result<file::LoadedScene> load_for_study(const std::string& command, const SceneOptions& options,
                                         bool quiet) {
  if (Failure failed = check_simulator(command, options.device)) return *failed;
  Result<file::LoadedScene> loaded = file::is_recording(options.scene)
                                         ? load_recorded(command, options, quiet)
                                         : load_headless(options);
  if (!loaded) return loaded;
  // A study would describe the hand's script, not the recorded hand.
  if (!loaded->not_repeatable_because.empty()) {
    return usage_error(fmt::format(
        "{}: its session cannot be repeated: {}; '{} NAME.csv' re-runs the recorded hand",
        file::shown(options.scene), file::shown(loaded->not_repeatable_because), command));
  }
  if (Failure failed = check_changes(command, options, *loaded)) return *failed;
  return loaded;
}

std::string sidecar_read_with(const std::string& scene) {
  return file::is_recording(scene) ? file::find_sidecar(scene) : std::string();
}

Failure check_scene_files(const OutputOptions& options, const file::LoadedScene& loaded) {
  std::vector<std::string> read = loaded.named_files;
  for (const AxisSettings& axis : loaded.scene.axes) {
    if (axis.hand) read.push_back(axis.hand->path.file);
  }
  return check_outputs(options, std::move(read));
}

void tell_difference(const file::LoadedScene& loaded) {
  if (loaded.not_repeatable_because.empty()) return;
  tell(fmt::format("note: the run will differ from the recorded session: {}",
                   file::shown(loaded.not_repeatable_because)));
}

Failure check_outputs(const OutputOptions& options, std::vector<std::string> read) {
  for (std::size_t i = first_plugin(); i < algorithms().size(); ++i) {
    if (const file::PluginFile* plugin = file::plugin_file(i)) read.push_back(plugin->path);
  }
  if (options.csv == kStandardOutput) return usage_error("--csv -: it takes a file name");
  if (options.plot == kStandardOutput) return usage_error("--plot -: it takes a file name");
  if (options.wav == kStandardOutput) return usage_error("--wav -: it takes a file name");
  if (options.frames == kStandardOutput)
    return usage_error("--frames -: it takes the name of a folder");
  std::vector<std::pair<std::string_view, std::string>> files{
      {"--csv", options.csv},
      {"--json", options.json},
      {"--plot", options.plot},
      {"--wav", options.wav},
      {"--frames", options.frames},
      {"--stream", options.stream.path},
      {"--device-file", options.device_file},
      {"--scene-file", options.scene_file}};
  if (!options.csv.empty())
    files.emplace_back("the sidecar of --csv", file::sidecar_path_of(options.csv));
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [option, path] = files[i];
    for (const std::string& original : read) {
      std::error_code ignored;
      if (path.empty() || !std::filesystem::equivalent(path, original, ignored)) continue;
      return usage_error(fmt::format("{} {}: it would replace an input file; choose another name",
                                     option, file::in_quotes(path)));
    }
    for (std::size_t j = i + 1; j < files.size(); ++j) {
      if (path.empty() || path != files[j].second) continue;
      return usage_error(fmt::format("{} and {}: both name {}; choose two files", option,
                                     files[j].first, file::in_quotes(path)));
    }
  }
  if (!options.width.empty() && options.plot.empty())
    return usage_error("--width: it needs --plot FILE");
  if (const Result<double> width_mm = figure_width_mm(options.width); !width_mm)
    return width_mm.error();
  return check_endings(options);
}

}  // namespace hapticwall::command
