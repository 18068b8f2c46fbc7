// The options that several commands share, with their checks.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/command/output_file.h"
#include "app/file/recording/sample_stream.h"
#include "app/file/scene/scene_file.h"
#include "core/result.h"

namespace hapticwall::command {

// The window opens with this scene under this algorithm.
inline constexpr const char* kDefaultScene = "press";
inline constexpr const char* kDefaultAlgorithm = "none";

// The scene and its device, also of the window.
struct SceneOptions {
  std::string scene;
  std::string algorithm;
  std::string duration;
  std::vector<std::string> settings;  // the KEY=VALUE texts of --set
  std::string device = "sim";
  bool allow_no_realtime = false;
  bool allow_plugin = false;
  bool allow_slow_device = false;
  double spin_us = 0.0;
};

// --set and --environment.
void add_scene_options(CLI::App& app, SceneOptions& options);
// --device, of commands that run on the simulator only.
void add_simulator_option(CLI::App& app, SceneOptions& options);
// --device, --allow-no-realtime, --allow-plugin, --allow-slow-device and --spin.
void add_device_options(CLI::App& app, SceneOptions& options);
// --spin, and its value in seconds.
void add_spin_option(CLI::App& app, double& spin_us);
[[nodiscard]] Result<double> spin_seconds(double spin_us);
// Validator of an option that takes algorithms: loads a plug-in and replaces its path by its name.
[[nodiscard]] CLI::Validator loads_plugin();
void add_algorithm_option(CLI::App& app, SceneOptions& options);
// --environment, which comes before all settings.
void add_environment_option(CLI::App& app, SceneOptions& options);
// Refuses a plug-in on a device without --allow-plugin.
[[nodiscard]] Failure check_plugin(const SceneOptions& options);
// The required SCENE of a command, and --duration.
void add_headless_options(CLI::App& app, SceneOptions& options);
// --csv; --plot with --width. The description of --csv says what a line is.
void add_csv_option(CLI::App& app, OutputOptions& options, const std::string& description);
void add_plot_option(CLI::App& app, OutputOptions& options, const std::string& description);
// --stream and --stream-every.
void add_stream_options(CLI::App& app, StreamChoice& choice);
// --signals, of the algorithms in `outputs`: "recordings and the stream".
void add_signals_option(CLI::App& app, bool& signals, const std::string& outputs);
// The stream, or null without one. `options` without those of the choice.
[[nodiscard]] Result<std::shared_ptr<file::SampleStream>> open_stream(const StreamChoice& choice,
                                                                      file::StreamOptions options);
// --json, --expect, --quiet.
void add_output_options(CLI::App& app, OutputOptions& options);

// The scene with --set, then --algorithm and --duration, applied.
[[nodiscard]] Result<file::LoadedScene> load(const SceneOptions& options);

// load() for a run without a window: refuses a hand that follows the mouse.
[[nodiscard]] Result<file::LoadedScene> load_headless(const SceneOptions& options);

// load() for a study on the simulator: refuses a device, a scene whose parameters change, and the
// sidecar of a session that cannot be repeated. A recording gives its session::recorded_scene();
// notes say so unless `quiet`.
[[nodiscard]] Result<file::LoadedScene> load_for_study(const std::string& command,
                                                       const SceneOptions& options, bool quiet);

// The sidecar that is read with a recording; "" for a scene.
[[nodiscard]] std::string sidecar_read_with(const std::string& scene);

// Refuses two outputs to one file, an output to a file of `read` or to a plug-in, and --csv, --plot
// or --wav to standard output or to a name with the ending of another format.
[[nodiscard]] Failure check_outputs(const OutputOptions& options, std::vector<std::string> read);

// Refuses an output to a file that the scene names: of its device, or of a hand (`path_file`).
[[nodiscard]] Failure check_scene_files(const OutputOptions& options,
                                        const file::LoadedScene& loaded);

// Prints a note if a session of this scene will differ from the recorded one.
void tell_difference(const file::LoadedScene& loaded);

// --algorithms A,B,...
void add_algorithms_option(CLI::App& app, std::vector<std::string>& names);
// Indices in algorithms(), in the order of the names; all if there are no names.
[[nodiscard]] Result<std::vector<std::size_t>> chosen_algorithms(
    const std::vector<std::string>& names);

[[nodiscard]] Failure check_algorithm_name(std::string_view option, const std::string& name);

}  // namespace hapticwall::command
