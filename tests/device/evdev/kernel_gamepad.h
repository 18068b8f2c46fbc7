// A gamepad of this machine's kernel, made through /dev/uhid: an Xbox One S controller by
// Bluetooth, whose rumble the kernel's own driver (hid-microsoft) turns into output reports.
#pragma once

#include <fcntl.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>

namespace hapticwall::device::evdev::test {

// A game pad of 10 buttons, and an output report 3 of 8 bytes.
inline constexpr std::array<std::uint8_t, 43> kGamepadDescriptor{
    0x05, 0x01, 0x09, 0x05, 0xA1, 0x01,                          // application: game pad
    0x85, 0x01, 0x05, 0x09, 0x19, 0x01, 0x29, 0x0A, 0x15, 0x00,  // report 1: buttons 1 to 10
    0x25, 0x01, 0x75, 0x01, 0x95, 0x10, 0x81, 0x02,              // 16 bits
    0x85, 0x03, 0x06, 0x00, 0xFF, 0x09, 0x01, 0x15, 0x00,        // report 3: the maker's own
    0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x08, 0x91, 0x02,        // 8 bytes, output
    0xC0};

class KernelGamepad {
 public:
  static constexpr const char* kName = "Haptic Wall test pad";

  KernelGamepad() : descriptor_(::open("/dev/uhid", O_RDWR | O_CLOEXEC)) {
    uhid_event event{};
    event.type = UHID_CREATE2;
    uhid_create2_req& device = event.u.create2;
    std::memcpy(device.name, kName, std::strlen(kName));
    std::ranges::copy(kGamepadDescriptor, device.rd_data);
    device.rd_size = kGamepadDescriptor.size();
    device.bus = BUS_BLUETOOTH;
    device.vendor = 0x045E;
    device.product = 0x02FD;
    there_ = descriptor_ >= 0 && ::write(descriptor_, &event, sizeof event) > 0;
  }
  KernelGamepad(const KernelGamepad&) = delete;
  KernelGamepad& operator=(const KernelGamepad&) = delete;
  ~KernelGamepad() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  [[nodiscard]] bool there() const { return there_; }
  void unplug() {
    uhid_event event{};
    event.type = UHID_DESTROY;
    there_ = ::write(descriptor_, &event, sizeof event) < 0;
  }

  // What the motors are told next, in percent; nothing if they are told nothing for 2 s.
  struct Percent {
    int strong = 0;
    int weak = 0;
    friend bool operator==(const Percent&, const Percent&) = default;
  };
  [[nodiscard]] std::optional<Percent> next() const {
    uhid_event event{};
    pollfd waits{descriptor_, POLLIN, 0};
    while (::poll(&waits, 1, 2000) > 0 && ::read(descriptor_, &event, sizeof event) > 0) {
      // Report 3: which motors, left and right trigger, strong, weak, …
      if (event.type == UHID_OUTPUT && event.u.output.data[0] == 3)
        return Percent{event.u.output.data[4], event.u.output.data[5]};
    }
    return std::nullopt;
  }

 private:
  int descriptor_;
  bool there_ = false;
};

}  // namespace hapticwall::device::evdev::test
