// hidapi behind the port. Four defects of hidapi shape this file:
// * Reading and writing one handle from two threads frees its error text twice after an unplug. On
//   hidraw each open() gives a new handle; on libusb only one is possible, so a mutex guards it.
// * List, open and close use global state without a lock: one thread and one port at a time.
// * A path that was not listed can crash it.
// * A hidraw node that does not answer as one is read after it was freed (0.13).
#include <fcntl.h>
#include <hidapi.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "core/text.h"
#include "device/link/port.h"
#include "device/port/node_lock.h"

namespace hapticwall::device::hid {
namespace {

constexpr std::string_view kTransport = HAPTICWALL_HIDAPI;
constexpr bool kIsLibusb = kTransport == "libusb";
static_assert(kIsLibusb || kTransport == "hidraw", "HAPTICWALL_HIDAPI is hidraw or libusb");

// Poll interval of a reader that shares its handle with a writer.
constexpr std::chrono::microseconds kSharedPoll{250};

struct CloseDevice {
  void operator()(hid_device* device) const { hid_close(device); }
};
using OpenDevice = std::unique_ptr<hid_device, CloseDevice>;

// An open device, which two handles may share.
struct SharedDevice {
  std::shared_ptr<NodeLock> lock;  // released after the device is closed
  OpenDevice device;
  std::mutex mutex;
  // Set when one of the two handles has closed: no new handle may share the device.
  std::atomic<bool> closing{false};
};

ReadOutcome outcome_of(int result) {
  if (result < 0) return {ReadKind::kFailed, 0};
  // hidapi does not distinguish a time-out from an empty packet.
  if (result == 0) return {ReadKind::kNothing, 0};
  return {ReadKind::kReport, static_cast<std::size_t>(result)};
}

class HidapiHandle : public Handle {
 public:
  explicit HidapiHandle(std::shared_ptr<SharedDevice> shared) : shared_(std::move(shared)) {}
  ~HidapiHandle() override { shared_->closing = true; }

  ReadOutcome read(std::span<std::uint8_t> bytes, int wait_ms) override {
    if constexpr (!kIsLibusb) return outcome_of(read_now(bytes, wait_ms));
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(wait_ms);
    while (true) {
      const int result = read_now(bytes, 0);
      if (result != 0 || std::chrono::steady_clock::now() >= end) return outcome_of(result);
      std::this_thread::sleep_for(kSharedPoll);
    }
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    const std::lock_guard lock(shared_->mutex);
    return hid_write(shared_->device.get(), bytes.data(), bytes.size()) ==
           static_cast<int>(bytes.size());
  }

  std::size_t get_feature(std::uint8_t id, std::span<std::uint8_t> bytes) override {
    if (bytes.empty()) return 0;
    bytes[0] = id;
    const std::lock_guard lock(shared_->mutex);
    const int size = hid_get_feature_report(shared_->device.get(), bytes.data(), bytes.size());
    return static_cast<std::size_t>(std::max(size, 0));
  }

 private:
  // A write that does not end must not look like a reader that was held up.
  int read_now(std::span<std::uint8_t> bytes, int wait_ms) {
    const std::unique_lock lock(shared_->mutex, std::try_to_lock);
    if (!lock) return 0;
    return hid_read_timeout(shared_->device.get(), bytes.data(), bytes.size(), wait_ms);
  }

  std::shared_ptr<SharedDevice> shared_;
};

// The device file to open. The path of hidraw is that file. The path of libusb ("1-4.2:1.0") is a
// name in sysfs, where the bus and device numbers are found.
std::string node_of(const std::string& path) {
  if constexpr (!kIsLibusb) return path;
  const std::string folder = "/sys/bus/usb/devices/" + path.substr(0, path.find(':'));
  const auto three_digits = [&](const char* name) {
    std::string number;
    std::ifstream(folder + "/" + name) >> number;
    return std::string(3 - std::min<std::size_t>(number.size(), 3), '0') + number;
  };
  return "/dev/bus/usb/" + three_digits("busnum") + "/" + three_digits("devnum");
}

Obstacle obstacle_at(const std::string& path) {
  if (faccessat(AT_FDCWD, node_of(path).c_str(), R_OK | W_OK, AT_EACCESS) == 0) {
    return Obstacle::kNone;
  }
  return errno == EACCES || errno == EPERM ? Obstacle::kPermission : Obstacle::kGone;
}

// The first question that hidapi asks of an open node.
bool answers_as_hid(const std::string& path) {
  if constexpr (kIsLibusb) return true;
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
  int size = 0;
  const bool answers = descriptor >= 0 && ::ioctl(descriptor, HIDIOCGRDESCSIZE, &size) == 0;
  if (descriptor >= 0) ::close(descriptor);
  return answers;
}

Listing listing_of(const hid_device_info& info) {
  Listing listing;
  listing.path = info.path;
  listing.vendor_id = info.vendor_id;
  listing.product_id = info.product_id;
  listing.serial = to_utf8(info.serial_number);
  listing.manufacturer = to_utf8(info.manufacturer_string);
  listing.product = to_utf8(info.product_string);
  listing.usage_page = info.usage_page;
  listing.usage = info.usage;
  return listing;
}

std::atomic<bool>& port_exists() {
  static std::atomic<bool> exists{false};
  return exists;
}

class HidapiPort : public Port {
 public:
  HidapiPort() = default;
  ~HidapiPort() override {
    hid_exit();
    port_exists() = false;
  }

