// Whether a loop keeps its time: one verdict for `hapticwall timing` and for the window.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/runtime/quantiles.h"

namespace hapticwall::runtime {

// Best first.
enum class TimingVerdict : std::uint8_t { kGood, kUsable, kPoor };
[[nodiscard]] std::string_view timing_verdict_name(TimingVerdict verdict);

struct TimingJudgement {
  TimingVerdict verdict = TimingVerdict::kGood;
  std::vector<std::string> reasons;  // what kept it from a better one
  std::vector<std::string> advice;   // what may help
};

// One thing that is measured against its marks: what it is, and what may help where it is too much.
struct Measure {
  double value = 0.0;
  double good = 0.0;    // at most
  double usable = 0.0;  // at most
  std::string reason;
  std::string advice;  // said once, however many measures have it; may be empty
};
void judge(const Measure& measure, TimingJudgement& judgement);

struct LoopTiming {
  double rate_hz = 1000.0;
  Quantiles latency;  // of the wake-ups
  std::uint64_t missed_ticks = 0;
  std::string advice;  // of the real-time set-up; empty where there is none
};
// Good: nothing missed, and 999 of 1000 wake-ups within a tenth of the period. Usable: at most one
// tick in 10 000 missed, 999 of 1000 within half of it.
void judge(const LoopTiming& loop, TimingJudgement& judgement);

}  // namespace hapticwall::runtime
