// A device on the kernel's virtual USB bus (vhci_hcd), by the messages of USB/IP. Linux; needs
// root.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hapticwall::wheel {

// A transfer that the host asks for.
struct Transfer {
  std::uint32_t number = 0;
  bool in = false;
  std::uint32_t endpoint = 0;
  std::uint32_t length = 0;  // max length of IN
  std::array<std::uint8_t, 8> setup{};
  std::vector<std::uint8_t> bytes;  // data of OUT
};

class UsbBus {
 public:
  // Attaches a full-speed device. there() tells whether it worked.
  UsbBus();
  UsbBus(const UsbBus&) = delete;
  UsbBus& operator=(const UsbBus&) = delete;
  ~UsbBus() { unplug(); }
  [[nodiscard]] bool there() const { return socket_ >= 0; }
  void unplug();

  // Takes what the host sent. `control` answers endpoint 0: the bytes of an IN transfer, or nullopt
  // for a stall. False once the bus is gone.
  using Control = std::function<std::optional<std::vector<std::uint8_t>>(const Transfer&)>;
  bool take_all(const Control& control);
  // Completes the oldest waiting IN transfer; false if none waits.
  bool send(std::span<const std::uint8_t> bytes);
  // Completes the oldest waiting OUT transfer and returns its bytes.
  std::optional<std::vector<std::uint8_t>> receive();

 private:
  bool read_all(std::span<std::uint8_t> bytes);
  void unlink(std::uint32_t number, std::uint32_t target);
  void complete(const Transfer& transfer, std::int32_t status, std::span<const std::uint8_t> bytes);
  void reply(std::uint32_t kind, std::uint32_t number, std::int32_t status, std::uint32_t length,
             std::span<const std::uint8_t> bytes);

  int socket_ = -1;
  std::deque<Transfer> in_;
  std::deque<Transfer> out_;
};

// Gives the kernel's threads of the virtual bus this real-time priority: a real bus waits for no
// program.
void hurry_bus(int priority);

}  // namespace hapticwall::wheel
