#include "device/link/link_machine.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "device/os_threads.h"

namespace hapticwall::device {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::chrono::seconds kMaxOpening{5};
// Longer than a last command and a reader's wait: a thread that runs longer is in a write.
constexpr milliseconds kMaxClosing{1000};
constexpr int kReadWaitMs = 5;
// Retry interval of failed reads: only a time-out shows that the link is lost.
constexpr milliseconds kAfterFailure{1};
constexpr milliseconds kReaderRest{1000};
constexpr milliseconds kWriterRest{100};

// A millisecond finds the time for a repeated command well enough.
milliseconds rest_of(const WriteSession& session) {
  return session.keep_alive_ns() > 0 ? milliseconds{1} : kWriterRest;
}

}  // namespace

LinkMachine::LinkMachine(const ImpulseEngineOptions& options, hid::PortOpener open_port,
                         HostClock now_ns)
    : now_ns_(std::move(now_ns)),
      prepare_thread_(options.prepare_thread),
      reader_(exchange_, now_ns_),
      owner_(exchange_, reader_, options, std::move(open_port), now_ns_,
             [this](std::shared_ptr<WriteSession> session) {
               return start_writer(std::move(session));
             }),
      loop_(exchange_, now_ns_) {}

Failure LinkMachine::bring_up() {
  try {
    thread_ = start_thread([self = shared_from_this()] { self->own(); });
  } catch (const std::system_error&) {
    return device_error("the device gets no thread: the system runs too many; end other programs");
  }
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kMaxOpening,
                    [this] { return over_ || owner_.opening() != Opening::kPending; });
  if (owner_.opening() == Opening::kUp) return std::nullopt;
  const std::string words = owner_.words();
  return device_error(words.empty() ? "the device does not answer: plug it in again" : words);
}

void LinkMachine::take_down() {
  if (!thread_.joinable()) return;
  std::unique_lock lock(mutex_);
  owner_.stop();
  wake_owner_ = true;
  changed_.notify_all();
  changed_.wait_for(lock, kMaxClosing,
                    [this] { return over_ || owner_.ending() == Ending::kLeftAlone; });
  const bool over = over_;
  lock.unlock();
  if (over) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

void LinkMachine::own() {
  std::thread reader;
  try {
    reader = start_thread([this] { read(); });
  } catch (const std::system_error&) {
    owner_.stop();
  }
  while (true) {
    const std::int64_t next_ns = owner_.step();
    std::unique_lock lock(mutex_);
    if (owner_.opening() != Opening::kPending) changed_.notify_all();
    if (owner_.ending() == Ending::kEnded) break;
    const nanoseconds wait{std::max<std::int64_t>(next_ns - now_ns_(), 0)};
    changed_.wait_for(lock, wait, [this] { return wake_owner_; });
    wake_owner_ = false;
  }
  reader_stop_.store(true, std::memory_order_release);
  reader_.wake();
  if (reader.joinable()) reader.join();
  const std::lock_guard lock(mutex_);
  over_ = true;
  changed_.notify_all();
}

void LinkMachine::read() {
  if (prepare_thread_) prepare_thread_();
  while (!reader_stop_.load(std::memory_order_acquire)) {
    switch (reader_.step(kReadWaitMs)) {
      case LinkReader::Step::kWorked:
        break;
      case LinkReader::Step::kNothingToDo:
        reader_.rest(kReaderRest);
        break;
      case LinkReader::Step::kFailed:
        reader_.rest(kAfterFailure);
        break;
    }
  }
}

std::function<void()> LinkMachine::start_writer(std::shared_ptr<WriteSession> session) {
  const auto thread = std::make_shared<std::thread>(
      start_thread([this, session = std::move(session)] { write(*session); }));
  return [thread] { thread->join(); };
}

void LinkMachine::write(WriteSession& session) {
  if (prepare_thread_) prepare_thread_();
  while (!session.over()) {
    if (const auto bytes = session.begin(now_ns_())) {
      session.handle().write(*bytes);
      session.finish(now_ns_());
      if (session.over()) break;
      std::this_thread::sleep_for(nanoseconds(session.handle().free_ns() - now_ns_()));
    } else {
      exchange_.command_signal.wait(rest_of(session));
    }
  }
}

}  // namespace hapticwall::device
