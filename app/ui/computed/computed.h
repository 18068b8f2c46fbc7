// The one way to compute beside the session: a page asks a question, and shows the parts of the
// answer as they come.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/session/loop/realtime_setup.h"
#include "app/ui/computed/background.h"
#include "core/result.h"

namespace hapticwall::ui {

// `Question`: a value that is copied. `Part`: one delivery of the work; the caller of take()
// decides whether a part adds to the one before or replaces it. All members are called from the
// owner's thread. None waits, except the destructor, which waits for the end of the work. Errors of
// the work are problem(). Realtime-safe: no.
template <typename Question, typename Part>
class Computed {
 public:
  using Progress = typename Background<bool>::Progress;
  using Deliver = std::function<void(Part)>;
  // Runs on a thread of its own. Returns false if `progress` asked it to end.
  using Work = std::function<Result<bool>(const Question&, const Progress&, const Deliver&)>;
  using Same = std::function<bool(const Question&, const Question&)>;
  // Says why a question has no answer, before any work; "" if it may have one.
  using Check = std::string (*)(const Question&);

  Computed(Work work, Same same, Check check = nullptr)
      : work_(std::move(work)), same_(std::move(same)), check_(check) {}

  // Cancels running work first.
  void start(const Question& question) {
    stop();
    asked_ = question;
    ++count_;
    answered_ = false;
    problem_ = check_ != nullptr ? check_(question) : "";
    if (!problem_.empty()) return;
    outbox_ = std::make_shared<Outbox>();
    task_.start([work = work_, question, outbox = outbox_](const Progress& progress) {
      session::set_up_background_thread();
      return work(question, progress, [&](Part part) {
        const std::scoped_lock lock(outbox->mutex);
        outbox->parts.push_back(std::move(part));
      });
    });
  }
  // Starts unless the newest question is the same and was not stopped.
  void ask_for(const Question& question) {
    if (!is_asked(question) || !(running() || answered_ || !problem_.empty())) start(question);
  }
  // Cancels the work and drops the parts that were not taken.
  void stop() {
    task_.give_up();
    outbox_.reset();
  }
  // The parts since the last call, in their order.
  [[nodiscard]] std::vector<Part> take() {
    // Taken before the parts: once the work has ended, all parts are there.
    auto ended = task_.take();
    std::vector<Part> parts;
    if (outbox_) {
      const std::scoped_lock lock(outbox_->mutex);
      parts.swap(outbox_->parts);
    }
    if (ended && ended->ok()) answered_ = **ended;
    if (ended && !ended->ok()) problem_ = ended->error().message;
    return parts;
  }
  void clear_problem() { problem_.clear(); }

  [[nodiscard]] std::size_t count() const { return count_; }  // number of starts
  [[nodiscard]] bool running() const { return task_.running(); }
  [[nodiscard]] double fraction() const { return task_.fraction(); }  // 0 to 1
  [[nodiscard]] bool answered() const { return answered_; }           // true: all parts are there
  [[nodiscard]] const std::optional<Question>& asked() const { return asked_; }
  [[nodiscard]] bool is_asked(const Question& question) const {
    return asked_ && same_(*asked_, question);
  }
  [[nodiscard]] bool same(const Question& a, const Question& b) const { return same_(a, b); }
  // Says why there is no answer; "" if there may be one.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  struct Outbox {
    std::mutex mutex;
    std::vector<Part> parts;
  };

  Work work_;
  Same same_;
  Check check_;
  Background<bool> task_;
  std::shared_ptr<Outbox> outbox_;
  std::optional<Question> asked_;
  std::size_t count_ = 0;
  bool answered_ = false;
  std::string problem_;
};

}  // namespace hapticwall::ui
