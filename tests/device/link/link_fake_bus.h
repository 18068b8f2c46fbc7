// A HID bus with emulated devices in virtual time, behind the same port as hidapi. One thread.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "device/link/link.h"
#include "device/link/port.h"
#include "tests/device/port/foreign_board.h"
#include "tests/emulator/firmware/firmware_emulator.h"

namespace hapticwall::device::hid::testing {

class FakeHandle;

// One place on the bus, as the operating system shows it.
struct Plug {
  Plug(Listing its_listing, const EmulatorSettings& settings, FaultScript script = {})
      : listing(std::move(its_listing)), device(settings, std::move(script)) {}

  Listing listing;
  FirmwareEmulator device;
  bool hidden = false;            // not on the bus
  bool denied = false;            // listed, but cannot be opened
  bool bridged = false;           // behind a powered bridge: handles survive an unplug
  bool tells_empty = false;       // an empty packet is not silence
  bool feature_is_void = false;   // INFO arrives with a bit flipped
  bool feature_is_newer = false;  // INFO of the next major version
  bool feature_is_missing = false;
  bool writes_hang = false;  // no write to it returns, unplugged or not
  int listed_times = 1;
  std::vector<FakeHandle*> handles;       // open ones
  std::unique_ptr<ForeignBoard> foreign;  // replaces the device that speaks the protocol

  [[nodiscard]] bool is_there() const { return !hidden && (bridged || device.is_plugged()); }
  [[nodiscard]] bool accepts_output() const {
    return foreign ? !foreign->blocks : device.accepts_output();
  }
  bool write_output(std::span<const std::uint8_t> bytes) {
    return foreign ? foreign->take(bytes) : device.write_output(bytes);
  }
  // Moves to this instant; returns the reports that come out of it.
  std::vector<InputReport> move_to(std::uint64_t time_us) {
    std::vector<InputReport> reports;
    const std::uint64_t before_ms = device.now_us() / 1000;
    device.step(time_us - device.now_us());
    while (const auto report = device.take_input()) reports.push_back(*report);
    if (!foreign) return reports;
    reports.clear();
    for (std::uint64_t ms = before_ms; ms < time_us / 1000; ++ms) {
      for (const Bytes& bytes : foreign->tick()) {
        InputReport& report = reports.emplace_back(InputReport{time_us, bytes.size(), {}});
        std::copy(bytes.begin(), bytes.end(), report.bytes.begin());
      }
    }
    return reports;
  }
};

inline Listing usual_listing(const std::string& path = "/dev/hidraw0",
                             const std::string& serial = "0001") {
  Listing listing;
  listing.path = path;
  listing.vendor_id = kTestVendorId;
  listing.product_id = kTestProductId;
  listing.serial = serial;
  listing.product = "Emulated device";
  listing.usage_page = kUsagePage;
  listing.usage = kUsage;
  return listing;
}

// A device of another usage page.
inline Listing foreign_listing(const ImpulseEngineOptions& options) {
  Listing listing = usual_listing();
  listing.vendor_id = options.vendor_id;
  listing.product_id = options.product_id;
  listing.usage_page = 0xFFAB;
  listing.usage = 0x0200;
  return listing;
}

class FakeHandle : public Handle {
 public:
  // Depth of the kernel's queue, which keeps the oldest.
  static constexpr std::size_t kQueue = 63;

  FakeHandle(Plug& plug, const void* host) : host_(host), plug_(plug) {
    plug_.handles.push_back(this);
  }
  ~FakeHandle() override { std::erase(plug_.handles, this); }

  ReadOutcome read(std::span<std::uint8_t> bytes, int /*wait_ms*/) override {
    if (!alive_) return {ReadKind::kFailed, 0};
    if (queue_.empty()) return {};
    const InputReport report = queue_.front();
    queue_.pop_front();
    if (report.size == 0 && !plug_.tells_empty) return {};
    const std::size_t size = std::min(bytes.size(), report.size);
    std::copy_n(report.bytes.begin(), size, bytes.begin());
    return {ReadKind::kReport, size};
  }

  // True if a write would return at once.
  [[nodiscard]] bool write_returns() const {
    return !plug_.writes_hang && (!alive_ || plug_.accepts_output());
  }
  bool write(std::span<const std::uint8_t> bytes) override {
    return alive_ && plug_.write_output(bytes);
  }

