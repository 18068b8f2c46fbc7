// An experiment without a window: a simulated observer chooses (docs/experiments.md).
#pragma once

#include "app/session/experiment.h"
#include "core/result.h"

namespace hapticwall::command {

// Runs the trials that come through the feed. The hand of the scene presses once into either wall,
// and the other program chooses. Returns the exit status. Precondition: `experiment` has a feed.
[[nodiscard]] Result<int> rehearse(session::Experiment& experiment);

}  // namespace hapticwall::command
