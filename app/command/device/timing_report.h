// The report of 'hapticwall timing': table, histogram, verdict and advice.
#pragma once

#include <string>

#include "app/session/loop/timing_probe.h"
#include "app/session/loop/timing_verdict.h"

namespace hapticwall::command {

using session::TimingJudgement;
using session::TimingVerdict;

// Judges the loop by session::judge(), and a device. Good: no report missing, p99 of the age of
// positions up to 1.5 periods, p99 of the write time up to half a period, mean delay up to 2
// periods. Usable: one report in 1000 missing, 3 periods, 1 period and 5 periods. An unknown delay
// is poor, of a wheel usable.
[[nodiscard]] TimingJudgement judge_timing(const session::TimingPlan& plan,
                                           const session::TimingRecord& record, bool has_device);

// `device_name`: empty without a device.
[[nodiscard]] std::string timing_text(const session::TimingPlan& plan,
                                      const session::TimingRecord& record,
                                      const std::string& device_name);
// One object, with a line end; times in seconds.
[[nodiscard]] std::string timing_json(const session::TimingPlan& plan,
                                      const session::TimingRecord& record,
                                      const std::string& device_name);

}  // namespace hapticwall::command
