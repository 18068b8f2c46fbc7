// A gamepad that writes down every call.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "device/evdev/gamepad.h"

namespace hapticwall::sound::test {

using device::evdev::Gamepad;
using device::evdev::OpenGamepad;
using device::evdev::RumbleLevels;

class Felt {
 public:
  void note(RumbleLevels levels) {
    const std::scoped_lock lock(mutex_);
    calls_.push_back(levels);
  }
  [[nodiscard]] std::vector<RumbleLevels> calls() const {
    const std::scoped_lock lock(mutex_);
    return calls_;
  }
  [[nodiscard]] bool rumbles() const {
    const std::vector<RumbleLevels> all = calls();
    return !all.empty() && all.back() != RumbleLevels{};
  }

  std::atomic<bool> plugged_in{true};
  std::atomic<int> open{0};

 private:
  mutable std::mutex mutex_;
  std::vector<RumbleLevels> calls_;
};

class FakeGamepad final : public Gamepad {
 public:
  explicit FakeGamepad(std::shared_ptr<Felt> felt) : felt_(std::move(felt)) { ++felt_->open; }
  ~FakeGamepad() override { --felt_->open; }
  FakeGamepad(const FakeGamepad&) = delete;
  FakeGamepad& operator=(const FakeGamepad&) = delete;
  [[nodiscard]] std::string name() const override { return "fake pad"; }
  [[nodiscard]] Failure rumble(RumbleLevels levels) override {
    if (!felt_->plugged_in) return device_error("fake pad: No such device");
    felt_->note(levels);
    return std::nullopt;
  }

 private:
  std::shared_ptr<Felt> felt_;
};

inline Result<std::unique_ptr<Gamepad>> no_gamepad() { return device_error("no gamepad"); }
inline OpenGamepad fake_gamepad(const std::shared_ptr<Felt>& felt) {
  return [felt]() -> Result<std::unique_ptr<Gamepad>> {
    if (!felt->plugged_in) return no_gamepad();
    return std::unique_ptr<Gamepad>(std::make_unique<FakeGamepad>(felt));
  };
}

}  // namespace hapticwall::sound::test
