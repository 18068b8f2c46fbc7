#include "device/evdev/event_node.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>
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

}  // namespace

std::string NodeListing::first_line(const std::string& file) const {
  std::ifstream in(std::string(kFolder) + "/" + event_ + "/device/" + file);
  std::string line;
  std::getline(in, line);
  return line;
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

}  // namespace hapticwall::device::evdev
