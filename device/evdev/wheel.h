// A force-feedback wheel or stick as a device: Linux, docs/wheels.md.
//
// Two threads serve it. The keeper finds, opens and closes it, and listens: the kernel tells of
// changes only, so silence is rest. The writer sends the newest force and may block. The loop only
// exchanges values with them, through the LinkLoop of every real device.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "device/device.h"
#include "device/evdev/wheel_keeper.h"

namespace hapticwall::device {

class Wheel final : public Device {
 public:
  Wheel(WheelOptions options, WheelPort port, HostClock now_ns);
  ~Wheel() override;

  [[nodiscard]] DeviceInfo info() const override;
  // Waits for the first position, at most five seconds. Fails with ErrorKind::kDevice.
  [[nodiscard]] Failure open() override;
  [[nodiscard]] DeviceReading read() override;
  void write(double force_n) override;
  void enable(bool enabled) override;
  [[nodiscard]] LinkStats link() const override;
  // Takes at most about a second; a wheel that hangs is left alone.
  void close() override;
  [[nodiscard]] std::string trouble_details() const override;

 private:
  [[nodiscard]] std::shared_ptr<WheelKeeper> keeper() const;
  void set_keeper(std::shared_ptr<WheelKeeper> keeper);

  WheelOptions options_;
  WheelPort port_;
  HostClock now_ns_;
  // nullptr: not open. Changed under the mutex, by the thread that calls open() and close().
  std::shared_ptr<WheelKeeper> keeper_;
  mutable std::mutex keeper_mutex_;
};

// On this machine's wheels and clock.
[[nodiscard]] std::unique_ptr<Wheel> make_wheel(const WheelOptions& options);

}  // namespace hapticwall::device
