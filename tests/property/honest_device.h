// An honest device in virtual time: a handle held by a hand, noise of one count, reports that are
// missing, commands that take a varying time, and a clock of its own.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <random>

#include "core/plant/plant_model.h"
#include "core/scene.h"
#include "device/device.h"

namespace hapticwall::testing {

struct HonestSettings {
  Scene scene;
  bool is_wheel = false;  // acknowledges nothing, and has no clock
  double sign = 1.0;      // -1: not honest
  double noise_counts = 1.0;
  double clock_rate = 1.0;
  double missing_reports = 0.0;      // share
  std::uint32_t max_late_ticks = 2;  // of a command, on top of one tick
  std::uint32_t seed = 1;
};

class HonestDevice : public device::Device {
 public:
  explicit HonestDevice(const HonestSettings& settings)
      : settings_(settings), plant_(settings.scene), random_(settings.seed) {
    stats_.connected = true;
    stats_.acknowledges = !settings.is_wheel;
    stats_.has_clock = !settings.is_wheel;
    stats_.force_word = device::ForceWord::kSame;
    report();
  }

  // One tick of the device, 1 ms.
  void pass_tick() {
    ++tick_;
    while (!commands_.empty() && commands_.front().due <= tick_) {
      force_n_ = commands_.front().force_n;
      acknowledge(commands_.front().latch);
      commands_.pop_front();
    }
    plant_.advance(settings_.sign * force_n_);
    fastest_m_per_s = std::max(fastest_m_per_s, std::abs(plant_.truth().velocity_m_per_s));
    if (share() >= settings_.missing_reports) report();
  }

  [[nodiscard]] device::DeviceInfo info() const override {
    device::DeviceInfo info;
    info.name = "honest";
    info.encoder_m = encoder_m();
    info.motion.mass_kg = settings_.scene.x().device.mass_kg;
    return info;
  }
  [[nodiscard]] Failure open() override { return std::nullopt; }
  [[nodiscard]] DeviceReading read() override {
    DeviceReading reading{position_m_, 1e-3 * static_cast<double>(tick_ - latch_),
                          DeviceState::kOk};
    if (!settings_.is_wheel) reading.device_time_s = time_s_;
    return reading;
  }
  void write(double force_n) override {
    const std::uint64_t due = tick_ + 1 + random_() % (settings_.max_late_ticks + 1);
    const std::uint64_t before = commands_.empty() ? 0 : commands_.back().due;
    commands_.push_back({std::max(due, before), enabled_ ? force_n : 0.0, latch_});
  }
  void enable(bool enabled) override { enabled_ = enabled; }
  [[nodiscard]] device::LinkStats link() const override { return stats_; }
  void close() override {}

  double fastest_m_per_s = 0.0;

 private:
  struct Command {
    std::uint64_t due = 0;
    double force_n = 0.0;
    std::uint64_t latch = 0;  // tick of its position
  };

  [[nodiscard]] double share() { return static_cast<double>(random_()) / 0x1p32; }
  [[nodiscard]] double encoder_m() const {
    return settings_.scene.x().device.encoder_m.value_or(0.0);
  }
  void report() {
    const auto counts = static_cast<double>(static_cast<int>(random_() % 3) - 1);
    position_m_ = plant_.measured_position_m() + counts * settings_.noise_counts * encoder_m();
    latch_ = tick_;
    time_s_ = 1e-3 * settings_.clock_rate * (static_cast<double>(tick_) + 0.05 * (share() - 0.5));
  }
  void acknowledge(std::uint64_t latch) {
    if (settings_.is_wheel) return;
    ++stats_.applied_commands;
    stats_.recent_delay_s = 1e-3 * static_cast<double>(tick_ - latch);
    const double weight = stats_.delay_s > 0.0 ? 1.0 / 64.0 : 1.0;
    stats_.delay_s += weight * (stats_.recent_delay_s - stats_.delay_s);
  }

  HonestSettings settings_;
  PlantModel plant_;
  std::mt19937 random_;
  device::LinkStats stats_;
  std::deque<Command> commands_;
  double force_n_ = 0.0;
  bool enabled_ = false;
  std::uint64_t tick_ = 0;
  std::uint64_t latch_ = 0;  // tick of the newest report
  double time_s_ = 0.0;
  double position_m_ = 0.0;
};

}  // namespace hapticwall::testing
