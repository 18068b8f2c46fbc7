// The commands of the program. Each adds itself to the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string_view>

#include "app/command/common_options.h"
#include "app/session/window_options.h"
#include "app/study/study.h"
#include "core/result.h"

namespace hapticwall::command {

// Returns the exit status. The caller reports an error.
using Action = std::function<Result<int>()>;

// The window opens without a command: its options are those of `program` itself.
[[nodiscard]] Action add_window(CLI::App& program, session::OpenWindow open);

struct Command {
  CLI::App* app;
  Action action;
};
[[nodiscard]] Command add_run(CLI::App& program);
[[nodiscard]] Command add_compare(CLI::App& program);
[[nodiscard]] Command add_map(CLI::App& program);
// The command of a study; `study` outlives it.
[[nodiscard]] Command add_study(CLI::App& program, const study::Study& study);
[[nodiscard]] Command add_replay(CLI::App& program, session::OpenWindow open);
[[nodiscard]] Command add_recover(CLI::App& program);
[[nodiscard]] Command add_timing(CLI::App& program);
[[nodiscard]] Command add_identify(CLI::App& program);
[[nodiscard]] Command add_devices(CLI::App& program);
[[nodiscard]] Command add_scenes(CLI::App& program);

// Checks, computes, and writes the files of a study. `command`: the command's name. `prefix`:
// begins a message about a scene without such a study. Returns the exit status.
[[nodiscard]] Result<int> run_study(const study::Study& study, std::string_view command,
                                    std::string_view prefix, const SceneOptions& scene,
                                    const OutputOptions& output, const study::Choices& choices);

}  // namespace hapticwall::command