  std::size_t get_feature(std::uint8_t id, std::span<std::uint8_t> bytes) override {
    auto report = alive_ ? plug_.device.get_feature(id) : std::nullopt;
    if (!report || plug_.feature_is_missing) return 0;
    if (plug_.feature_is_newer) {
      (*report)[1] = (kProtocolMajor + 1) << 4U;
      seal(*report);
    }
    if (plug_.feature_is_void) report->back() ^= 1U;
    const std::size_t size = std::min(bytes.size(), report->size());
    std::copy_n(report->begin(), size, bytes.begin());
    return size;
  }

  void push(const InputReport& report) {
    if (queue_.size() < kQueue) queue_.push_back(report);
  }
  void unplug() { alive_ = false; }
  [[nodiscard]] bool is_alive() const { return alive_; }
  [[nodiscard]] bool is_of(const void* host) const { return host_ == host; }

 private:
  const void* host_;
  Plug& plug_;
  std::deque<InputReport> queue_;
  bool alive_ = true;
};

class FakeBus {
 public:
  Plug& add(Listing listing, const EmulatorSettings& settings, FaultScript script = {}) {
    plugs_.push_back(std::make_unique<Plug>(std::move(listing), settings, std::move(script)));
    return *plugs_.back();
  }

  // Every device to the same instant; reports go to whoever has it open.
  void move_to(std::uint64_t time_us) {
    for (const auto& plug : plugs_) {
      for (const InputReport& report : plug->move_to(time_us)) {
        for (FakeHandle* handle : plug->handles) {
          if (handle->is_alive()) handle->push(report);
        }
      }
      if (plug->is_there()) continue;
      for (FakeHandle* handle : plug->handles) handle->unplug();
    }
  }

  [[nodiscard]] std::size_t open_handles() const {
    std::size_t count = 0;
    for (const auto& plug : plugs_) count += plug->handles.size();
    return count;
  }
  [[nodiscard]] const std::vector<std::unique_ptr<Plug>>& plugs() const { return plugs_; }

  int lists = 0;  // how often it was asked

 private:
  std::vector<std::unique_ptr<Plug>> plugs_;
};

class FakePort : public Port {
 public:
  explicit FakePort(FakeBus& bus) : bus_(bus) {}

  Result<std::vector<Listing>> list() override {
    ++bus_.lists;
    std::vector<Listing> listings;
    for (const auto& plug : bus_.plugs()) {
      if (!plug->is_there()) continue;
      for (int i = 0; i < plug->listed_times; ++i) listings.push_back(plug->listing);
    }
    for (const Listing& listing : listings) listed_.insert(listing.path);
    return listings;
  }

  Result<std::unique_ptr<Handle>> open(const std::string& path) override {
    // Fail the test where hidapi would crash.
    if (!listed_.contains(path)) ++never_listed;
    if (const Obstacle found = obstacle(path); found != Obstacle::kNone) {
      return Error{ErrorKind::kDevice, obstacle_text(path, found)};
    }
    Plug& plug = *plug_at(path);
    // An unplugged handle locks a node that is no longer there.
    const bool taken = std::ranges::any_of(plug.handles, [this](const FakeHandle* handle) {
      return handle->is_alive() && !handle->is_of(this);
    });
    if (taken) return Error{ErrorKind::kDevice, in_use_text(path, "another host")};
    return std::unique_ptr<Handle>(std::make_unique<FakeHandle>(plug, this));
  }

  Obstacle obstacle(const std::string& path) override {
    const Plug* plug = plug_at(path);
    if (plug == nullptr) return Obstacle::kGone;
    return plug->denied ? Obstacle::kPermission : Obstacle::kNone;
  }

  int never_listed = 0;

 private:
  [[nodiscard]] Plug* plug_at(const std::string& path) const {
    for (const auto& plug : bus_.plugs()) {
      if (plug->is_there() && plug->listing.path == path) return plug.get();
    }
    return nullptr;
  }

  FakeBus& bus_;
  std::set<std::string> listed_;
};

}  // namespace hapticwall::device::hid::testing
