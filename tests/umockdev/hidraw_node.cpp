#include "tests/umockdev/hidraw_node.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace hapticwall::device::hid::testing {
namespace {

constexpr mode_t kMode = 0600;

Reply failure(int error) { return {-1, error, {}}; }

Reply as_much_as_fits(std::vector<std::uint8_t> bytes, std::size_t room) {
  bytes.resize(std::min(bytes.size(), room));
  const auto size = static_cast<long>(bytes.size());
  return {size, 0, std::move(bytes)};
}

}  // namespace

HidrawNode::HidrawNode(std::filesystem::path file, FirmwareEmulator emulator)
    : file_(std::move(file)), emulator_(std::move(emulator)) {
  if (::mkfifo(file_.c_str(), kMode) == 0) {
    fifo_ = ::open(file_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  if (fifo_ < 0) throw std::system_error(errno, std::generic_category(), file_.string());
}

HidrawNode::~HidrawNode() { ::close(fifo_); }

void HidrawNode::put_token() const {
  const char token = 0;
  if (::write(fifo_, &token, 1) != 1) throw std::runtime_error("the FIFO of a node is full");
}

void HidrawNode::step(std::uint64_t microseconds) {
  const std::lock_guard lock(mutex_);
  const bool was_gone = is_gone();
  emulator_.step(microseconds);
  while (const auto report = emulator_.take_input()) {
    if (waiting_.size() == kKernelQueue) continue;
    waiting_.emplace_back(report->view().begin(), report->view().end());
    put_token();
  }
  if (!was_gone && is_gone()) put_token();  // wakes whoever waits
}

void HidrawNode::pull() {
  const std::lock_guard lock(mutex_);
  std::filesystem::remove(file_);
  pulled_ = true;
  put_token();
}

Reply HidrawNode::read(std::size_t room) {
  const std::lock_guard lock(mutex_);
  if (is_gone()) return failure(EIO);
  char token = 0;
  if (waiting_.empty() || ::read(fifo_, &token, 1) != 1) return failure(EAGAIN);
  std::vector<std::uint8_t> report = std::move(waiting_.front());
  waiting_.pop_front();
  return as_much_as_fits(std::move(report), room);
}

// If the endpoint takes nothing, the kernel waits for five seconds and then returns ETIMEDOUT; a
// test does not wait.
Reply HidrawNode::write(std::span<const std::uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  if (is_gone()) return failure(ENODEV);
  if (!emulator_.write_output(bytes)) return failure(ETIMEDOUT);
  return {static_cast<long>(bytes.size()), 0, {}};
}

Reply HidrawNode::get_feature(std::uint8_t id, std::size_t room) {
  const std::lock_guard lock(mutex_);
  if (is_gone()) return failure(ENODEV);
  const auto report = emulator_.get_feature(id);
  if (!report) return failure(EPIPE);
  return as_much_as_fits({report->begin(), report->end()}, room);
}

}  // namespace hapticwall::device::hid::testing
