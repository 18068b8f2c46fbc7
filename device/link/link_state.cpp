#include "device/link/link_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.h"

namespace hapticwall::device {
namespace {

// A longer clock step between two states, or a longer round trip, means that the device restarted.
constexpr std::int32_t kMaxStepUs = 1'000'000;
// More ticks than any device makes in that time.
constexpr int kMaxStepTicks = 20'000;
// A reported force may differ from the commanded one by this share of its limit (eight bits of an
// amplifier are 0.4 %), plus a step of the report.
constexpr double kForceTolerance = 0.01;
constexpr double kReportStepN = 1.5 / hid::kStepsPerNewton;
// Weight of one tick in the moving average of the delay.
constexpr double kDelayWeight = 1.0 / 64.0;

Trouble trouble_of(std::uint8_t fault_code) {
  // Troubles in the order of hid::FaultCode.
  constexpr std::array kTroubles{Trouble::kNone,          Trouble::kWatchdog,
                                 Trouble::kEmergencyStop, Trouble::kOverTemperature,
                                 Trouble::kOverCurrent,   Trouble::kEncoder};
  static_assert(kTroubles.size() == hid::kFaultEncoder + 1);
  return fault_code < kTroubles.size() ? kTroubles[fault_code] : Trouble::kOwnFault;
}

bool is_calibrated(const hid::StateReport& state) {
  return (state.status & hid::kStatusCalibrated) != 0;
}

double seconds(std::int32_t microseconds) {
  return static_cast<double>(microseconds) / kMicrosecondsPerSecond;
}

}  // namespace

Trouble fault_in(const hid::StateReport& state) {
  if (const Trouble told = trouble_of(state.fault); told != Trouble::kNone) return told;
  constexpr std::pair<std::uint16_t, Trouble> kFaults[] = {
      {hid::kStatusEmergencyStop, Trouble::kEmergencyStop},
      {hid::kStatusEncoderFault, Trouble::kEncoder},
      {hid::kStatusOverTemperature, Trouble::kOverTemperature},
      {hid::kStatusOverCurrent, Trouble::kOverCurrent},
      {hid::kStatusWatchdog, Trouble::kWatchdog}};
  for (const auto& [flag, trouble] : kFaults) {
    if ((state.status & flag) != 0) return trouble;
  }
  return Trouble::kNone;
}

void StateTracker::begin(const LinkSession& session) {
  session_ = session;
  ended_ = Trouble::kNone;
  newest_.reset();
  answered_.reset();
  // Measurements of the previous link do not apply to this one.
  LinkStats& stats = view_.stats;
  stats.round_trip_s = 0.0;
  stats.acknowledges = session.acknowledges;
  stats.delay_s = session.delay_s;
  stats.recent_delay_s = 0.0;
  stats.has_clock = session.has_clock;
  stats.device_period_s = 0.0;
  stats.unanswered_s = 0.0;
  stats.command_age_s = 0.0;
  stats.force_word = ForceWord::kNone;
  stats.same_words = 0;
}

bool StateTracker::take(std::span<const std::uint8_t> bytes, std::int64_t received_ns,
                        Trouble gap) {
  if (ended_ != Trouble::kNone) return false;
  const hid::Decoded<hid::StateReport> decoded = hid::decode_state(bytes);
  const hid::StateReport* state = decoded.report();
  if (state == nullptr) {
    ++view_.stats.void_reports;
    return false;
  }
  if (newest_) {
    if (state->sequence == newest_->sequence) {
      ++view_.stats.repeated_states;
      return false;
    }
    const bool late = received_ns - view_.received_ns > kLinkLostNs;
    ended_ = late ? gap : objection(*state);
    if (ended_ != Trouble::kNone) {
      view_.trouble = ended_;
      return false;
    }
    follow(*state);
  } else {
    begin_with(*state);
  }
  accept(*state, received_ns);
  return true;
}

// Why a state cannot follow the previous one.
Trouble StateTracker::objection(const hid::StateReport& state) const {
  const std::int32_t step_us = hid::clock_step_us(newest_->time_us, state.time_us);
  const int ticks = hid::sequence_step(newest_->sequence, state.sequence);
  if (step_us <= 0 || step_us > kMaxStepUs || ticks <= 0 || ticks > kMaxStepTicks) {
    return Trouble::kRestarted;
  }
  if (is_calibrated(state) != is_calibrated(*newest_)) return Trouble::kCalibration;
  return Trouble::kNone;
}

void StateTracker::begin_with(const hid::StateReport& state) {
  view_.session = session_.number;
  view_.device_time_us = session_.acknowledges ? state.time_us : 0;
  first_time_us_ = state.time_us;
  answered_us_ = state.time_us;
  command_us_ = state.time_us;
  ticks_ = 0;
  for (std::size_t axis = 0; axis < origin_m_.size(); ++axis) {
    const bool tells_its_place = is_calibrated(state) || axis >= session_.device.axes;
    origin_counts_[axis] = tells_its_place ? 0 : state.position_counts[axis];
    origin_m_[axis] = tells_its_place ? 0.0 : session_.start_m[axis];
    view_.limit_n[axis] = session_.device.axis[axis].force_limit_n;
  }
}

void StateTracker::follow(const hid::StateReport& state) {
  if (!session_.acknowledges) return;
  LinkStats& stats = view_.stats;
  const auto ticks =
      static_cast<std::uint64_t>(hid::sequence_step(newest_->sequence, state.sequence));
  stats.missing_states += ticks - 1;
  ticks_ += ticks;
  view_.device_time_us = hid::unwrapped_us(view_.device_time_us, state.time_us);
  stats.device_period_s = static_cast<double>(view_.device_time_us - first_time_us_) /
                          kMicrosecondsPerSecond / static_cast<double>(ticks_);
  stats.rejected_commands +=
      static_cast<std::uint16_t>(state.rejected_commands - newest_->rejected_commands);
  const bool acknowledges = state.acknowledged_sequence != newest_->acknowledged_sequence ||
                            state.acknowledged_time_us != newest_->acknowledged_time_us;
  if (acknowledges) measure(state, ticks == 1);
  hear_answer(state, acknowledges);
}

void StateTracker::accept(const hid::StateReport& state, std::int64_t received_ns) {
  const bool moved = newest_ && newest_->position_counts != state.position_counts;
  newest_ = state;
  view_.received_ns = received_ns;
  view_.latch_us = state.time_us;
  view_.sequence = state.sequence;
  view_.trouble = fault_in(state);
  for (std::size_t axis = 0; axis < view_.position_m.size(); ++axis) {
    const std::int64_t counts = std::int64_t{state.position_counts[axis]} - origin_counts_[axis];
    view_.position_m[axis] =
        static_cast<double>(counts) * session_.device.axis[axis].encoder_m + origin_m_[axis];
    view_.applied_n[axis] = 0.0 - state.applied_force_n[axis];  // no negative zero
  }
  LinkStats& stats = view_.stats;
  if (session_.acknowledges || moved) ++stats.states;
  stats.calibrated = is_calibrated(state);
  stats.enabled = (state.status & hid::kStatusEnabled) != 0;
}

// Latch behind a command of this session: those of another session are not in `sent`, or arrived
// before the latch of their state.
std::optional<std::uint32_t> StateTracker::latch_behind(const hid::StateReport& state) const {
  const auto latch_us = session_.sent->latch_us(state.acknowledged_sequence);
  if (!latch_us) return std::nullopt;
  const std::int32_t round_trip_us = hid::clock_step_us(*latch_us, state.acknowledged_time_us);
  const std::int32_t since_us = hid::clock_step_us(state.acknowledged_time_us, state.time_us);
  if (round_trip_us < 0 || round_trip_us > kMaxStepUs || since_us < 0) return std::nullopt;
  return latch_us;
}

// Takes the device's report on its force, and the age of the command that it obeys.
void StateTracker::hear_answer(const hid::StateReport& state, bool another) {
  LinkStats& stats = view_.stats;
  const auto latch_us = latch_behind(state);
  if (latch_us) {
    command_us_ = view_.device_time_us - hid::clock_step_us(*latch_us, state.time_us);
    if (another) count_answer(state.acknowledged_sequence);
  }
  const double per_s = kMicrosecondsPerSecond;
  stats.unanswered_s = static_cast<double>(view_.device_time_us - answered_us_) / per_s;
  stats.command_age_s = static_cast<double>(view_.device_time_us - command_us_) / per_s;
  const ForceWord word = latch_us ? force_word(state) : ForceWord::kNone;
  stats.same_words = word == stats.force_word ? stats.same_words + 1 : 1;
  stats.force_word = word;
}

void StateTracker::count_answer(std::uint16_t sequence) {
  LinkStats& stats = view_.stats;
  answered_us_ = view_.device_time_us;
  ++stats.applied_commands;
  if (answered_) {
    stats.lost_commands +=
        static_cast<std::uint64_t>(std::max(hid::sequence_step(*answered_, sequence) - 1, 0));
  }
  answered_ = sequence;
}

// The force in a state is that of the command that it acknowledges (docs/hid-protocol.md, timing).
ForceWord StateTracker::force_word(const hid::StateReport& state) const {
  const auto sent = session_.sent->force(state.acknowledged_sequence);
  if (!sent) return ForceWord::kNone;
  const bool enabled = (state.status & hid::kStatusEnabled) != 0;
  if (sent->enable && !enabled) return ForceWord::kNotEnabled;
  bool other = enabled && !sent->enable;
  const ForceWord kind = sent->enable ? ForceWord::kOther : ForceWord::kUnasked;
  for (std::size_t axis = 0; axis < session_.device.axes; ++axis) {
    const double commanded_n = sent->force_mn[axis] / hid::kStepsPerNewton;
    const double told_n = state.applied_force_n[axis];
    const double step_n =
        std::max(kReportStepN, kForceTolerance * session_.device.axis[axis].force_limit_n);
    if (std::abs(told_n - commanded_n) <= step_n) continue;
    if (told_n == 0.0) return ForceWord::kNoForce;
    other = true;
  }
  return other ? kind : ForceWord::kSame;
}

// Measures by the device's clock.
void StateTracker::measure(const hid::StateReport& state, bool next_tick) {
  const auto latch_us = latch_behind(state);
  if (!latch_us || !session_.delay_is_known) return;
  LinkStats& stats = view_.stats;
  stats.round_trip_s = seconds(hid::clock_step_us(*latch_us, state.acknowledged_time_us));
  stats.maximum_round_trip_s = std::max(stats.maximum_round_trip_s, stats.round_trip_s);
  if (!next_tick) return;  // the state of the tick at which it acted is missing
  const double delay_s = seconds(hid::clock_step_us(*latch_us, state.time_us));
  stats.delay_s += (delay_s - stats.delay_s) * (stats.delay_s > 0.0 ? kDelayWeight : 1.0);
  stats.maximum_delay_s = std::max(stats.maximum_delay_s, delay_s);
  stats.recent_delay_s = delay_s;
}

}  // namespace hapticwall::device
