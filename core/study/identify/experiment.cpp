#include "core/study/identify/experiment.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::identify {
namespace {

constexpr double kRestSlackM = 1e-3;
constexpr double kMotionM = 0.4e-3;
constexpr double kMotionCounts = 3.0;
constexpr double kMaxSpeedMPerS = 3.0;

constexpr double kRampStart = 0.005;  // shares of the force limit
constexpr double kRampEnd = 0.95;
constexpr double kRampTimeS = 0.35;

constexpr double kGrowth = 1.25;
constexpr double kShortHalfPeriodS = 0.15;
constexpr std::uint32_t kSettledStrokes = 4;
constexpr double kLearning = 0.7;
constexpr double kFirstThreshold = 0.25;  // share of the peak
constexpr std::array kLevelShares{1.0, 0.72, 0.5};
constexpr double kCoastingShare = 0.3;
constexpr double kCoastStallS = 0.06;

constexpr double kFrozenS = 0.6;
constexpr double kMaxStrokeS = 2.5;
constexpr std::uint32_t kMaxShortStrokes = 8;
constexpr double kGuard = 1.95;  // multiple of the peak
constexpr double kFarthest = 2.8;
constexpr std::uint32_t kMaxGuards = 10;

constexpr std::array<std::string_view, 9> kTroubles{
    "",
    "",
    "the handle moved before the force was on; let go of it and start again",
    "a positive force moved the handle towards larger positions; exchange the sign of the force in "
    "the firmware",
    "the handle did not move at 95 % of the force; its friction exceeds the force, or the position "
    "is frozen; check the device, or raise the limit",
    "the position jumped farther than the handle can move; check the encoder",
    "the position stayed while the force was on; check the encoder and the amplifier, and keep "
    "hands off",
    "the handle did not reach its travel; let go of it and clear its way",
    "the handle went too far; check the sign of the force, and keep hands off"};

}  // namespace

std::string_view experiment_trouble(ExperimentState state) {
  return kTroubles.at(static_cast<std::size_t>(state));
}

Experiment::Experiment(const ExperimentSettings& settings)
    : settings_(settings),
      hysteresis_m_(std::max(kMotionCounts * settings.encoder_m, kMotionM)),
      random_(settings.seed) {
  for (auto& sides : threshold_m_) sides.fill(kFirstThreshold * settings_.peak_m);
}

double Experiment::seconds(std::uint64_t ticks) const {
  return static_cast<double>(ticks) / settings_.rate_hz;
}

double Experiment::progress() const {
  if (facts_.state != ExperimentState::kRunning) return 1.0;
  if (facts_.first_stroke_tick == 0) return 0.0;
  return std::min(1.0, seconds(facts_.ticks - facts_.first_stroke_tick) / settings_.duration_s);
}

double Experiment::break_away_n() const {
  return std::max(facts_.break_away_n[0], facts_.break_away_n[1]);
}

// Enough to move, and not more than it needs.
double Experiment::largest_n() const {
  const double limit_n = settings_.force_limit_n;
  return std::max(0.2 * limit_n, std::min(1.6 * break_away_n() + 0.03 * limit_n, 0.9 * limit_n));
}

double Experiment::level_n() const {
  return break_away_n() + (amplitude_n_ - break_away_n()) * kLevelShares[level_];
}

double Experiment::step(double position_m) {
  if (facts_.state != ExperimentState::kRunning) return 0.0;
  look_at(position_m);
  switch (phase_) {
    case Phase::kStill:
      rest(position_m);
      break;
    case Phase::kRamp:
      ramp();
      break;
    case Phase::kDrive:
      drive();
      break;
    case Phase::kCoast:
      coast();
      break;
    case Phase::kBrake:
      brake();
      break;
  }
  if (facts_.first_stroke_tick > 0) watch_strokes();
  ++facts_.ticks;
  if (facts_.state != ExperimentState::kRunning) return 0.0;
  return settings_.force_step_n * std::round(force() / settings_.force_step_n);
}

