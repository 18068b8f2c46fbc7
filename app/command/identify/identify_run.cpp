#include "app/command/identify/identify_run.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "app/command/signals.h"
#include "app/runtime/loop/clock.h"

namespace hapticwall::command {
namespace {

// Time that passes fast, for a simulator. It sleeps now and then, so that the owner gets a core and
// takes the ticks.
class HastyClock final : public runtime::Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() override { return now_ns_; }
  void sleep_until_ns(std::int64_t deadline_ns) override {
    constexpr std::int64_t kRestNs = 5'000'000;
    constexpr std::uint32_t kTicksAtOnce = 256;
    if (deadline_ns - now_ns_ > kRestNs || ++ticks_ % kTicksAtOnce == 0) {
      std::this_thread::sleep_for(std::chrono::microseconds(400));
    }
    now_ns_ = std::max(now_ns_, deadline_ns);
  }

 private:
  std::int64_t now_ns_ = 0;
  std::uint32_t ticks_ = 0;
};

}  // namespace

Result<IdentifyOutcome> run_experiment(IdentifyRun run) {
  runtime::IdentifyExperiment& experiment = run.experiment;
  HastyClock hasty;
  const bool simulated = !run.device;
  if (simulated) experiment.begin();
  Result<RealtimeOutcome> result = run_realtime(
      {.scene = run.scene,
       .on_tick = [&](const Tick& tick) { experiment.add(tick); },
       .device = std::move(run.device),
       .arm = !simulated,
       .allow_no_realtime = run.allow_no_realtime,
       .allow_slow_device = run.allow_slow_device,
       .show_progress = run.show_progress,
       .borrowed = &experiment.algorithm(),
       .clock = simulated ? &hasty : nullptr,
       .ends = [&](const runtime::Snapshot& snapshot) { return experiment.look(snapshot); }});
  if (!result) return result.error();
  IdentifyOutcome outcome;
  outcome.missed_ticks = result->summary.front().missed_ticks.value_or(0);
  if (result->trouble) return *result->trouble;
  outcome.stopped_early = result->stopped_early && stop_signal() != 0;
  if (outcome.stopped_early) return outcome;
  if (Failure trouble = experiment.trouble()) return *trouble;
  return outcome;
}

}  // namespace hapticwall::command
