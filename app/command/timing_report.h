// What 'hapticwall timing' says of a measurement: table, histogram, verdict and advice.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/runtime/timing_probe.h"

namespace hapticwall::command {

// Best first.
enum class TimingVerdict : std::uint8_t { kGood, kUsable, kPoor };
[[nodiscard]] std::string_view timing_verdict_name(TimingVerdict verdict);

struct TimingJudgement {
  TimingVerdict verdict = TimingVerdict::kGood;
  std::vector<std::string> reasons;  // what kept it from a better one
  std::vector<std::string> advice;   // what may help
};

// Good: nothing missed, and 999 of 1000 wake-ups within a tenth of the period. Usable: at most one
// tick in 10 000 missed, 999 of 1000 within half of it. A device besides: good where every report
// came, 99 of 100 positions are younger than a period and a half and 99 of 100 commands are written
// within half a period; usable with one report in 1000 missing, positions of three periods and
// commands of one.
[[nodiscard]] TimingJudgement judge_timing(const runtime::TimingPlan& plan,
                                           const runtime::TimingRecord& record, bool has_device);

// `what`: the device's name, or empty.
[[nodiscard]] std::string timing_text(const runtime::TimingPlan& plan,
                                      const runtime::TimingRecord& record, const std::string& what);
// One object, with a line end; times in seconds.
[[nodiscard]] std::string timing_json(const runtime::TimingPlan& plan,
                                      const runtime::TimingRecord& record, const std::string& what);

}  // namespace hapticwall::command