double Experiment::force() const {
  switch (phase_) {
    case Phase::kStill:
    case Phase::kCoast:
      return 0.0;
    case Phase::kRamp: {
      const double share = kRampStart * std::exp(seconds(facts_.ticks - phase_tick_) / kRampTimeS);
      return -side_ * settings_.force_limit_n * std::min(share, kRampEnd);
    }
    case Phase::kDrive:
      return -side_ * level_n();
    case Phase::kBrake:
      return side_ * level_n();
  }
  return 0.0;
}

void Experiment::look_at(double position_m) {
  if (facts_.ticks == 0) start_m_ = previous_m_ = lowest_m_ = highest_m_ = position_m;
  const double reach_m = kMaxSpeedMPerS / settings_.rate_hz + hysteresis_m_;
  if (!(std::abs(position_m - previous_m_) <= reach_m)) end(ExperimentState::kJumped);
  previous_m_ = position_m;
  along_m_ = side_ * (position_m - start_m_);
}

// Mean and variance by Welford's method.
void Experiment::rest(double position_m) {
  const auto count = static_cast<double>(facts_.ticks + 1);
  const double from_mean_m = position_m - facts_.rest_mean_m;
  facts_.rest_mean_m += from_mean_m / count;
  facts_.rest_variance_m2 +=
      (from_mean_m * (position_m - facts_.rest_mean_m) - facts_.rest_variance_m2) / count;
  lowest_m_ = std::min(lowest_m_, position_m);
  highest_m_ = std::max(highest_m_, position_m);
  facts_.rest_range_m = highest_m_ - lowest_m_;
  if (facts_.rest_range_m > kRestSlackM + 2.0 * settings_.encoder_m) {
    end(ExperimentState::kNotAtRest);
  }
  if (seconds(facts_.ticks) < kStillS) return;
  hysteresis_m_ = std::max(hysteresis_m_, 2.0 * facts_.rest_range_m);
  start_ramp(1.0);
}

void Experiment::start_ramp(double side) {
  along_m_ *= side * side_;
  side_ = side;
  phase_ = Phase::kRamp;
  phase_tick_ = facts_.ticks;
  extreme_m_ = along_m_;
}

void Experiment::ramp() {
  extreme_m_ = std::min(extreme_m_, along_m_);
  const bool first = side_ > 0.0;
  if (first && along_m_ <= -hysteresis_m_) return end(ExperimentState::kWrongSign);
  if (std::abs(along_m_) > kFarthest * settings_.peak_m) return end(ExperimentState::kTooFar);
  const double force_n = std::abs(force());
  if (along_m_ - extreme_m_ >= hysteresis_m_) {
    facts_.break_away_n[first ? 1 : 0] = force_n;
    if (first) return start_ramp(-1.0);
    amplitude_n_ = std::min(kGrowth * break_away_n() + 0.02 * settings_.force_limit_n, largest_n());
    if (amplitude_n_ <= break_away_n()) return end(ExperimentState::kNoMotion);
    facts_.first_stroke_tick = facts_.ticks;
    return start_stroke(-1.0, 0);
  }
  if (force_n >= kRampEnd * settings_.force_limit_n) end(ExperimentState::kNoMotion);
}

void Experiment::start_stroke(double side, std::size_t level) {
  along_m_ *= side * side_;
  side_ = side;
  level_ = level;
  phase_ = Phase::kDrive;
  stroke_tick_ = facts_.ticks;
  anchor_m_ = previous_m_;
  anchor_tick_ = facts_.ticks;
  coasts_ = false;
}

void Experiment::drive() {
  if (coasts_ && along_m_ >= coast_from_m_) {
    phase_ = Phase::kCoast;
    extreme_m_ = along_m_;
    extreme_tick_ = facts_.ticks;
  }
  if (along_m_ < threshold()) return;
  phase_ = Phase::kBrake;
  extreme_m_ = along_m_;
}

