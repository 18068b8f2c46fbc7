#include "tests/wheel_guest/usbip.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace hapticwall::wheel {
namespace {

constexpr std::size_t kHeaderBytes = 48;
constexpr std::size_t kSetupOffset = 40;
constexpr std::uint32_t kSubmit = 1;
constexpr std::uint32_t kUnlink = 2;
constexpr std::uint32_t kSubmitted = 3;
constexpr std::uint32_t kUnlinked = 4;
constexpr std::uint32_t kDeviceId = 0x10002;  // bus 1, device 2
constexpr int kFullSpeed = 2;

std::uint32_t number_at(std::span<const std::uint8_t> header, std::size_t index) {
  std::uint32_t value = 0;
  std::memcpy(&value, &header[4 * index], sizeof value);
  return ntohl(value);
}

}  // namespace

UsbBus::UsbBus() {
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
  std::ofstream attach("/sys/devices/platform/vhci_hcd.0/attach");
  attach << "0 " << ends[1] << ' ' << kDeviceId << ' ' << kFullSpeed << std::flush;
  ::close(ends[1]);  // the kernel has its own reference
  socket_ = ends[0];
  if (!attach) unplug();
}

void UsbBus::unplug() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

void hurry_bus(int priority) {
  std::error_code none;
  const sched_param fifo{priority};
  for (const auto& process : std::filesystem::directory_iterator("/proc", none)) {
    std::string name;
    std::getline(std::ifstream(process.path() / "comm") >> std::ws, name);
    if (!name.starts_with("vhci_")) continue;
    ::sched_setscheduler(std::stoi(process.path().filename()), SCHED_FIFO, &fifo);
  }
}

bool UsbBus::read_all(std::span<std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = ::read(socket_, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

bool UsbBus::take_all(const Control& control) {
  pollfd waits{socket_, POLLIN, 0};
  while (socket_ >= 0 && ::poll(&waits, 1, 0) > 0) {
    std::array<std::uint8_t, kHeaderBytes> header{};
    if (!read_all(header)) return false;
    Transfer transfer;
    transfer.number = number_at(header, 1);
    transfer.in = number_at(header, 3) == 1;
    transfer.endpoint = number_at(header, 4);
    transfer.length = number_at(header, 6);
    std::memcpy(transfer.setup.data(), &header[kSetupOffset], transfer.setup.size());
    if (number_at(header, 0) == kUnlink) {
      unlink(transfer.number, number_at(header, 5));
      continue;
    }
    if (number_at(header, 0) != kSubmit) return false;
    transfer.bytes.resize(transfer.in ? 0 : transfer.length);
    if (!read_all(transfer.bytes)) return false;
    if (transfer.endpoint != 0) {
      (transfer.in ? in_ : out_).push_back(transfer);
    } else if (auto answer = control(transfer)) {
      if (answer->size() > transfer.length) answer->resize(transfer.length);
      complete(transfer, 0, *answer);
    } else {
      complete(transfer, -EPIPE, {});
    }
  }
  return socket_ >= 0;
}

void UsbBus::unlink(std::uint32_t number, std::uint32_t target) {
  const auto is_it = [&](const Transfer& waiting) { return waiting.number == target; };
  const bool found = std::erase_if(in_, is_it) + std::erase_if(out_, is_it) > 0;
  reply(kUnlinked, number, found ? -ECONNRESET : 0, 0, {});
}

bool UsbBus::send(std::span<const std::uint8_t> bytes) {
  if (in_.empty()) return false;
  complete(in_.front(), 0, bytes);
  in_.pop_front();
  return true;
}

std::optional<std::vector<std::uint8_t>> UsbBus::receive() {
  if (out_.empty()) return std::nullopt;
  const Transfer transfer = std::move(out_.front());
  out_.pop_front();
  complete(transfer, 0, {});
  return transfer.bytes;
}

void UsbBus::complete(const Transfer& transfer, std::int32_t status,
                      std::span<const std::uint8_t> bytes) {
  const std::size_t length = transfer.in ? bytes.size() : transfer.bytes.size();
  reply(kSubmitted, transfer.number, status, static_cast<std::uint32_t>(length),
        transfer.in ? bytes : std::span<const std::uint8_t>());
}

void UsbBus::reply(std::uint32_t kind, std::uint32_t number, std::int32_t status,
                   std::uint32_t length, std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> message(kHeaderBytes);
  const auto put = [&](std::size_t index, std::uint32_t value) {
    const std::uint32_t sent = htonl(value);
    std::memcpy(&message[4 * index], &sent, sizeof sent);
  };
  put(0, kind);
  put(1, number);
  put(5, static_cast<std::uint32_t>(status));
  put(6, length);
  message.insert(message.end(), bytes.begin(), bytes.end());
  static_cast<void>(::send(socket_, message.data(), message.size(), MSG_NOSIGNAL));
}

}  // namespace hapticwall::wheel
