// The writer's thread: takes the newest command and writes it, however long that takes.
//
// A hanging write cannot be interrupted. The owner then abandons the session: the writer uses only
// the session from then on, and ends when the write returns.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "device/link/link.h"
#include "device/link/link_command.h"
#include "device/link/port.h"

namespace hapticwall::device {

class WriteSession {
 public:
  // `exchange` must outlive every call before abandon() or done(). `keep_alive_ns`: as of
  // ImpulseEngineOptions.
  WriteSession(std::uint32_t number, std::unique_ptr<hid::Handle> handle,
               std::shared_ptr<SentCommands> sent, LinkExchange& exchange,
               std::int64_t keep_alive_ns = 0);

  // Writer: the report to write now, if any; call finish() after writing it. The first and the last
  // report do not enable the force.
  [[nodiscard]] std::optional<hid::ReportBytes> begin(std::int64_t now_ns);
  // Measures the write, unless the owner has abandoned it: the exchange may then be gone.
  void finish(std::int64_t now_ns);
  [[nodiscard]] hid::Handle& handle() { return *handle_; }
  // Max rest of the writer without a new command, nanoseconds; 0: until there is one.
  [[nodiscard]] std::int64_t keep_alive_ns() const { return keep_alive_ns_; }
  // The writer has nothing more to do.
  [[nodiscard]] bool over() const { return state() == State::kDone; }

  // Owner: one last command without enable, then the session is done().
  void stop() { stop_.store(true, std::memory_order_release); }
  // Abandons a writer that is in a write; false if it is not in one and is about to be done.
  [[nodiscard]] bool abandon();
  // The writer no longer uses the session.
  [[nodiscard]] bool done() const { return state() == State::kDone; }
  // Closes the handle, once done().
  void close() { handle_.reset(); }

 private:
  enum class State : std::uint8_t {
    kIdle,
    kTaking,     // takes a command: for an instant
    kWriting,    // in a write: up to five seconds were seen
    kAbandoned,  // in a write, and done after it
    kDone
  };
  [[nodiscard]] State state() const { return state_.load(std::memory_order_acquire); }
  [[nodiscard]] bool move(State from, State to) {
    return state_.compare_exchange_strong(from, to, std::memory_order_acq_rel);
  }
  [[nodiscard]] bool next_command(LinkCommand& command, std::int64_t now_ns);

  const std::uint32_t number_;
  std::unique_ptr<hid::Handle> handle_;
  std::shared_ptr<SentCommands> sent_;
  LinkExchange& exchange_;
  const std::int64_t keep_alive_ns_;
  std::atomic<State> state_{State::kIdle};
  std::atomic<bool> stop_{false};

  // The writer's own.
  LinkCommand newest_;
  std::uint16_t sequence_ = 0;
  bool begun_ = false;
  bool last_ = false;
  std::int64_t began_ns_ = 0;
};

}  // namespace hapticwall::device
