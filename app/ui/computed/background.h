// Long work on its own thread, so that the window never waits.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/result.h"
#include "core/run/workers.h"

namespace hapticwall::ui {

// Max threads of a task that shares its work out: one core is left to the loop and the window.
[[nodiscard]] inline int background_thread_count() {
  return static_cast<int>(std::max<std::size_t>(worker_count(0), 2) - 1);
}

// A thread of its own for each task. In a browser, which has none: deferred, so that take() runs
// it.
[[nodiscard]] std::launch background_launch();

// One task at a time. All members are called from the owner's thread. None waits, except the
// destructor, which waits for the end of the task, and take() where background_launch() is
// deferred.
template <typename T>
class Background {
 public:
  // Called with a fraction from 0 to 1; returns false to ask for cancellation.
  using Progress = std::function<bool(double fraction)>;
  using Work = std::function<Result<T>(const Progress& progress)>;

  Background() = default;
  Background(Background&&) noexcept = default;
  Background& operator=(Background&& other) noexcept {
    std::swap(state_, other.state_);
    std::swap(future_, other.future_);
    std::swap(ending_, other.ending_);
    return *this;
  }
  ~Background() { give_up(); }

  // Cancels a running task first.
  void start(Work work, std::launch launch = background_launch()) {
    give_up();
    state_ = std::make_shared<State>();
    future_ = std::async(launch, [state = state_, work = std::move(work)] {
      return guarded(work, [&state](double fraction) {
        state->fraction.store(fraction, std::memory_order_relaxed);
        return !state->given_up.load(std::memory_order_relaxed);
      });
    });
  }

  // Cancels the task; its thread ends at its next progress report.
  void give_up() {
    std::erase_if(ending_, is_ready);
    if (!future_.valid()) return;
    state_->given_up.store(true, std::memory_order_relaxed);
    ending_.push_back(std::move(future_));
  }

  [[nodiscard]] bool running() const { return future_.valid(); }
  [[nodiscard]] double fraction() const {
    return state_ == nullptr ? 0.0 : state_->fraction.load(std::memory_order_relaxed);
  }
  // The result, once, when the task is done.
  [[nodiscard]] std::optional<Result<T>> take() {
    if (!future_.valid() || !is_ready(future_)) return std::nullopt;
    return future_.get();
  }

 private:
  struct State {
    std::atomic<double> fraction{0.0};
    std::atomic<bool> given_up{false};
  };

  static bool is_ready(const std::future<Result<T>>& future) {
    return future.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
  }
  static Result<T> guarded(const Work& work, const Progress& progress) {
    try {
      return work(progress);
    } catch (const std::exception& problem) {  // no memory
      return Error{ErrorKind::kFile, problem.what()};
    }
  }

  std::shared_ptr<State> state_;
  std::future<Result<T>> future_;
  std::vector<std::future<Result<T>>> ending_;  // cancelled, but not finished yet
};

}  // namespace hapticwall::ui
