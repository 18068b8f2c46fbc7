// Long work beside the interpreter: without its lock, and Ctrl-C ends it.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <utility>

#include "core/result.h"

namespace hapticwall::python {

// Interval between two checks for Ctrl-C.
inline constexpr std::chrono::milliseconds kSignalPeriod{50};

// Counts the runs that have begun and not ended, of all threads. Laws change only while there is
// none.
class RunningMark {
 public:
  RunningMark() { ++count(); }
  ~RunningMark() { --count(); }
  RunningMark(const RunningMark&) = delete;
  RunningMark& operator=(const RunningMark&) = delete;

  [[nodiscard]] static std::atomic<int>& count() {
    static std::atomic<int> running = 0;
    return running;
  }
};

// True: the work must end.
using StopQuestion = std::function<bool()>;

// Raises what `error` says: OSError for a file, else ValueError.
[[noreturn]] inline void raise(const Error& error) {
  PyErr_SetString(error.kind == ErrorKind::kFile ? PyExc_OSError : PyExc_ValueError,
                  error.message.c_str());
  throw nanobind::python_error();
}
template <typename T>
[[nodiscard]] T value_or_raise(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(*result);
}

// The interpreter's state of a thread, made once and not for every call of a Python law.
class InterpreterThread {
 public:
  InterpreterThread() : state_(PyGILState_Ensure()), saved_(PyEval_SaveThread()) {}
  ~InterpreterThread() {
    PyEval_RestoreThread(saved_);
    PyGILState_Release(state_);
  }
  InterpreterThread(const InterpreterThread&) = delete;
  InterpreterThread& operator=(const InterpreterThread&) = delete;

 private:
  PyGILState_STATE state_;
  PyThreadState* saved_;
};

// Calls work(should_stop) on a thread of its own and gives its result. Raises KeyboardInterrupt, or
// what another signal handler raised, after the work has stopped.
template <typename Work>
auto interruptibly(const Work& work) {
  std::atomic<bool> stop = false;
  std::optional<nanobind::python_error> raised;
  const RunningMark mark;
  auto future = std::async(std::launch::async, [&] {
    const InterpreterThread thread;
    return work([&] { return stop.load(); });
  });
  {
    const nanobind::gil_scoped_release released;
    while (future.wait_for(kSignalPeriod) != std::future_status::ready) {
      const nanobind::gil_scoped_acquire acquired;
      if (raised || PyErr_CheckSignals() == 0) continue;
      raised.emplace();
      stop = true;
    }
  }
  if (raised) throw std::move(*raised);
  return future.get();
}

}  // namespace hapticwall::python
