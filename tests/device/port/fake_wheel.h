// A wheel for tests: its firmware by the clock of the test, without a kernel.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>
#include <utility>

#include "device/port/wheel_node.h"

namespace hapticwall::device::evdev::test {

inline constexpr WheelAxis kFakeAxis{-32767, 32767};

class FakeWheel : public WheelNode {
 public:
  explicit FakeWheel(std::function<std::int64_t()> now_ns) : now_ns_(std::move(now_ns)) {}

  [[nodiscard]] WheelAxis axis() const override { return kFakeAxis; }
  [[nodiscard]] WheelNews listen(int wait_ms) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(wait_ms, 1)));
    const std::int32_t now = value;
    const bool moved = std::exchange(told_, now) != now;
    return {gone, moved ? 1U : 0U, moved ? now_ns_() : 0,
            tells ? std::optional<std::int32_t>(now) : std::nullopt};
  }
  // Sends no level twice, like hid-pidff.
  bool set_level(std::int16_t level) override {
    if (std::exchange(uploaded_, level) != level && take()) level_ = level;
    return !gone;
  }
  bool play(bool starts) override {
    if (take()) ends_ns_ = starts ? now_ns_() + std::int64_t{kEffectMs} * 1'000'000 : 0;
    return !gone;
  }
  bool set_gain(bool full) override {
    if (take()) gain_ = full ? 1 : 0;
    return !gone;
  }

  // Force that the motor gives now, in levels.
  [[nodiscard]] int motor() const { return now_ns_() < ends_ns_ ? level_ * gain_ : 0; }
  // True if nothing is left that could make a force.
  [[nodiscard]] bool is_quiet() const { return level_ == 0 && ends_ns_ == 0 && gain_ == 0; }

  std::atomic<std::int32_t> value{0};
  std::atomic<bool> tells{true};
  std::atomic<bool> gone{false};
  std::atomic<bool> deaf{false};  // takes reports and does nothing
  std::atomic<std::uint64_t> reports{0};
  std::function<void()> on_report;

 private:
  bool take() {
    ++reports;
    if (on_report) on_report();
    return !gone && !deaf;
  }

  std::function<std::int64_t()> now_ns_;
  std::int32_t told_ = 0;
  std::int16_t uploaded_ = 0;
  std::atomic<int> level_{0};
  std::atomic<int> gain_{0};
  std::atomic<std::int64_t> ends_ns_{0};
};

inline WheelListing fake_listing() {
  WheelListing listing{NodeListing("event7"), "Fake wheel", 0x1209, 0xFFB0, 900.0, true, ""};
  return listing;
}

}  // namespace hapticwall::device::evdev::test
