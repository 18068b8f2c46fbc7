#include "core/batch/workers.h"

#include <oneapi/tbb/info.h>

// oneTBB's library is not built for ThreadSanitizer, which would take every item that it hands from
// thread to thread for a race. There the items go to threads that it sees through.
#if defined(__has_feature)
#define HAPTICWALL_HAS_FEATURE(name) __has_feature(name)
#else
#define HAPTICWALL_HAS_FEATURE(name) 0
#endif
#if defined(__SANITIZE_THREAD__) || HAPTICWALL_HAS_FEATURE(thread_sanitizer)
#define HAPTICWALL_PLAIN_THREADS 1
#include <atomic>
#include <exception>
#include <thread>
#include <vector>
#else
#define HAPTICWALL_PLAIN_THREADS 0
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#endif

namespace hapticwall::batch {

std::size_t worker_count(int threads) {
  return static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency());
}

#if HAPTICWALL_PLAIN_THREADS

void share_out(std::size_t items, std::size_t workers,
               const std::function<void(std::size_t item, std::size_t worker)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> thrown(workers);
  const auto take_items = [&](std::size_t worker) {
    try {
      for (std::size_t item = next++; item < items; item = next++) work(item, worker);
    } catch (...) {
      thrown[worker] = std::current_exception();
      next = items;
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t worker = 1; worker < workers; ++worker) {
      threads.emplace_back(take_items, worker);
    }
    take_items(0);
  }
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

#else

void share_out(std::size_t items, std::size_t workers,
               const std::function<void(std::size_t item, std::size_t worker)>& work) {
  // More threads than the processor runs at a time are allowed only so.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  std::max(workers, worker_count(0)));
  tbb::task_arena arena(static_cast<int>(workers));
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, items), [&](const auto& range) {
      const int worker = tbb::this_task_arena::current_thread_index();
      for (std::size_t item = range.begin(); item != range.end(); ++item) {
        work(item, static_cast<std::size_t>(worker));
      }
    });
  });
}

#endif

}  // namespace hapticwall::batch
