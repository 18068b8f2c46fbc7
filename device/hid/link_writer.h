// What a writer's thread does: take the newest command, and write it, however long that takes.
//
// A write that does not end cannot be interrupted. The owner then abandons the session: whoever
// writes touches nothing any more but the session itself, and ends when the write does.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "device/hid_port.h"
#include "device/link_command.h"
#include "device/link_exchange.h"
#include "device/link_options.h"

namespace hapticwall::device {

class WriteSession {
 public:
  // `exchange` outlives whatever is done here before abandon() or done().
  WriteSession(std::uint32_t number, std::unique_ptr<hid::Handle> handle,
               std::shared_ptr<SentCommands> sent, LinkExchange& exchange);

  // The writer's. What to write now, if anything: after a report came out, write it, then finish().
  // The first one is without enable, and so is the last.
  [[nodiscard]] std::optional<hid::ReportBytes> begin(std::int64_t now_ns);
  void finish(std::int64_t now_ns);
  [[nodiscard]] hid::Handle& handle() { return *handle_; }
  // Nothing more to do, for ever: the writer lets go.
  [[nodiscard]] bool over() const { return state() == State::kDone; }

  // The owner's. One last command without enable, then it is done().
  void stop() { stop_.store(true, std::memory_order_release); }
  // Leaves a writer alone that is in a write; false where it is not (then it is about to be done).
  [[nodiscard]] bool abandon();
  // The writer never touches this again, but for letting go.
  [[nodiscard]] bool done() const { return state() == State::kDone; }
  // Once done.
  void close() { handle_.reset(); }

 private:
  enum class State : std::uint8_t {
    kIdle,
    kTaking,     // at the mailbox: for an instant only
    kWriting,    // in a write: for up to five seconds
    kAbandoned,  // in a write, and done after it
    kDone
  };
  [[nodiscard]] State state() const { return state_.load(std::memory_order_acquire); }
  [[nodiscard]] bool move(State from, State to) {
    return state_.compare_exchange_strong(from, to, std::memory_order_acq_rel);
  }
  [[nodiscard]] bool next_command(LinkCommand& command);

  const std::uint32_t number_;
  std::unique_ptr<hid::Handle> handle_;
  std::shared_ptr<SentCommands> sent_;
  LinkExchange& exchange_;
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
