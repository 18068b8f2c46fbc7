#include "tests/wheel_guest/firmware.h"

#include <algorithm>
#include <cmath>

#include "tests/wheel_guest/descriptors.h"

namespace hapticwall::wheel {
namespace {

constexpr std::uint8_t kSpring = 1;  // the block of the wheel's own spring
constexpr double kSpringNPerM = 50.0;
// The direction of an effect at 90 degrees: its force turns the wheel to the left.
constexpr std::uint16_t kLeft = 9000;

std::uint16_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | (bytes[at + 1] << 8U));
}

}  // namespace

void Firmware::take(std::span<const std::uint8_t> report) {
  ++taken_;
  if (static_cast<double>(ticks_) / 1e3 >= settings_.deaf_after_s || report.size() < 2) return;
  Effect& target = effect(report[1]);
  switch (report[0]) {
    case kSetEffect:
      target.length_ms = word(report, 3);
      target.delay_ms = word(report, 7);
      target.gain = report[9];
      target.direction = word(report, 12);
      break;
    case kSetConstant:
      target.level = static_cast<std::int16_t>(word(report, 2));
      ours_ = target;
      break;
    case kOperation:
      operate(report);
      break;
    case kBlockFree:
      target = {};
      break;
    case kDeviceControl:
      control(report[1]);
      break;
    case kDeviceGain:
      gain_ = report[1];
      break;
    case kCreateEffect:
      loaded_ = settings_.autocentres ? kSpring + 1 : kSpring;
      while (effect(loaded_).there) ++loaded_;
      effect(loaded_).there = true;
      break;
    default:
      break;
  }
}

void Firmware::operate(std::span<const std::uint8_t> report) {
  Effect& target = effect(report[1]);
  const bool starts = report[2] != 3;
  if (starts && target.there && ticks_ == 0) ticks_ = 1;  // the hand may begin
  target.left_ms = starts ? (target.length_ms > 0 ? target.length_ms : kForever) : 0;
}

// 1 enables, 2 disables, 3 stops all, 4 resets.
void Firmware::control(std::uint8_t what) {
  if (what == 1) enabled_ = true;
  if (what == 2) enabled_ = false;
  if (what == 4) effects_ = {};
  if (what == 3) {
    for (Effect& each : effects_) each.left_ms = 0;
  }
  if (what == 4 && settings_.autocentres) effects_[kSpring].left_ms = kForever;
}

std::vector<std::uint8_t> Firmware::feature(std::uint8_t id) const {
  if (id == kBlockLoad) return {id, loaded_, 1, 0xFF, 0x0F};
  if (id == kPool) return {id, 0xFF, 0x0F, kEffects, 1};
  return {};
}

double Firmware::motor_n() const {
  double sum_n = 0.0;
  for (std::size_t i = 1; i < kEffects; ++i) {
    const Effect& each = effects_[i];
    if (each.left_ms == 0) continue;
    if (i == kSpring && settings_.autocentres) {
      sum_n += kSpringNPerM * position_m_;
      continue;
    }
    const double side = each.direction == kLeft ? 1.0 : -1.0;
    sum_n += side * settings_.full_force_n * each.level / kLevelMax * each.gain / kFull;
  }
  if (!enabled_) return 0.0;
  return std::clamp(sum_n * gain_ / kFull, -settings_.full_force_n, settings_.full_force_n);
}

void Firmware::tick() {
  force_n_ = motor_n();
  for (Effect& each : effects_) {
    if (each.left_ms > 0 && each.left_ms != kForever) --each.left_ms;
  }
  if (ticks_ > 0) {
    ++ticks_;
    plant_.write(force_n_);
  }
  position_m_ = plant_.read().position_m;
  if (ticks_ == 0 && settings_.is_held) position_m_ += tremble_m();
}

// A count, 50 times a second.
double Firmware::tremble_m() {
  constexpr unsigned kPeriodMs = 20;
  const double count_m = settings_.travel_m / (2.0 * kLevelMax);
  return ++held_ms_ / (kPeriodMs / 2) % 2 == 0 ? 0.0 : count_m;
}

std::optional<std::array<std::uint8_t, 3>> Firmware::news() {
  next_report_ms_ -= 1.0;
  if (next_report_ms_ > 0.0) return std::nullopt;
  const double full = position_m_ / settings_.travel_m * 2.0 * kLevelMax;
  const auto angle =
      static_cast<std::int16_t>(std::clamp(std::lround(full), -long{kLevelMax}, long{kLevelMax}));
  if (sent_ == angle) return std::nullopt;
  next_report_ms_ = std::max(next_report_ms_ + 1e3 / settings_.report_hz, 0.0);
  sent_ = angle;
  return std::array{std::uint8_t{kInput}, low(static_cast<std::uint16_t>(angle)),
                    high(static_cast<std::uint16_t>(angle))};
}

}  // namespace hapticwall::wheel
