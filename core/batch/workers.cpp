#include "core/batch/workers.h"

#include <oneapi/tbb/info.h>

#include <atomic>
#include <exception>
#include <stdexcept>
#include <vector>

// oneTBB's library is not built for ThreadSanitizer, which would take every item that it hands from
// thread to thread for a race. There the items go to threads that it sees through.
#if defined(__has_feature)
#define HAPTICWALL_HAS_FEATURE(name) __has_feature(name)
#else
#define HAPTICWALL_HAS_FEATURE(name) 0
#endif
#if defined(__SANITIZE_THREAD__) || HAPTICWALL_HAS_FEATURE(thread_sanitizer)
#define HAPTICWALL_PLAIN_THREADS 1
#include <thread>
#else
#define HAPTICWALL_PLAIN_THREADS 0
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#endif

namespace hapticwall::batch {
namespace {

using Worker = std::function<void(std::size_t worker)>;

// Calls `work` on at most `workers` threads. Throws std::runtime_error if the system has no thread
// for one; then no call runs any more.
#if HAPTICWALL_PLAIN_THREADS

void on_threads(std::size_t workers, const Worker& work) {
  std::vector<std::jthread> threads;
  for (std::size_t worker = 1; worker < workers; ++worker) threads.emplace_back(work, worker);
  work(0);
}

#else

void on_threads(std::size_t workers, const Worker& work) {
  // More threads than the processor runs at a time are allowed only so.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  std::max(workers, worker_count(0)));
  tbb::task_arena arena(static_cast<int>(workers));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, workers, [&](std::size_t) {
      work(static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()));
    });
  });
}

#endif

}  // namespace

std::size_t worker_count(int threads) {
  return static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency());
}

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
  try {
    on_threads(workers, take_items);
  } catch (const std::runtime_error&) {
    take_items(0);  // without more threads
  }
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

}  // namespace hapticwall::batch