  Result<std::vector<Listing>> list() override {
    std::vector<Listing> listings;
    hid_device_info* const first = hid_enumerate(0, 0);
    for (const hid_device_info* info = first; info != nullptr; info = info->next) {
      if (info->path != nullptr && info->path[0] != '\0') listings.push_back(listing_of(*info));
    }
    hid_free_enumeration(first);
    listings = each_path_once(listings);
    listed_.clear();
    for (const Listing& listing : listings) listed_.insert(listing.path);
    return listings;
  }

  Result<std::unique_ptr<Handle>> open(const std::string& path) override {
    if (!listed_.contains(path)) {
      return device_error(path + " is not in the list of HID devices");
    }
    if (auto shared = shared_device(path)) return handle_on(std::move(shared));
    if (const Obstacle obstacle = obstacle_at(path); obstacle != Obstacle::kNone) {
      return device_error(obstacle_text(path, obstacle));
    }
    auto lock = lock_of(path);
    if (!lock) return lock.error();
    auto shared = std::make_shared<SharedDevice>();
    shared->lock = *lock;
    if (!answers_as_hid(path)) return not_opened(path, "it does not answer as a HID device");
    shared->device.reset(hid_open_path(path.c_str()));
    if (!shared->device) return not_opened(path, to_utf8(hid_error(nullptr)));
    open_[path] = shared;
    return handle_on(std::move(shared));
  }

  Obstacle obstacle(const std::string& path) override { return obstacle_at(path); }

 private:
  static Result<std::unique_ptr<Handle>> handle_on(std::shared_ptr<SharedDevice> shared) {
    return std::unique_ptr<Handle>(std::make_unique<HidapiHandle>(std::move(shared)));
  }

  // The lock that this process's handles hold, if any; else a new one.
  Result<std::shared_ptr<NodeLock>> lock_of(const std::string& path) {
    const std::string node = node_of(path);
    auto held = locks_[path].lock();
    if (held && held->is_of(node)) return held;
    auto taken = NodeLock::take(node, path);
    if (taken) locks_[path] = *taken;
    return taken;
  }

  // The device that is open at that path, on libusb; else nullptr.
  std::shared_ptr<SharedDevice> shared_device(const std::string& path) {
    if constexpr (!kIsLibusb) return nullptr;
    const auto found = open_.find(path);
    std::shared_ptr<SharedDevice> shared = found == open_.end() ? nullptr : found->second.lock();
    return shared && !shared->closing ? shared : nullptr;
  }

  static Error not_opened(const std::string& path, const std::string& reason) {
    const Obstacle now = obstacle_at(path);
    if (now != Obstacle::kNone) return device_error(obstacle_text(path, now));
    if (kIsLibusb) return device_error(obstacle_text(path, Obstacle::kBusy));
    return device_error(path + " cannot be opened: " + reason);
  }

  std::set<std::string> listed_;
  std::map<std::string, std::weak_ptr<SharedDevice>> open_;
  std::map<std::string, std::weak_ptr<NodeLock>> locks_;
};

}  // namespace

Result<std::unique_ptr<Port>> open_system_port() {
  if (port_exists().exchange(true)) {
    return device_error(
        "the HID transport is in use by this program: end its other session, or wait a few "
        "seconds until its last write has ended");
  }
  if (hid_init() != 0) {
    port_exists() = false;
    return device_error("the HID transport (" + std::string(kTransport) +
                        ") does not work on this machine");
  }
  return std::unique_ptr<Port>(std::make_unique<HidapiPort>());
}

std::string_view transport_name() { return kTransport; }

}  // namespace hapticwall::device::hid
