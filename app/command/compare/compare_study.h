// hapticwall compare SCENE --study: stiffness and hardness of a wall under every algorithm, and
// their cost.
#pragma once

#include <string>
#include <vector>

#include "app/command/common_options.h"

namespace hapticwall::command {

// `algorithms`: names; empty: all. Returns the exit status.
[[nodiscard]] Result<int> compare_study(const SceneOptions& scene, const OutputOptions& output,
                                        const std::vector<std::string>& algorithms);

}  // namespace hapticwall::command
