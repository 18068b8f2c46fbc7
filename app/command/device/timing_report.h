// What 'hapticwall timing' says of a measurement: table, histogram, verdict and advice.
#pragma once

#include <string>

#include "app/runtime/timing_probe.h"
#include "app/runtime/timing_verdict.h"

namespace hapticwall::command {

using runtime::TimingJudgement;
using runtime::TimingVerdict;

// The loop as runtime::judge() has it. A device besides: good where every report came, 99 of 100
// positions are younger than a period and a half and 99 of 100 commands are written within half a
// period; usable with one report in 1000 missing, positions of three periods and commands of one.
[[nodiscard]] TimingJudgement judge_timing(const runtime::TimingPlan& plan,
                                           const runtime::TimingRecord& record, bool has_device);

// `what`: the device's name, or empty.
[[nodiscard]] std::string timing_text(const runtime::TimingPlan& plan,
                                      const runtime::TimingRecord& record, const std::string& what);
// One object, with a line end; times in seconds.
[[nodiscard]] std::string timing_json(const runtime::TimingPlan& plan,
                                      const runtime::TimingRecord& record, const std::string& what);

}  // namespace hapticwall::command
