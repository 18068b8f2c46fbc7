// The threads of a link and the data that they share. Shared ownership: the last thread to leave
// frees it, which is the owner's thread if a write does not end.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "core/result.h"
#include "device/link/link.h"
#include "device/link/link_loop.h"
#include "device/link/link_owner.h"
#include "device/link/link_reader.h"

namespace hapticwall::device {

// Serves one open(); take_down() ends it for good.
class LinkMachine : public std::enable_shared_from_this<LinkMachine> {
 public:
  LinkMachine(const ImpulseEngineOptions& options, hid::PortOpener open_port, HostClock now_ns);

  // Starts the threads and waits for the first link-up, at most five seconds. Fails with
  // ErrorKind::kDevice. Call take_down() after a failure, too. Realtime-safe: no.
  [[nodiscard]] Failure bring_up();
  // Ends the threads and waits for them, at most one second: a write that does not end keeps its
  // thread. Idempotent. Realtime-safe: no.
  void take_down();

  // For the thread of the loop alone.
  [[nodiscard]] LinkLoop& loop() { return loop_; }
  [[nodiscard]] const LinkOwner& owner() const { return owner_; }

 private:
  void own();
  void read();
  void write(WriteSession& session);
  [[nodiscard]] std::function<void()> start_writer(std::shared_ptr<WriteSession> session);

  const HostClock now_ns_;
  const std::function<void()> prepare_thread_;
  LinkExchange exchange_;
  LinkReader reader_;
  LinkOwner owner_;
  LinkLoop loop_;
  std::atomic<bool> reader_stop_{false};
  std::thread thread_;  // the owner's

  std::mutex mutex_;
  std::condition_variable changed_;
  bool wake_owner_ = false;  // these two under the mutex
  bool over_ = false;
};

}  // namespace hapticwall::device
