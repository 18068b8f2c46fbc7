#include "app/command/identify/identify_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "app/command/identify/experiment_law.h"
#include "app/runtime/loop/arming.h"
#include "app/runtime/loop/clock.h"

namespace hapticwall::command {
namespace {

constexpr double kBeforeStrokesS = 8.0;  // arming, rest and ramps take less
constexpr double kFinestEncoderM = 1e-7;

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

bool has_whole_force(const runtime::ArmingStatus& arming) {
  return arming.state == runtime::ArmingState::kOn ||
         arming.state == runtime::ArmingState::kNotNeeded;
}

// The ticks of the experiment alone.
identify::Record cut_record(identify::Record record, const ExperimentLaw& law) {
  const auto first = static_cast<std::ptrdiff_t>(law.first_tick());
  const auto count = static_cast<std::ptrdiff_t>(law.facts().ticks);
  for (std::vector<double>* values : {&record.position_m, &record.force_n}) {
    const auto end =
        std::min<std::ptrdiff_t>(first + count, static_cast<std::ptrdiff_t>(values->size()));
    *values = std::vector<double>(values->begin() + std::min(first, end), values->begin() + end);
  }
  return record;
}

Failure trouble_of(const RealtimeOutcome& run, const ExperimentLaw& law) {
  if (run.trouble) return run.trouble;
  if (!law.ended()) return device_error("the experiment did not come to its end in time");
  const std::string_view trouble = identify::experiment_trouble(law.facts().state);
  if (trouble.empty()) return {};
  return device_error(fmt::format("the experiment ended with the force off: {}", trouble));
}

}  // namespace

double longest_session_s(const identify::ExperimentSettings& experiment) {
  return experiment.duration_s + kBeforeStrokesS;
}

Result<IdentifyOutcome> run_experiment(IdentifyRun run) {
  ExperimentLaw law(run.experiment);
  HastyClock hasty;
  IdentifyOutcome outcome;
  identify::Record record;
  record.period_s = run.scene.sampling.period_s();
  const bool simulated = !run.device;
  if (simulated) law.begin();
  Result<RealtimeOutcome> result =
      run_realtime({.scene = run.scene,
                    .on_tick =
                        [&](const Tick& tick) {
                          record.position_m.push_back(tick.x().position_m);
                          record.force_n.push_back(tick.x().force_n);
                        },
                    .device = std::move(run.device),
                    .arm = !simulated,
                    .allow_no_realtime = run.allow_no_realtime,
                    .show_progress = run.show_progress,
                    .law = &law,
                    .clock = simulated ? &hasty : nullptr,
                    .ends =
                        [&](const runtime::Snapshot& snapshot) {
                          if (has_whole_force(snapshot.arming)) law.begin();
                          return law.ended();
                        }});
  if (!result) return result.error();
  outcome.missed_ticks = result->summary.front().missed_ticks.value_or(0);
  outcome.stopped_early = !law.ended() && !result->trouble && result->stopped_early;
  if (outcome.stopped_early) return outcome;
  if (Failure trouble = trouble_of(*result, law)) return *trouble;
  outcome.facts = law.facts();
  outcome.record = cut_record(std::move(record), law);
  outcome.record.encoder_m = run.experiment.encoder_m;
  if (outcome.record.encoder_m <= 0.0) {
    outcome.record.encoder_m =
        std::max(identify::smallest_step(outcome.record.position_m), kFinestEncoderM);
  }
  return outcome;
}

}  // namespace hapticwall::command
