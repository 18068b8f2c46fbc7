// The reader's thread: waits for a report, drains to the newest, publishes it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>

#include "device/link/link.h"
#include "device/link/link_state.h"
#include "device/link/port.h"

namespace hapticwall::device {

// The reading half of an open link. The owner creates and destroys it, and gets the handle back
// once `released` is set.
struct ReadSession {
  LinkSession link;
  std::unique_ptr<hid::Handle> handle;

  std::atomic<bool> stop{false};               // owner -> reader
  std::atomic<bool> released{false};           // reader -> owner: the reader no longer uses it
  std::atomic<std::int64_t> newest_ns{0};      // arrival of the newest valid state; 0: none
  std::atomic<Trouble> ended{Trouble::kNone};  // why the reader stopped taking states
  std::atomic<bool> gone{false};               // it was unplugged, for certain
  std::atomic<std::uint64_t> packets{0};       // of any kind
};

class LinkReader {
 public:
  LinkReader(LinkExchange& exchange, const HostClock& now_ns)
      : exchange_(exchange), now_ns_(now_ns) {}

  // Owner: hands over the next session, after the previous one was released. Does not wait.
  void give(std::shared_ptr<ReadSession> session);
  // Any thread: wakes a resting reader.
  void wake();

  // kNothingToDo: no session is open, so the reader may rest. kFailed: the transport failed, and a
  // read at once would fail again.
  enum class Step : std::uint8_t { kWorked, kNothingToDo, kFailed };
  // Reader: one round. Waits for a report at most `wait_ms`, then takes all that are queued,
  // because only the newest position counts.
  Step step(int wait_ms);
  // Reader: waits for work.
  void rest(std::chrono::milliseconds longest);

 private:
  void take_session();
  [[nodiscard]] hid::ReadKind drain(int wait_ms);
  void take(std::span<const std::uint8_t> bytes, std::int64_t now_ns, Trouble gap);

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