void Experiment::coast() {
  if (along_m_ > extreme_m_) {
    extreme_m_ = along_m_;
    extreme_tick_ = facts_.ticks;
  }
  const bool stalls = seconds(facts_.ticks - extreme_tick_) > kCoastStallS;
  if (along_m_ >= threshold() || stalls) phase_ = Phase::kBrake;
  anchor_m_ = previous_m_;
  anchor_tick_ = facts_.ticks;
}

void Experiment::brake() {
  extreme_m_ = std::max(extreme_m_, along_m_);
  if (extreme_m_ - along_m_ >= hysteresis_m_) turn();
}

// The threshold learns from a stroke without coasting, whose peak it determined.
void Experiment::turn() {
  ++facts_.turns;
  const double peak_m = settings_.peak_m;
  if (!coasts_) {
    learn_from(extreme_m_);
    const bool is_short = std::abs(extreme_m_ - peak_m) > 0.5 * peak_m;
    short_strokes_ = is_short ? short_strokes_ + 1 : 0;
  }
  const double half_period_s = seconds(facts_.ticks - stroke_tick_);
  if (aim_ == Aim::kGrow) {
    grow(half_period_s);
    start_stroke(-side_, 0);
  } else {
    choose_stroke();
  }
}

void Experiment::learn_from(double peak_m) {
  const double wanted_m = settings_.peak_m;
  threshold() =
      std::clamp(threshold() + kLearning * (wanted_m - peak_m), -0.9 * wanted_m, 0.95 * wanted_m);
}

void Experiment::grow(double half_period_s) {
  const double largest_n = this->largest_n();
  if (half_period_s > kShortHalfPeriodS && amplitude_n_ < largest_n) {
    amplitude_n_ = std::min(amplitude_n_ * kGrowth, largest_n);
    settled_strokes_ = 0;
  } else if (++settled_strokes_ >= kSettledStrokes) {
    aim_ = Aim::kRandom;
    threshold_m_.fill(threshold_m_[0]);
  }
}

double Experiment::chance() {
  constexpr auto kValues = static_cast<double>(std::minstd_rand::max());
  return static_cast<double>(random_() - std::minstd_rand::min()) / kValues;
}

void Experiment::choose_stroke() {
  start_stroke(-side_, static_cast<std::size_t>(chance() * static_cast<double>(kLevels)));
  coasts_ = chance() < kCoastingShare;
  coast_from_m_ = settings_.peak_m * (chance() - 0.5);
}

void Experiment::watch_strokes() {
  if (facts_.state != ExperimentState::kRunning) return;
  if (seconds(facts_.ticks - facts_.first_stroke_tick) >= settings_.duration_s) {
    return end(ExperimentState::kDone);
  }
  if (std::abs(previous_m_ - anchor_m_) >= hysteresis_m_) {
    anchor_m_ = previous_m_;
    anchor_tick_ = facts_.ticks;
  }
  if (seconds(facts_.ticks - anchor_tick_) > kFrozenS) return end(ExperimentState::kFrozen);
  if (seconds(facts_.ticks - stroke_tick_) > kMaxStrokeS || short_strokes_ > kMaxShortStrokes) {
    return end(ExperimentState::kTravelNotReached);
  }
  const double from_start_m = previous_m_ - start_m_;
  if (std::abs(from_start_m) > kFarthest * settings_.peak_m) return end(ExperimentState::kTooFar);
  if (side_ * from_start_m <= kGuard * settings_.peak_m) return;
  // The guard: back with the full amplitude.
  if (++guards_ > kMaxGuards) return end(ExperimentState::kTooFar);
  learn_from(kGuard * settings_.peak_m);
  start_stroke(-side_, 0);
}

void Experiment::end(ExperimentState why) {
  if (facts_.state == ExperimentState::kRunning) facts_.state = why;
}

}  // namespace hapticwall::identify
