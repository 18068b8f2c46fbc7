// A thin wrapper on hidapi, replaced in tests. No other file includes hidapi.
//
// One thread, the owner's, lists, opens and destroys. One thread at a time uses an open handle.
// Realtime-safe: no, none of it.
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
#include "device/link/report.h"

namespace hapticwall::device {
struct AxisDescription;
}

namespace hapticwall::device::hid {

// A device as the operating system lists it.
struct Listing {
  std::string path;  // for open()
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string serial;
  std::string manufacturer;
  std::string product;
  std::uint16_t usage_page = 0;  // 0: unknown (hidraw knows it if the device may be opened)
  std::uint16_t usage = 0;

  friend bool operator==(const Listing&, const Listing&) = default;
};

enum class ReadKind : std::uint8_t {
  kReport,   // `size` bytes; 0: an empty packet, if the transport reports it
  kNothing,  // none within the wait
  kFailed,   // permanent: the device is gone, for example
  kGone,     // unplugged, for certain: the link ends at once
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

  // The oldest queued report, or the next one within `wait_ms` (0: no wait). Longer reports are cut
  // to `bytes`: pass more than a report.
  virtual ReadOutcome read(std::span<std::uint8_t> bytes, int wait_ms) = 0;
  // An output report with its id, 0 if the reports have none. May block: five seconds were seen.
  // False on failure.
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;
  // Reads a feature report into `bytes`, of which the first becomes the id. Returns the number of
  // bytes; 0 on failure.
  virtual std::size_t get_feature(std::uint8_t id, std::span<std::uint8_t> bytes) = 0;
  // Earliest time of the next write() by the host's clock, nanoseconds: an earlier one would queue.
  [[nodiscard]] virtual std::int64_t free_ns() const { return 0; }
  // Adds to axis x of a device file the numbers that are known once the device is open.
  virtual void complete(AxisDescription& /*axis*/) const {}
};

// Why a listed device cannot be opened.
enum class Obstacle : std::uint8_t {
  kNone,
  kPermission,  // denied: the udev rule is missing
  kBusy,        // another program has it
  kGone,        // unplugged
};
// One line for people: problem and remedy. Empty for kNone.
[[nodiscard]] std::string obstacle_text(const std::string& path, Obstacle obstacle);
// obstacle_text() of kBusy, where the other host is known: "hapticwall (process 1234)".
[[nodiscard]] std::string in_use_text(const std::string& path, const std::string& host);

class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  // Every HID device, each path once. Fails if the transport does not work.
  [[nodiscard]] virtual Result<std::vector<Listing>> list() = 0;
  // `path` must come from list(). Two threads may use a device at the same time through two
  // handles, never through one. A known obstacle fails with its obstacle_text(), a device of
  // another host with its in_use_text() and without a word to the device. The handles of a path
  // keep other hosts out until the last one is closed.
  [[nodiscard]] virtual Result<std::unique_ptr<Handle>> open(const std::string& path) = 0;
  // The obstacle to an open() now, found without opening. Never kBusy: only open() knows.
  [[nodiscard]] virtual Obstacle obstacle(const std::string& path) = 0;
};

// Opens the transport. The owner calls it again after an error, at its next attempt.
using PortOpener = std::function<Result<std::shared_ptr<Port>>()>;

// hidapi. One port a process: fails while another one exists. Use it on one thread.
[[nodiscard]] Result<std::unique_ptr<Port>> open_system_port();
// The transport of this build: "hidraw" or "libusb".
[[nodiscard]] std::string_view transport_name();

// True if a listing has the protocol's usage page, or an unknown one.
[[nodiscard]] bool may_be_haptic(const Listing& listing);

// The first listing of each path; if a path has several usages, the protocol's one wins.
[[nodiscard]] std::vector<Listing> each_path_once(const std::vector<Listing>& listings);

}  // namespace hapticwall::device::hid
