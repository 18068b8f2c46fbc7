// The threads of a link, and all that they share. They hold it together: whoever is the last one,
// which is the owner's thread where a write does not end, lets it go.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/result.h"
#include "device/link_exchange.h"
#include "device/link_loop.h"
#include "device/link_options.h"
#include "device/link_owner.h"
#include "device/link_reader.h"

namespace hapticwall::device {

// One open(): used up by take_down().
class LinkMachine : public std::enable_shared_from_this<LinkMachine> {
 public:
  LinkMachine(const ImpulseEngineOptions& options, hid::PortOpener open_port, HostClock now_ns);

  // Starts the threads and waits for the first link-up. After a failure too, take_down().
  [[nodiscard]] Failure bring_up();
  // Ends them: waits for them, but not for what does not end. Harmless twice.
  void take_down();

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
