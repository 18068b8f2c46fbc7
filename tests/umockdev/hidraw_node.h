// What is behind a node /dev/hidrawN that is not there: the kernel's side of hidraw, with the
// emulated firmware on the bus. In the emulator's virtual time.
//
// The node is a FIFO that holds one byte for every report that waits, so that poll() says what it
// would say of hidraw; reads, writes and ioctls are answered here. Used by the thread of a test and
// by the one that answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "tests/emulator/firmware/firmware_emulator.h"

namespace hapticwall::device::hid::testing {

// Result of a system call: a number and its bytes, or an errno.
struct Reply {
  long result = 0;
  int error = 0;
  std::vector<std::uint8_t> bytes;
};

class HidrawNode {
 public:
  // Reports that the kernel keeps for an open node. If the queue is full, the newest report is
  // lost.
  static constexpr std::size_t kKernelQueue = 63;

  // Makes `file`.
  HidrawNode(std::filesystem::path file, FirmwareEmulator emulator);
  HidrawNode(const HidrawNode&) = delete;
  HidrawNode& operator=(const HidrawNode&) = delete;
  ~HidrawNode();

  // Time passes on the bus; reports that come out of it wait to be read.
  void step(std::uint64_t microseconds);
  // Whatever `use` does with the emulator, it does alone.
  template <typename Use>
  auto with_emulator(Use use) {
    const std::lock_guard lock(mutex_);
    return use(emulator_);
  }
  // Unplugged for good: the node goes, and what has it open hears that there is no device.
  void pull();

  [[nodiscard]] Reply read(std::size_t room);
  [[nodiscard]] Reply write(std::span<const std::uint8_t> bytes);
  [[nodiscard]] Reply get_feature(std::uint8_t id, std::size_t room);

 private:
  [[nodiscard]] bool is_gone() const { return pulled_ || !emulator_.is_plugged(); }
  void put_token() const;

  const std::filesystem::path file_;
  int fifo_ = -1;
  std::mutex mutex_;
  FirmwareEmulator emulator_;
  std::deque<std::vector<std::uint8_t>> waiting_;
  bool pulled_ = false;
};

}  // namespace hapticwall::device::hid::testing
