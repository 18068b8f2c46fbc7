// What the reader's thread does: wait for a report, drain to the newest, publish.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include "device/hid_port.h"
#include "device/link_exchange.h"
#include "device/link_options.h"
#include "device/link_state.h"

namespace hapticwall::device {

// One open link, as far as it reads. Made and destroyed by the owner, whose the handle is again
// once `released` is set.
struct ReadSession {
  LinkSession link;
  std::unique_ptr<hid::Handle> handle;

  std::atomic<bool> stop{false};               // owner -> reader
  std::atomic<bool> released{false};           // reader -> owner: it never touches this again
  std::atomic<std::int64_t> newest_ns{0};      // when the newest valid state came; 0: none yet
  std::atomic<Trouble> ended{Trouble::kNone};  // the reader takes no more from it
  std::atomic<std::uint64_t> packets{0};       // of any kind
};

class LinkReader {
 public:
  LinkReader(LinkExchange& exchange, const HostClock& now_ns)
      : exchange_(exchange), now_ns_(now_ns) {}

  // The owner's: the next session; the one before has been released. Returns at once.
  void give(std::shared_ptr<ReadSession> session);
  // Whoever's: wakes a reader that has nothing to do.
  void wake();

  enum class Step : std::uint8_t { kWorked, kNothingToDo, kFailed };
  // The reader's: one look. Waits for a report `wait_ms` at most.
  Step step(int wait_ms);
  // The reader's: until there may be something to do.
  void rest(std::chrono::milliseconds longest);

 private:
  void take_session();
  bool drain(int wait_ms);

  LinkExchange& exchange_;
  const HostClock& now_ns_;
  StateTracker tracker_;
  std::shared_ptr<ReadSession> session_;

  std::mutex mutex_;
  std::condition_variable news_;
  std::shared_ptr<ReadSession> next_;  // under the mutex
  bool awake_ = false;                 // under the mutex
};

}  // namespace hapticwall::device
