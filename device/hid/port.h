// The thin wrapper on hidapi, and what stands in its place in tests. Everything hidapi needs to be
// told or protected from is behind this: nothing else in the program includes it.
//
// Listing, opening and destruction of everything of one port happen on one thread, the owner's. A
// handle that is open is used by one thread at a time. Realtime-safe: no, none of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "device/hid_report.h"

namespace hapticwall::device::hid {

// A device as the operating system lists it.
struct Listing {
  std::string path;  // the only thing that open() takes
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string serial;
  std::string manufacturer;
  std::string product;
  std::uint16_t usage_page = 0;  // 0: not known (hidraw tells it of devices that may be opened)
  std::uint16_t usage = 0;

  friend bool operator==(const Listing&, const Listing&) = default;
};

enum class ReadKind : std::uint8_t {
  kReport,   // `size` bytes; 0 for an empty packet where the transport can tell it
  kNothing,  // none within the wait
  kFailed,   // the device is gone, or something else that will not pass
};
struct ReadOutcome {
  ReadKind kind = ReadKind::kNothing;
  std::size_t size = 0;
};

// One open device.
class Handle {
 public:
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  virtual ~Handle() = default;  // closed

  // The oldest report that waits, or the next one within `wait_ms` (0: without waiting). What does
  // not fit into `bytes` is cut off: give it more than a report.
  virtual ReadOutcome read(std::span<std::uint8_t> bytes, int wait_ms) = 0;
  // An output report. May block: five seconds have been seen. False where it failed.
  virtual bool write(const ReportBytes& bytes) = 0;
  // A feature report into `bytes`, whose first one becomes the id; how many came, 0 where it
  // failed.
  virtual std::size_t get_feature(std::uint8_t id, std::span<std::uint8_t> bytes) = 0;
};

// Why a listed device cannot be opened.
enum class Obstacle : std::uint8_t {
  kNone,
  kPermission,  // the user may not: the udev rule is missing
  kBusy,        // another program has it
  kGone,        // it is not there any more
};
// One line for people: what, and what would help. Empty for kNone.
[[nodiscard]] std::string obstacle_text(const std::string& path, Obstacle obstacle);

class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  // Every HID device, each path once. Fails where the transport does not work at all.
  [[nodiscard]] virtual Result<std::vector<Listing>> list() = 0;
  // `path` must be one of list()'s. Opened twice, a device gives two handles that two threads may
  // use at the same time: one handle must never be. The message of a failure is obstacle_text()
  // where that says it.
  [[nodiscard]] virtual Result<std::unique_ptr<Handle>> open(const std::string& path) = 0;
  // What an open() of one of list()'s paths would meet now; opens nothing. kBusy is only known by
  // trying.
  [[nodiscard]] virtual Obstacle obstacle(const std::string& path) = 0;
};

using PortOpener = std::function<Result<std::shared_ptr<Port>>()>;

// hidapi. One at a time in a process; fails while there is another one. All of its life on one
// thread.
[[nodiscard]] Result<std::unique_ptr<Port>> open_system_port();
// The transport that this program was built with: "hidraw" or "libusb".
[[nodiscard]] std::string_view transport_name();

// Listings that may be a device of this protocol: its usage page, or none told.
[[nodiscard]] bool may_be_haptic(const Listing& listing);

// The first listing of each path; where one path is listed with several usages, the protocol's own
// wins.
[[nodiscard]] std::vector<Listing> each_path_once(const std::vector<Listing>& listings);

}  // namespace hapticwall::device::hid
