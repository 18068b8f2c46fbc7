// What of a scene may change while a session runs: device, hand, walls, algorithm and simulator.
// The rate, the hand's path and whether there is a hand, and the start need a new session.
#pragma once

#include <optional>

#include "core/scene.h"

namespace hapticwall::runtime {

// True where nothing differs of what may change in a session.
[[nodiscard]] bool same_parameters(const Scene& a, const Scene& b);

// Why `wanted` cannot follow on `running` without a new session, or nothing.
[[nodiscard]] std::optional<SceneProblem> needs_new_session(const Scene& running,
                                                            const Scene& wanted);

}  // namespace hapticwall::runtime
