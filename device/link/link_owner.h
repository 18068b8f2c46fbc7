// The owner's thread: finds the device, opens it, watches the link, closes it and searches again.
// Only this thread lists, opens and closes.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "device/link/description.h"
#include "device/link/link.h"
#include "device/link/link_reader.h"
#include "device/link/link_writer.h"
#include "device/link/port.h"

namespace hapticwall::device {

// Time from an attempt to the next one. It doubles up to the max, and starts anew after a link-up.
inline constexpr std::int64_t kFirstBackOffNs = 50 * kMillisecondNs;
inline constexpr std::int64_t kMaxBackOffNs = 1000 * kMillisecondNs;
// Time limit of an opened device for its first valid state.
inline constexpr std::int64_t kFirstStateNs = 200 * kMillisecondNs;
// Time limit of the last command, after which its writer is abandoned.
inline constexpr std::int64_t kLastCommandNs = 100 * kMillisecondNs;
// Attempts before the first link-up fails; later losses are retried without end.
inline constexpr int kAttemptsToOpen = 4;

enum class Opening : std::uint8_t { kPending, kUp, kFailed };

enum class Ending : std::uint8_t {
  kNotYet,
  kLeftAlone,  // everything is closed except writers in a write that does not end
  kEnded       // everything is closed
};

class LinkOwner {
 public:
  // Runs the session's writer on a new thread. Returns a function that joins it, to be called once
  // the session is done.
  using StartWriter = std::function<std::function<void()>(std::shared_ptr<WriteSession>)>;

  LinkOwner(LinkExchange& exchange, LinkReader& reader, ImpulseEngineOptions options,
            hid::PortOpener open_port, const HostClock& now_ns, StartWriter start_writer);

  // One round of the owner's thread. Returns the time of the next one, by the host's clock. Waits
  // only for the transport.
  std::int64_t step();

  // Any thread. The next step takes the link down for good.
  void stop() { stop_.store(true, std::memory_order_release); }
  [[nodiscard]] Ending ending() const { return ending_.load(std::memory_order_acquire); }
  // Result of the first link-up; kFailed and kUp are final. After kFailed the search continues
  // until stop().
  [[nodiscard]] Opening opening() const { return opening_.load(std::memory_order_acquire); }
  // The present trouble in one line; empty if there is none. Realtime-safe: no, this and
  // description(): they take a mutex.
  [[nodiscard]] std::string words() const;
  // Description of the device of the newest link that came up.
  [[nodiscard]] std::optional<hid::DeviceDescription> description() const;

 private:
  enum class Phase : std::uint8_t { kLooking, kStarting, kUp, kClosing };
  struct Writer {
    std::shared_ptr<WriteSession> session;
    std::function<void()> join;
  };

  void look(std::int64_t now_ns);
  [[nodiscard]] Failure bring_up(std::int64_t now_ns);
  void start(const hid::Listing& listing, const hid::DeviceDescription& description,
             std::unique_ptr<hid::Handle> to_read, std::unique_ptr<hid::Handle> to_write,
             std::int64_t now_ns);
  void watch_start(std::int64_t now_ns);
  void watch(std::int64_t now_ns);
  void take_down(Trouble reason, const std::string& words, std::int64_t now_ns);
  void go_on_closing(std::int64_t now_ns);
  void bury();
  void end_when_closed();
  void say(const std::string& words);
  [[nodiscard]] std::int64_t next_step_ns(std::int64_t now_ns) const;

  LinkExchange& exchange_;
  LinkReader& reader_;
  const ImpulseEngineOptions options_;
  const hid::PortOpener open_port_;
  const HostClock& now_ns_;
  const StartWriter start_writer_;

  std::shared_ptr<hid::Port> port_;
  Phase phase_ = Phase::kLooking;
  Trouble reason_ = Trouble::kNotFound;
  std::uint32_t session_number_ = 0;
  std::optional<hid::Listing> known_;  // the device that was up
  bool known_describes_itself_ = false;
  std::optional<hid::Listing> tried_;
  std::shared_ptr<ReadSession> read_;
  std::optional<Writer> write_;
  std::vector<Writer> left_alone_;  // in a write that does not end
  int attempts_ = 0;
  std::int64_t back_off_ns_ = kFirstBackOffNs;
  std::int64_t next_attempt_ns_ = 0;
  std::int64_t since_ns_ = 0;  // start of the phase

  std::atomic<bool> stop_{false};
  std::atomic<Ending> ending_{Ending::kNotYet};
  std::atomic<Opening> opening_{Opening::kPending};

  mutable std::mutex mutex_;
  std::string words_;                                  // under the mutex
  std::optional<hid::DeviceDescription> description_;  // under the mutex
};

}  // namespace hapticwall::device
