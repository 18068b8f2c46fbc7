// Runs a study from the command line: checks, computes, and writes its files.
#pragma once

#include <string_view>

#include "app/command/common_options.h"
#include "app/study/study.h"

namespace hapticwall::command {

// `command`: the command's name. `prefix`: begins a message about a scene without such a study.
// Returns the exit status.
[[nodiscard]] Result<int> run_study(const study::Study& study, std::string_view command,
                                    std::string_view prefix, const SceneOptions& scene,
                                    const OutputOptions& output, const study::Choices& choices);

}  // namespace hapticwall::command
