// Finds a wheel, opens it, listens to it, closes it and looks again. Its thread keeps it alive, so
// that a wheel that hangs can be left alone.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "device/evdev/wheel_drive.h"
#include "device/evdev/wheel_node.h"
#include "device/hid/link.h"
#include "device/hid/link_loop.h"

namespace hapticwall::device {

// The machine's wheels; replaced in tests.
struct WheelPort {
  std::function<std::vector<evdev::WheelListing>()> list = evdev::list_wheels;
  evdev::OpenWheel open = evdev::open_wheel;
};

// The first wheel that the options ask for and that can be used. Fails with ErrorKind::kDevice.
[[nodiscard]] Result<evdev::WheelListing> choose_wheel(
    const std::vector<evdev::WheelListing>& wheels, const WheelOptions& options);

class WheelKeeper {
 public:
  WheelKeeper(WheelOptions options, WheelPort port, HostClock now_ns)
      : options_(std::move(options)), port_(std::move(port)), now_ns_(std::move(now_ns)) {}

  // The thread's body, to the end.
  void run();
  // Waits for the first link, at most five seconds: making a force may take some.
  [[nodiscard]] Failure wait_until_up();
  // Any thread. run() then takes the force away and ends, within about a second.
  void stop();

  [[nodiscard]] LinkLoop& loop() { return loop_; }
  // The force that the kernel took last. Realtime-safe: yes.
  [[nodiscard]] double taken_n() const { return exchange_.taken_n; }
  [[nodiscard]] std::string words() const;
  // Of the newest link that came up.
  [[nodiscard]] std::optional<DeviceInfo> info() const;

 private:
  struct Open;

  [[nodiscard]] Failure serve();
  void come_up(const evdev::WheelListing& listing, const WheelScale& scale);
  // True if the wheel is gone.
  [[nodiscard]] bool listen(Open& wheel);
  void publish(const Open& wheel, const evdev::WheelNews& news);
  void write(WheelWriter& writer);
  void say(const std::string& words, Trouble reason);
  void rest();

  WheelOptions options_;  // of one wheel, once it was up
  const WheelPort port_;
  const HostClock now_ns_;
  LinkExchange exchange_;
  LinkLoop loop_{exchange_, now_ns_};
  LinkView view_;
  std::uint32_t session_ = 0;
  std::int64_t looked_ns_ = 0;  // of the last look at the wheel

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> stop_{false};
  bool over_ = false;  // these under the mutex
  int failures_ = 0;
  std::string words_;
  std::optional<DeviceInfo> info_;
};

}  // namespace hapticwall::device
