// The operating system's account of the work that the calling thread has done.
#pragma once

#include <cstdint>

namespace hapticwall::command {

// Nanoseconds that this thread has had a processor; what other programs take from it does not
// count. Never goes back.
[[nodiscard]] std::int64_t thread_processor_time_ns();

}  // namespace hapticwall::command
