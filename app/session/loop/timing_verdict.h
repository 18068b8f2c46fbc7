// The verdict on a loop's timing, for `hapticwall timing` and the window.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/loop/latency_histogram.h"

namespace hapticwall::session {

// Best first.
enum class TimingVerdict : std::uint8_t { kGood, kUsable, kPoor };
[[nodiscard]] std::string_view timing_verdict_name(TimingVerdict verdict);

struct TimingJudgement {
  TimingVerdict verdict = TimingVerdict::kGood;
  std::vector<std::string> reasons;  // against a better verdict
  std::vector<std::string> advice;
};

// A measured value with its limits.
struct Measure {
  double value = 0.0;
  double good = 0.0;    // upper limit
  double usable = 0.0;  // upper limit
  std::string reason;
  std::string advice;  // may be empty; equal advice is given once
};
void judge(const Measure& measure, TimingJudgement& judgement);

struct LoopTiming {
  double rate_hz = 1000.0;
  Quantiles latency;  // quantiles of the wake-ups
  std::uint64_t missed_ticks = 0;
  std::string advice;  // advice on the real-time set-up; may be empty
};
// Good: no tick missed, and p99.9 of the wake-up latency within a tenth of the period. Usable: at
// most one tick in 10 000 missed, p99.9 within half a period.
void judge(const LoopTiming& loop, TimingJudgement& judgement);

}  // namespace hapticwall::session
