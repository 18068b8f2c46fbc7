#include "tests/app/session/loop/interposition.h"

#include <dlfcn.h>
#include <pthread.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>

namespace hapticwall::session::test {
namespace {

thread_local bool watching = false;
thread_local WatchedCalls watched;

}  // namespace

CallWatch::CallWatch() {
  watched = {};
  watching = true;
}

CallWatch::~CallWatch() { watching = false; }

WatchedCalls CallWatch::calls() {
  watching = false;
  return watched;
}

namespace {

[[maybe_unused]] void count_allocation() { watched.allocations += watching ? 1U : 0U; }
[[maybe_unused]] void count_free() { watched.frees += watching ? 1U : 0U; }
[[maybe_unused]] void count_lock() { watched.locks += watching ? 1U : 0U; }

}  // namespace
}  // namespace hapticwall::session::test

#if HAPTICWALL_INTERPOSITION

namespace counters = hapticwall::session::test;

extern "C" {

// The C library's names of the replaced functions.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(std::size_t size);
void __libc_free(void* memory);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t size) noexcept {
  counters::count_allocation();
  return __libc_malloc(size);
}

void free(void* memory) noexcept {
  counters::count_free();
  __libc_free(memory);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  counters::count_allocation();
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  counters::count_allocation();
  return __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  counters::count_allocation();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  counters::count_allocation();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  counters::count_allocation();
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  using Lock = int (*)(pthread_mutex_t*);
  static Lock real = nullptr;  // set twice at worst, to the same
  if (__atomic_load_n(&real, __ATOMIC_RELAXED) == nullptr) {
    __atomic_store_n(&real, reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock")),
                     __ATOMIC_RELAXED);
  }
  counters::count_lock();
  return __atomic_load_n(&real, __ATOMIC_RELAXED)(mutex);
}

}  // extern "C"

#endif  // HAPTICWALL_INTERPOSITION
