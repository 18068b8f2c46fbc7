#include "app/session/loop/timing_verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/session/loop/clock.h"
#include "core/units.h"

namespace hapticwall::session {
namespace {

struct LoopMarks {
  double latency;       // share of the period
  double missed_ticks;  // share of all ticks
};
constexpr LoopMarks kGood{0.1, 0.0};
constexpr LoopMarks kUsable{0.5, 1e-4};

}  // namespace

std::string_view timing_verdict_name(TimingVerdict verdict) {
  switch (verdict) {
    case TimingVerdict::kGood:
      return "good";
    case TimingVerdict::kUsable:
      return "usable";
    case TimingVerdict::kPoor:
      break;
  }
  return "poor";
}

void judge(const Measure& measure, TimingJudgement& judgement) {
  if (measure.value <= measure.good) return;
  const TimingVerdict verdict =
      measure.value <= measure.usable ? TimingVerdict::kUsable : TimingVerdict::kPoor;
  judgement.verdict = std::max(judgement.verdict, verdict);
  judgement.reasons.push_back(measure.reason);
  if (!measure.advice.empty() && std::find(judgement.advice.begin(), judgement.advice.end(),
                                           measure.advice) == judgement.advice.end()) {
    judgement.advice.push_back(measure.advice);
  }
}

void judge(const LoopTiming& loop, TimingJudgement& judgement) {
  const std::string advice = loop.advice.empty()
                                 ? "close other busy programs; a virtual machine or a laptop on "
                                   "battery cannot meet its deadlines better"
                                 : loop.advice;
  const double period_ns = kNanosecondsPerSecond / loop.rate_hz;
  const auto late_ns = static_cast<double>(loop.latency.p999_ns);
  judge(Measure{late_ns, kGood.latency * period_ns, kUsable.latency * period_ns,
                fmt::format("one wake-up in 1000 is {:.0f} us late or more",
                            late_ns / kNanosecondsPerMicrosecond),
                advice},
        judgement);
  const std::uint64_t planned = loop.latency.count + loop.missed_ticks;
  const double missed =
      planned == 0 ? 0.0 : static_cast<double>(loop.missed_ticks) / static_cast<double>(planned);
  judge(Measure{missed, kGood.missed_ticks, kUsable.missed_ticks,
                fmt::format("{} of {} ticks were missed", loop.missed_ticks, planned), advice},
        judgement);
}

}  // namespace hapticwall::session
