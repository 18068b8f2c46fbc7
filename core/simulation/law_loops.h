// The headless loops of every algorithm in the closed list.
#pragma once

#include <cstddef>

#include "core/simulation/headless_loop.h"

namespace hapticwall {

// `algorithm`: index in algorithms(). Realtime-safe: yes.
[[nodiscard]] const LawLoops& law_loops(std::size_t algorithm);

}  // namespace hapticwall
