#include "tests/emulator/firmware/firmware_emulator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.h"

namespace hapticwall::device::hid {
namespace {

constexpr double kFinestEncoderM = 1e-6;
constexpr std::uint64_t kMillisecondUs = 1000;
constexpr std::uint64_t kBusLossUs = 3 * kMillisecondUs;
constexpr std::uint32_t kFirmwareVersion = 0x00010000;
constexpr std::size_t kShortBytes = 12;
constexpr std::size_t kOverLongBytes = InputReport::kMaxBytes;
constexpr std::uint8_t kNoId = 0x07;
constexpr std::size_t kMaxTold = 200;
constexpr std::uint8_t kNextMajor = (kProtocolMajor + 1) << 4U;

double encoder_of(const Scene& scene) {
  const double encoder_m = scene.x().device.encoder_m.value_or(0.0);
  return encoder_m > 0.0 ? encoder_m : kFinestEncoderM;
}

InfoReport info_of(const EmulatorSettings& settings) {
  InfoReport info;
  info.axes = static_cast<std::uint8_t>(settings.axes.size());
  info.flags = kInfoMeasuresVelocity | kInfoCalibrates;
  info.firmware = kFirmwareVersion;
  for (std::size_t axis = 0; axis < info.axes; ++axis) {
    const Scene& scene = settings.axes[axis];
    info.counts_per_metre[axis] = saturated_count(1.0 / encoder_of(scene));
    info.maximum_force_n[axis] =
        std::min(scene.x().device.force_limit_n.value_or(kMaxForceN), kMaxForceN);
  }
  info.tick_us = static_cast<std::uint16_t>(
      std::lround(kMicrosecondsPerSecond / settings.axes.front().sampling.rate_hz));
  info.watchdog_ms = settings.watchdog_ms;
  return info;
}

}  // namespace

FirmwareEmulator::FirmwareEmulator(const EmulatorSettings& settings, FaultScript script)
    : script_(std::move(script)),
      settings_(settings),
      firmware_(info_of(settings)),
      hand_waits_(settings.hand_waits) {
  for (std::size_t axis = 0; axis < settings.axes.size(); ++axis) {
    plants_.emplace_back(settings.axes[axis]);
    encoder_m_.at(axis) = encoder_of(settings.axes[axis]);
  }
  tick_us_ = firmware_.info().tick_us;
  next_tick_us_ = tick_us_;
  read_encoders();
}

void FirmwareEmulator::step(std::uint64_t microseconds) {
  const std::uint64_t end_us = now_us_ + microseconds;
  while (next_tick_us_ <= end_us) {
    now_us_ = next_tick_us_;
    next_tick_us_ += tick_us_;
    pass_tick();
  }
  now_us_ = end_us;
}

std::optional<InputReport> FirmwareEmulator::take_input() {
  if (on_the_wire_.empty()) return std::nullopt;
  const InputReport report = on_the_wire_.front();
  on_the_wire_.pop_front();
  return report;
}

bool FirmwareEmulator::is_plugged() const { return !lasts(FaultKind::kUnplugged) && has_power(); }

bool FirmwareEmulator::accepts_output() const {
  return is_plugged() && !lasts(FaultKind::kNoOutput) && !lasts(FaultKind::kFrozen);
}

bool FirmwareEmulator::write_output(std::span<const std::uint8_t> bytes) {
  if (!accepts_output()) return false;
  const double late_s = script_.amount(FaultKind::kSlow, now_us_).value_or(0.0);
  if (late_s > 0.0 || !late_.empty()) {
    const auto late_us = static_cast<std::uint64_t>(late_s * kMicrosecondsPerSecond);
    const std::uint64_t before_us = late_.empty() ? 0 : late_.back().due_us;  // nothing overtakes
    late_.push_back({std::max(now_us_ + late_us, before_us), {bytes.begin(), bytes.end()}});
    return true;
  }
  receive(bytes, now_us_);
  return true;
}

void FirmwareEmulator::receive(std::span<const std::uint8_t> bytes, std::uint64_t at_us) {
  // A packet of the wrong length is rejected.
  if (lasts(FaultKind::kRejects)) bytes = bytes.first(bytes.size() / 2);
  firmware_.receive(bytes, at_us - power_up_us_);
}

void FirmwareEmulator::receive_due() {
  while (!late_.empty() && late_.front().due_us <= now_us_) {
    receive(late_.front().bytes, late_.front().due_us);
    late_.pop_front();
  }
}

// How far the told position is from the true one.
double FirmwareEmulator::told_offset_m() {
  double off_m = script_.amount(FaultKind::kJump, now_us_).value_or(0.0);
  if (const auto speed = script_.amount(FaultKind::kRunaway, now_us_)) {
    off_m += *speed * static_cast<double>(script_.since_us(FaultKind::kRunaway, now_us_)) /
             kMicrosecondsPerSecond;
  }
  if (const auto most_m = script_.amount(FaultKind::kNoise, now_us_)) {
    constexpr std::uint32_t kMultiplier = 1664525;
    constexpr std::uint32_t kIncrement = 1013904223;
    random_ = random_ * kMultiplier + kIncrement;
    off_m += *most_m * (static_cast<double>(random_) / 0x1p31 - 1.0);
  }
  return off_m;
}

// Every time of a state is by the same wrong clock.
void FirmwareEmulator::tell_time(StateReport& told) {
  const auto rate = script_.amount(FaultKind::kClockRate, now_us_);
  if (rate) clock_ahead_us_ += (*rate - 1.0) * static_cast<double>(tick_us_);
  const double jump_s = script_.amount(FaultKind::kClockJump, now_us_).value_or(0.0);
  const auto ahead_us =
      static_cast<std::int64_t>(clock_ahead_us_ + jump_s * kMicrosecondsPerSecond);
  told.time_us += static_cast<std::uint32_t>(ahead_us);
  told.acknowledged_time_us += static_cast<std::uint32_t>(ahead_us);
}

// The newest state with the lies that last.
StateReport FirmwareEmulator::as_told() {
  StateReport told = state_;
  const auto amount = [&](FaultKind kind) { return script_.amount(kind, now_us_); };
  if (const double off_m = told_offset_m(); off_m != 0.0) {
    told.position_counts[0] =
        saturated_count(told.position_counts[0] + round_to_even(off_m / encoder_m_[0]));
  }
  const std::array<double, kMaxAxes> force_n = amplifier_force_n();
  if (lasts(FaultKind::kNotEnabled)) told.status &= static_cast<std::uint16_t>(~kStatusEnabled);
  if (lasts(FaultKind::kNotEnabled) || lasts(FaultKind::kNoForce) ||
      lasts(FaultKind::kOtherForce)) {
    told.applied_force_n = force_n;
  }
  if (const auto foreign_n = amount(FaultKind::kForeignForce)) told.applied_force_n[0] = *foreign_n;
  const auto held = static_cast<std::size_t>(amount(FaultKind::kWithheldAnswer).value_or(0.0));
  const StateReport* acknowledges = nullptr;
  if (lasts(FaultKind::kNoAnswer) && !told_.empty()) acknowledges = &told_.back();
  if (held > 0 && told_.size() >= held) acknowledges = &told_[told_.size() - held];
  if (acknowledges != nullptr) {
    told.acknowledged_sequence = acknowledges->acknowledged_sequence;
    told.acknowledged_time_us = acknowledges->acknowledged_time_us;
  }
  tell_time(told);
  return told;
}

std::optional<ReportBytes> FirmwareEmulator::get_feature(std::uint8_t id) const {
  if (!is_plugged() || lasts(FaultKind::kFrozen) || !settings_.has_info || id != kInfoId) {
    return std::nullopt;
  }
  return encode_info(firmware_.info());
}

std::array<double, kMaxAxes> FirmwareEmulator::amplifier_force_n() const {
  if (!has_power() || lasts(FaultKind::kEmergencyStop) || lasts(FaultKind::kNotEnabled) ||
      lasts(FaultKind::kNoForce) || lasts(FaultKind::kNoPush)) {
    return {};
  }
  std::array<double, kMaxAxes> force_n = firmware_.force_n();
  if (const auto factor = script_.amount(FaultKind::kOtherForce, now_us_)) {
    for (double& axis_n : force_n) axis_n *= *factor;
  }
  if (lasts(FaultKind::kWrongSign)) {
    for (double& axis_n : force_n) axis_n = 0.0 - axis_n;
  }
  return force_n;
}

// The plant's positive force pushes out of the wall, towards smaller positions.
void FirmwareEmulator::move_plants() {
  if (hand_waits_) return;
  const std::array<double, kMaxAxes> force_n = amplifier_force_n();
  for (std::size_t axis = 0; axis < plants_.size(); ++axis) {
    plants_[axis].advance(-force_n[axis]);
  }
}

void FirmwareEmulator::read_encoders() {
  if (lasts(FaultKind::kEncoderFault)) return;
  for (std::size_t axis = 0; axis < plants_.size(); ++axis) {
    encoder_counts_[axis] =
        saturated_count(round_to_even(truth(axis).position_m / encoder_m_[axis]));
  }
}

HardwareState FirmwareEmulator::hardware() const {
  HardwareState state;
  state.bus_alive = now_us_ - on_bus_us_ < kBusLossUs;
  const auto present = [&](FaultKind kind, StatusFlag bit) {
    if (lasts(kind)) state.faults |= bit;
  };
  present(FaultKind::kEmergencyStop, kStatusEmergencyStop);
  present(FaultKind::kOverTemperature, kStatusOverTemperature);
  present(FaultKind::kOverCurrent, kStatusOverCurrent);
  present(FaultKind::kEncoderFault, kStatusEncoderFault);
  return state;
}

// Incremental encoders: count 0 is the position at power-up.
void FirmwareEmulator::lose_power() {
  firmware_.restart();
  late_.clear();
  counts_at_power_up_ = encoder_counts_;
  calibrated_ = false;
  overrun_ = false;
  power_up_us_ = now_us_;
  alive_us_ = now_us_;
}

StateReport FirmwareEmulator::latch() {
  StateReport state = firmware_.state(now_us_ - power_up_us_);
  for (std::size_t axis = 0; axis < plants_.size(); ++axis) {
    state.position_counts[axis] =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(encoder_counts_[axis]) -
                                  static_cast<std::uint32_t>(counts_at_power_up_[axis]));
    state.velocity_counts_per_s[axis] =
        saturated_count(truth(axis).velocity_m_per_s / encoder_m_[axis]);
  }
  if (calibrated_) state.status |= kStatusCalibrated;
  state.temperature_c = settings_.temperature_c;
  state.supply_v = settings_.supply_v;
  return state;
}

