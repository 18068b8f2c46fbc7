#include "device/port/event_node.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

namespace hapticwall::device::evdev {
namespace {

constexpr const char* kFolder = "/sys/class/input";

Error last_error() { return device_error(std::generic_category().message(errno)); }

// "event9" is before "event10".
bool is_before(const std::string& left, const std::string& right) {
  return std::pair(left.size(), left) < std::pair(right.size(), right);
}

// "125us", "1ms", as the kernel writes the interval of an endpoint; 0: something else.
double rate_of(const std::string& interval) {
  std::istringstream text(interval);
  double number = 0.0;
  std::string unit;
  if (!(text >> number >> unit) || number <= 0.0) return 0.0;
  return (unit == "ms" ? 1e3 : unit == "us" ? 1e6 : 0.0) / number;
}

std::string line_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace

std::string NodeListing::first_line(const std::string& file) const {
  return line_of(std::string(kFolder) + "/" + event_ + "/device/" + file);
}

std::string NodeListing::name() const { return first_line("name"); }

// Words in hexadecimal, the highest first.
bool NodeListing::has(const std::string& type, unsigned code) const {
  constexpr unsigned kBits = std::numeric_limits<unsigned long>::digits;
  std::istringstream text(first_line("capabilities/" + type));
  std::vector<unsigned long> words;
  for (unsigned long word = 0; text >> std::hex >> word;) words.push_back(word);
  const std::size_t from_last = code / kBits + 1;
  return from_last <= words.size() &&
         ((words[words.size() - from_last] >> (code % kBits)) & 1U) != 0;
}

std::uint16_t NodeListing::id(const std::string& which) const {
  std::istringstream text(first_line("id/" + which));
  std::uint16_t number = 0;
  text >> std::hex >> number;
  return number;
}

std::string NodeListing::serial() const { return first_line("uniq"); }

// event7/device is the input device, its device a HID device in the folder of the USB interface.
double NodeListing::output_rate_hz() const {
  std::error_code none;
  const auto hid =
      std::filesystem::canonical(std::string(kFolder) + "/" + event_ + "/device/device", none);
  for (const auto& entry : std::filesystem::directory_iterator(hid.parent_path(), none)) {
    const bool is_endpoint = entry.path().filename().string().starts_with("ep_");
    if (is_endpoint && line_of(entry.path() / "direction") == "out")
      return rate_of(line_of(entry.path() / "interval"));
  }
  return 0.0;
}

std::vector<NodeListing> list_nodes() {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder, none)) {
    std::string name = entry.path().filename();
    if (name.starts_with("event")) names.push_back(std::move(name));
  }
  std::ranges::sort(names, is_before);
  return {names.begin(), names.end()};
}

Result<EventNode> EventNode::open(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 && errno == EACCES)
    return device_error("a udev rule or the group 'input' must permit it");
  if (descriptor < 0) return last_error();
  return EventNode(descriptor);
}

EventNode::EventNode(EventNode&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

EventNode::~EventNode() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Failure EventNode::upload(ff_effect& effect) const {
  if (::ioctl(descriptor_, EVIOCSFF, &effect) < 0) return last_error();
  return std::nullopt;
}

Failure EventNode::write(std::uint16_t type, std::uint16_t code, std::int32_t value) const {
  input_event event{};
  event.type = type;
  event.code = code;
  event.value = value;
  if (::write(descriptor_, &event, sizeof event) < 0) return last_error();
  return std::nullopt;
}

Failure EventNode::grab() const {
  if (::ioctl(descriptor_, EVIOCGRAB, 1) < 0) return last_error();
  return std::nullopt;
}

Failure EventNode::use_monotonic_clock() const {
  int clock = CLOCK_MONOTONIC;
  if (::ioctl(descriptor_, EVIOCSCLOCKID, &clock) < 0) return last_error();
  return std::nullopt;
}

Failure EventNode::get_axis(unsigned code, input_absinfo& axis) const {
  if (::ioctl(descriptor_, EVIOCGABS(code), &axis) < 0) return last_error();
  return std::nullopt;
}

Failure EventNode::set_axis(unsigned code, const input_absinfo& axis) const {
  if (::ioctl(descriptor_, EVIOCSABS(code), &axis) < 0) return last_error();
  return std::nullopt;
}

Result<EventNode::Events> EventNode::drain(int wait_ms, unsigned code) const {
  Events events;
  pollfd waits{descriptor_, POLLIN, 0};
  if (::poll(&waits, 1, wait_ms) <= 0) return events;
  std::array<input_event, 64> buffer{};
  const ssize_t bytes = ::read(descriptor_, buffer.data(), sizeof buffer);
  if (bytes < 0 && errno != EAGAIN && errno != EINTR) return last_error();
  const auto count = static_cast<std::size_t>(std::max<ssize_t>(bytes, 0)) / sizeof(input_event);
  for (const input_event& event : std::span(buffer).first(count)) {
    if (event.type != EV_ABS || event.code != code) continue;
    ++events.count;
    events.last_ns = std::int64_t{event.input_event_sec} * 1'000'000'000 +
                     std::int64_t{event.input_event_usec} * 1000;
  }
  return events;
}

}  // namespace hapticwall::device::evdev
