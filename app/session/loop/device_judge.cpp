#include "app/session/loop/device_judge.h"

#include <algorithm>
#include <utility>

namespace hapticwall::session {
namespace {

// A force that a filter holds just below the limit is at the limit, too.
constexpr double kFullForceMargin = 1.01;

}  // namespace

int full_force(double force_n, double force_limit_n) {
  const double share = force_n / force_limit_n * kFullForceMargin;
  return share >= 1.0 ? 1 : share <= -1.0 ? -1 : 0;
}

DeviceJudge::DeviceJudge(const device::DeviceInfo& info, const JudgeOptions& options)
    : options_(options),
      motion_(info),
      obedience_(info.encoder_m, options.rate_hz, info.untried_share),
      given_way_(info.motion.mass_kg, info.encoder_m) {}

void DeviceJudge::forget() {
  motion_.forget();
  clock_.forget();
  given_way_.forget();
}

// Every rule hears every tick; the first objection counts.
ArmingNote DeviceJudge::judge(const DeviceReading& reading, const device::LinkStats& link,
                              const JudgedTick& tick) {
  host_s_ += tick.elapsed_s;
  if (tick.armed != armed_) arm(tick.armed, link);
  const ArmingNote answered = answer(link);
  if (reading.state != DeviceState::kOk) {  // says so itself
    forget();
    return ArmingNote::kNone;
  }
  for (const ArmingNote note :
       {motion_.judge(reading, tick.elapsed_s, link.has_clock, tick.force_limit_n),
        clock(reading, link), answered, delay(link),
        obeys(reading.position_m, link.delay_s, tick)}) {
    if (note != ArmingNote::kNone) return note;
  }
  return ArmingNote::kNone;
}

void DeviceJudge::arm(bool armed, const device::LinkStats& link) {
  armed_ = armed;
  armed_delay_s_ = link.acknowledges ? link.delay_s : 0.0;
  late_answers_ = 0;
  obedience_.begin();
}

ArmingNote DeviceJudge::obeys(double position_m, double delay_s, const JudgedTick& tick) {
  const int full = tick.armed ? full_force(tick.force_n, tick.force_limit_n) : 0;
  const bool gave_way =
      given_way_.gives(position_m, tick.force_n, tick.force_limit_n, full, tick.elapsed_s);
  if (!tick.armed) return ArmingNote::kNone;
  obedience_.hear(position_m, tick.force_n, delay_s);
  if (obedience_.word() == Obedience::Word::kDisobeys) return ArmingNote::kWrongWay;
  return gave_way ? ArmingNote::kGivesWay : ArmingNote::kNone;
}

ArmingNote DeviceJudge::clock(const DeviceReading& reading, const device::LinkStats& link) {
  if (!link.has_clock) return ArmingNote::kNone;
  const ArmingNote note = clock_.hear(reading.device_time_s, host_s_ - reading.age_s);
  waits_for_answer_ = waits_for_answer_ || !clock_.known();
  return note;
}

// While the force is off, a poor delay is an objection; while it is on, a delay that has grown.
ArmingNote DeviceJudge::delay(const device::LinkStats& link) {
  const double period_s = 1.0 / options_.rate_hz;
  if (!armed_) {
    const bool poor = link.delay_s > kDelayTolerance * kUsableDelayTicks * period_s;
    return poor && !options_.allow_slow_device ? ArmingNote::kSlowDevice : ArmingNote::kNone;
  }
  if (armed_delay_s_ <= 0.0) return ArmingNote::kNone;
  if (std::exchange(answers_, link.applied_commands) != link.applied_commands) {
    const double growth_s = link.recent_delay_s - armed_delay_s_;
    const bool late = growth_s > kMaxDelayGrowthTicks * std::max(period_s, link.device_period_s);
    late_answers_ = late ? late_answers_ + 1 : 0;
  }
  return late_answers_ >= kMaxLateAnswers ? ArmingNote::kSlowerAnswer : ArmingNote::kNone;
}

ArmingNote DeviceJudge::answer(const device::LinkStats& link) {
  const std::uint64_t before = std::exchange(rejected_, link.rejected_commands);
  waits_for_answer_ =
      link.connected && link.acknowledges && link.force_word == device::ForceWord::kNone;
  if (!link.connected) return ArmingNote::kNone;
  if (!link.acknowledges) {
    return link.delay_s > kMaxCommandAgeS ? ArmingNote::kSlowAnswer : ArmingNote::kNone;
  }
  if (link.rejected_commands > before) return ArmingNote::kRejected;
  if (link.command_age_s > kMaxCommandAgeS) {
    // A slow device still acknowledges one command after the other.
    return link.unanswered_s > 0.5 * kMaxCommandAgeS ? ArmingNote::kNoAnswer
                                                     : ArmingNote::kSlowAnswer;
  }
  return force_word(link);
}

ArmingNote DeviceJudge::force_word(const device::LinkStats& link) const {
  const bool lasts = link.same_words > kMaxOtherWords;
  switch (link.force_word) {
    case device::ForceWord::kNotEnabled:
      return ArmingNote::kNotEnabled;
    case device::ForceWord::kNoForce:
      return ArmingNote::kNoForce;
    case device::ForceWord::kOther:
      return lasts ? ArmingNote::kOtherForce : ArmingNote::kNone;
    case device::ForceWord::kUnasked:
      return lasts ? ArmingNote::kUnaskedForce : ArmingNote::kNone;
    case device::ForceWord::kNone:
    case device::ForceWord::kSame:
      break;
  }
  return ArmingNote::kNone;
}

}  // namespace hapticwall::session
