#include "app/command/processor_time.h"

#include <ctime>

namespace hapticwall::command {

std::int64_t thread_processor_time_ns() {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNanosecondsPerSecond + now.tv_nsec;
}

}  // namespace hapticwall::command
