// hapticwall map SCENE --boundary KEY=LO:HI:N[:log].
#pragma once

#include "app/command/map_options.h"
#include "core/scene.h"

namespace hapticwall::command {

// Finds, writes and prints the boundaries; the exit status.
[[nodiscard]] int run_boundary(const MapOptions& options, Scene scene);

}  // namespace hapticwall::command
