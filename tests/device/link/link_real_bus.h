// A bus with one emulated device for real threads. It follows the link's clock; tests unplug and
// block it.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "device/link/port.h"
#include "device/os_threads.h"
#include "tests/device/emulator/emulator_support.h"
#include "tests/device/link/link_fake_bus.h"
#include "tests/emulator/firmware/firmware_emulator.h"

namespace hapticwall::device::hid::testing {

// Ten times slower than real time, because test machines may delay a thread by 20 ms.
inline std::int64_t slow_ns() {
  constexpr std::int64_t kSlowness = 10;
  return monotonic_ns() / kSlowness;
}

class RealBus {
 public:
  RealBus() : device_(two_axes()), begin_ns_(slow_ns()) {}

  // Actions of a test on the bus.
  void plug(bool plugged) {
    const std::lock_guard lock(mutex_);
    plugged_ = plugged;
    if (!plugged) ++life_;
  }
  void block(bool blocked) {
    const std::lock_guard lock(mutex_);
    blocked_ = blocked;
    changed_.notify_all();
  }
  [[nodiscard]] int open_handles() const { return count(open_handles_); }
  [[nodiscard]] int blocked_writes() const { return count(blocked_writes_); }
  // Threads that listed, opened or closed since the last call.
  [[nodiscard]] std::size_t take_owners() {
    const std::lock_guard lock(mutex_);
    const std::size_t count = owners_.size();
    owners_.clear();
    return count;
  }
  [[nodiscard]] double force_n() {
    const std::lock_guard lock(mutex_);
    move();
    return device_.amplifier_force_n()[0];
  }

  // Actions of a port and its handles.
  [[nodiscard]] bool is_plugged() {
    const std::lock_guard lock(mutex_);
    owners_.insert(std::this_thread::get_id());
    return plugged_;
  }
  int open() {
    const std::lock_guard lock(mutex_);
    owners_.insert(std::this_thread::get_id());
    ++open_handles_;
    return life_;
  }
  void close() {
    const std::lock_guard lock(mutex_);
    owners_.insert(std::this_thread::get_id());
    --open_handles_;
  }
  // False where the handle is of an earlier life.
  bool read(int life, std::uint64_t& seen, InputReport& report, bool& found) {
    const std::lock_guard lock(mutex_);
    move();
    found = newest_ && number_ > seen;
    if (found) report = *newest_, seen = number_;
    return life == life_;
  }
  bool write(int life, std::span<const std::uint8_t> bytes) {
    std::unique_lock lock(mutex_);
    ++blocked_writes_;
    changed_.wait(lock, [this] { return !blocked_; });
    --blocked_writes_;
    move();
    return life == life_ && device_.write_output(bytes);
  }
  std::optional<ReportBytes> info() {
    const std::lock_guard lock(mutex_);
    return device_.get_feature(kInfoId);
  }

 private:
  [[nodiscard]] int count(const int& number) const {
    const std::lock_guard lock(mutex_);
    return number;
  }
  void move() {
    const auto now_us = static_cast<std::uint64_t>((slow_ns() - begin_ns_) / 1000);
    device_.step(now_us - device_.now_us());
    while (const auto report = device_.take_input()) {
      newest_ = *report;
      ++number_;
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  FirmwareEmulator device_;
  const std::int64_t begin_ns_;
  bool plugged_ = true;
  bool blocked_ = false;
  int life_ = 0;
  int open_handles_ = 0;
  int blocked_writes_ = 0;
  std::optional<InputReport> newest_;
  std::uint64_t number_ = 0;
  std::set<std::thread::id> owners_;
};

class RealHandle : public Handle {
 public:
  explicit RealHandle(std::shared_ptr<RealBus> bus) : bus_(std::move(bus)), life_(bus_->open()) {}
  ~RealHandle() override { bus_->close(); }

  ReadOutcome read(std::span<std::uint8_t> bytes, int wait_ms) override {
    constexpr std::chrono::microseconds kPoll{200};
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(wait_ms);
    while (true) {
      InputReport report;
      bool found = false;
      if (!bus_->read(life_, seen_, report, found)) return {ReadKind::kFailed, 0};
      if (found) {
        std::copy_n(report.bytes.begin(), std::min(report.size, bytes.size()), bytes.begin());
        return {ReadKind::kReport, report.size};
      }
      if (std::chrono::steady_clock::now() >= end) return {};
      std::this_thread::sleep_for(kPoll);
    }
  }
  bool write(std::span<const std::uint8_t> bytes) override { return bus_->write(life_, bytes); }
  std::size_t get_feature(std::uint8_t /*id*/, std::span<std::uint8_t> bytes) override {
    const auto info = bus_->info();
    if (!info) return 0;
    std::copy(info->begin(), info->end(), bytes.begin());
    return info->size();
  }

 private:
  std::shared_ptr<RealBus> bus_;
  int life_;
  std::uint64_t seen_ = 0;
};

class RealPort : public Port {
 public:
  explicit RealPort(std::shared_ptr<RealBus> bus) : bus_(std::move(bus)) {}

  Result<std::vector<Listing>> list() override {
    if (!bus_->is_plugged()) return std::vector<Listing>();
    return std::vector<Listing>{usual_listing()};
  }
  Result<std::unique_ptr<Handle>> open(const std::string& path) override {
    if (!bus_->is_plugged()) {
      return Error{ErrorKind::kDevice, obstacle_text(path, Obstacle::kGone)};
    }
    return std::unique_ptr<Handle>(std::make_unique<RealHandle>(bus_));
  }
  Obstacle obstacle(const std::string& /*path*/) override {
    return bus_->is_plugged() ? Obstacle::kNone : Obstacle::kGone;
  }

 private:
  std::shared_ptr<RealBus> bus_;
};

}  // namespace hapticwall::device::hid::testing
