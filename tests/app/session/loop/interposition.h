// Counts a thread's allocations and mutex locks during a watch, in the C library's malloc family
// and pthread_mutex_lock. operator new, containers and std::mutex use these, too.
#pragma once

#include <cstdint>

// Sanitizers bring their own allocator; there the counters stay at zero.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define HAPTICWALL_INTERPOSITION 0
#else
#define HAPTICWALL_INTERPOSITION 1
#endif

namespace hapticwall::session::test {

struct WatchedCalls {
  std::uint64_t allocations = 0;
  std::uint64_t frees = 0;
  std::uint64_t locks = 0;
};

// Watches the calling thread, from construction to calls().
class CallWatch {
 public:
  CallWatch();
  CallWatch(const CallWatch&) = delete;
  CallWatch& operator=(const CallWatch&) = delete;
  ~CallWatch();

  // Ends the watch: what the test does with the answer is not counted.
  [[nodiscard]] WatchedCalls calls();
};

}  // namespace hapticwall::session::test