void FirmwareEmulator::pass_tick() {
  move_plants();
  read_encoders();
  const std::uint64_t watchdog_us = firmware_.info().watchdog_ms * kMillisecondUs;
  const bool frozen = lasts(FaultKind::kFrozen);
  hung_ = frozen && (hung_ || now_us_ - alive_us_ >= watchdog_us);
  const bool powered = has_power();
  if (!powered) {
    lose_power();
    return;
  }
  if (!lasts(FaultKind::kUnplugged)) on_bus_us_ = now_us_;
  if (frozen) return;
  alive_us_ = now_us_;
  if (!hardware().bus_alive) late_.clear();
  receive_due();
  firmware_.tick(now_us_ - power_up_us_, hardware());
  state_ = latch();
  if ((state_.status & kStatusEnabled) != 0) hand_waits_ = false;
  // The acknowledgement stands still at the one before the lie began.
  if (!lasts(FaultKind::kNoAnswer)) told_.push_back(state_);
  while (told_.size() > kMaxTold) told_.pop_front();
  send();
}

void FirmwareEmulator::send() {
  if (!is_plugged() || lasts(FaultKind::kSilent)) return;
  if (held_ || lasts(FaultKind::kNotPolled)) {
    overrun_ = true;
    return;
  }
  if (script_.strikes(FaultKind::kSkipped, now_us_, tick_us_)) return;
  StateReport told = as_told();
  if (overrun_) told.status |= kStatusReportOverrun;
  overrun_ = false;
  const ReportBytes bytes = encode_state(told);
  InputReport report;
  report.time_us = now_us_;
  report.size = bytes.size();
  std::copy(bytes.begin(), bytes.end(), report.bytes.begin());
  if (last_sent_ && script_.strikes(FaultKind::kRepeated, now_us_, tick_us_)) {
    report = *last_sent_;
    report.time_us = now_us_;
  }
  last_sent_ = report;
  spoil(report);
  on_the_wire_.push_back(report);
}

void FirmwareEmulator::spoil(InputReport& report) const {
  const auto strikes = [&](FaultKind kind) { return script_.strikes(kind, now_us_, tick_us_); };
  const auto change = [&](std::size_t at, std::uint8_t value) {
    ReportBytes bytes{};
    std::copy_n(report.bytes.begin(), bytes.size(), bytes.begin());
    bytes.at(at) = value;
    seal(bytes);
    std::copy(bytes.begin(), bytes.end(), report.bytes.begin());
  };
  if (strikes(FaultKind::kWrongId)) change(0, kNoId);
  if (strikes(FaultKind::kWrongMajor)) change(1, kNextMajor);
  if (strikes(FaultKind::kBadCrc)) report.bytes[kReportBytes - 1] ^= 1U;
  if (strikes(FaultKind::kAllZero)) report.bytes = {};
  if (strikes(FaultKind::kOverLong)) report.size = kOverLongBytes;
  if (strikes(FaultKind::kShort)) report.size = kShortBytes;
  if (strikes(FaultKind::kEmpty)) report.size = 0;
}

}  // namespace hapticwall::device::hid
