// The options that `run` and `compare` share, and what follows from them before anything runs.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "app/command/expectation.h"
#include "app/file/scene_file.h"
#include "core/result.h"

namespace hapticwall::command {

// Of the window, where nothing is asked for.
inline constexpr const char* kDefaultScene = "press";

// What chooses a scene; the window takes these too.
struct SceneOptions {
  std::string scene;
  std::string algorithm;
  std::string duration;
  std::vector<std::string> settings;  // of --set
  std::string device = "sim";
  bool allow_no_realtime = false;
  double spin_us = 0.0;
};

// What is done with the outcome.
struct OutputOptions {
  std::string csv;
  std::string json;
  std::string plot;
  std::vector<std::string> expectations;
  std::uint64_t seed = 0;  // nothing of the present model is random
  bool quiet = false;
};

inline constexpr const char* kStandardOutput = "-";

// --set.
void add_scene_options(CLI::App& app, SceneOptions& options);
// --device alone: accepted for scripts by commands that compute on the simulator.
void add_simulator_option(CLI::App& app, SceneOptions& options);
// --device, --allow-no-realtime and --spin.
void add_device_options(CLI::App& app, SceneOptions& options);
// --spin, and what it says in seconds.
void add_spin_option(CLI::App& app, double& spin_us);
[[nodiscard]] Result<double> spin_seconds(double spin_us);
void add_algorithm_option(CLI::App& app, SceneOptions& options);
// The required SCENE of a command, and --duration.
void add_headless_options(CLI::App& app, SceneOptions& options);
// --json, --expect, --seed, --quiet.
void add_output_options(CLI::App& app, OutputOptions& options);

// The scene with --set, then --algorithm and --duration, applied.
[[nodiscard]] Result<file::LoadedScene> load(const SceneOptions& options);

// The same for runs of the simulator without a window, where no pointer can lead the hand.
[[nodiscard]] Result<file::LoadedScene> load_headless(const SceneOptions& options);

// A scene in which parameters change at some tick is nothing for `command`.
[[nodiscard]] Failure check_unchanging(const std::string& command, const SceneOptions& options,
                                       const file::LoadedScene& loaded);

// Two outputs into one file, one in the place of a file of `read`, and --csv or --plot to standard
// output, are usage errors.
[[nodiscard]] Failure check_outputs(const OutputOptions& options,
                                    std::initializer_list<std::string> read);

// --algorithms A,B,...
void add_algorithms_option(CLI::App& app, std::vector<std::string>& names);
// Indices in algorithms(), in the order of the names; of no names: all.
[[nodiscard]] Result<std::vector<std::size_t>> chosen_algorithms(
    const std::vector<std::string>& names);

[[nodiscard]] Failure check_algorithm_name(std::string_view option, const std::string& name);

}  // namespace hapticwall::command
