// The commands of the program. Each adds itself to the command line; its action returns the exit
// status.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace hapticwall::command {

using Action = std::function<int()>;

// The window is what the program does without a command: its options are those of `program` itself.
[[nodiscard]] Action add_window(CLI::App& program);

struct Command {
  CLI::App* app;
  Action action;
};
[[nodiscard]] Command add_run(CLI::App& program);
[[nodiscard]] Command add_compare(CLI::App& program);
[[nodiscard]] Command add_map(CLI::App& program);
[[nodiscard]] Command add_accuracy(CLI::App& program);
[[nodiscard]] Command add_replay(CLI::App& program);
[[nodiscard]] Command add_recover(CLI::App& program);
[[nodiscard]] Command add_timing(CLI::App& program);
[[nodiscard]] Command add_devices(CLI::App& program);
[[nodiscard]] Command add_scenes(CLI::App& program);

}  // namespace hapticwall::command
