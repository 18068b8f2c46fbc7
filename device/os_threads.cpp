#include "device/os_threads.h"

#include <pthread.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): pthread_sigmask is not in <csignal>
#include <time.h>    // NOLINT(modernize-deprecated-headers): clock_gettime is not in <ctime>

#include <cstdint>
#include <utility>

namespace hapticwall::device {
namespace {

constexpr std::int64_t kNanosecondsInSecond = 1'000'000'000;

timespec after(std::chrono::nanoseconds wait) {
  const std::int64_t end_ns = monotonic_ns() + wait.count();
  timespec end{};
  end.tv_sec = static_cast<time_t>(end_ns / kNanosecondsInSecond);
  end.tv_nsec = static_cast<long>(end_ns % kNanosecondsInSecond);  // NOLINT(google-runtime-int)
  return end;
}

}  // namespace

WakeSignal::WakeSignal() { sem_init(&semaphore_, 0, 0); }

WakeSignal::~WakeSignal() { sem_destroy(&semaphore_); }

void WakeSignal::post() { sem_post(&semaphore_); }

void WakeSignal::wait(std::chrono::milliseconds longest) {
  const timespec end = after(longest);
  sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &end);
  while (sem_trywait(&semaphore_) == 0) {
  }
}

std::thread start_thread(std::function<void()> body) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    std::thread thread(std::move(body));
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return thread;
  } catch (...) {
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    throw;
  }
}

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNanosecondsInSecond + now.tv_nsec;
}

}  // namespace hapticwall::device
