// What the owner's thread does: look for the device, open it, watch the link, close it, look again.
// The only one that lists, opens and closes.
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
#include "device/hid_description.h"
#include "device/hid_port.h"
#include "device/link_exchange.h"
#include "device/link_options.h"
#include "device/link_reader.h"
#include "device/link_writer.h"

namespace hapticwall::device {

// Times of the owner.
inline constexpr std::int64_t kMillisecondNs = 1'000'000;
inline constexpr std::int64_t kFirstBackOffNs = 50 * kMillisecondNs;
inline constexpr std::int64_t kLongestBackOffNs = 1000 * kMillisecondNs;
// How long an opened device may take until its first valid state.
inline constexpr std::int64_t kFirstStateNs = 200 * kMillisecondNs;
// How long the last command may take before its writer is left alone.
inline constexpr std::int64_t kLastCommandNs = 100 * kMillisecondNs;
// So often is it tried before the first link-up; after that for ever.
inline constexpr int kAttemptsToOpen = 4;

enum class Opening : std::uint8_t { kPending, kUp, kFailed };

enum class Ending : std::uint8_t {
  kNotYet,
  kLeftAlone,  // all is closed but what is in a write that does not end
  kEnded       // all is closed
};

class LinkOwner {
 public:
  // Runs a writer for the session, on a thread of its own; what it returns is called once the
  // session is done, and joins that thread.
  using StartWriter = std::function<std::function<void()>(std::shared_ptr<WriteSession>)>;

  LinkOwner(LinkExchange& exchange, LinkReader& reader, ImpulseEngineOptions options,
            hid::PortOpener open_port, const HostClock& now_ns, StartWriter start_writer);

  // The owner's thread: does what there is to do, and returns when it wants to be called again
  // (host's clock). Waits for nothing but the transport.
  std::int64_t step();

  // Any thread. From the next step on the link is taken down, and not brought up again.
  void stop() { stop_.store(true, std::memory_order_release); }
  [[nodiscard]] Ending ending() const { return ending_.load(std::memory_order_acquire); }
  // How the first link-up went: kFailed and kUp stay.
  [[nodiscard]] Opening opening() const { return opening_.load(std::memory_order_acquire); }
  // One line: what trouble there is, in words; empty where there is none.
  [[nodiscard]] std::string words() const;
  // Of the link that came up last.
  [[nodiscard]] std::optional<hid::DeviceFigures> figures() const;

 private:
  enum class Phase : std::uint8_t { kLooking, kStarting, kUp, kClosing };
  struct Writer {
    std::shared_ptr<WriteSession> session;
    std::function<void()> join;
  };

  void look(std::int64_t now_ns);
  [[nodiscard]] Failure bring_up(std::int64_t now_ns);
  void start(const hid::Listing& listing, const hid::DeviceFigures& figures,
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
  std::int64_t since_ns_ = 0;  // of the phase

  std::atomic<bool> stop_{false};
  std::atomic<Ending> ending_{Ending::kNotYet};
  std::atomic<Opening> opening_{Opening::kPending};

  mutable std::mutex mutex_;
  std::string words_;                          // under the mutex
  std::optional<hid::DeviceFigures> figures_;  // under the mutex
};

}  // namespace hapticwall::device
