#include "core/run/workers.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace hapticwall {
namespace {

using Worker = std::function<void(std::size_t worker)>;

void on_threads(std::size_t workers, const Worker& work) {
  std::vector<std::jthread> threads;
  try {
    for (std::size_t worker = 1; worker < workers; ++worker) threads.emplace_back(work, worker);
  } catch (const std::system_error&) {  // fewer threads do the same work
  }
  work(0);
}

}  // namespace

std::size_t worker_count(int threads) {
  if (threads > 0) return static_cast<std::size_t>(threads);
  // std::thread::hardware_concurrency() ignores the affinity mask.
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
    return static_cast<std::size_t>(std::max(CPU_COUNT(&allowed), 1));
  return std::max(std::thread::hardware_concurrency(), 1U);  // over 1024 processors
}

void share_out(std::size_t items, std::size_t workers,
               const std::function<void(std::size_t item, std::size_t worker)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> thrown(workers);
  on_threads(workers, [&](std::size_t worker) {
    try {
      for (std::size_t item = next++; item < items; item = next++) work(item, worker);
    } catch (...) {
      thrown[worker] = std::current_exception();
      next = items;
    }
  });
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

}  // namespace hapticwall
