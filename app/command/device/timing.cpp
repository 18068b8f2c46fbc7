// hapticwall timing: how well this machine, and a device on it, keep time.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/output_file.h"
#include "app/command/progress.h"
#include "app/command/signals.h"
#include "app/command/terminal.h"
#include "app/command/timing_report.h"
#include "app/command/usage.h"
#include "app/runtime/realtime_setup.h"
#include "core/scene_keys.h"

namespace hapticwall::command {
namespace {

constexpr double kLongestS = 86'400.0;
// Every tick's figures are kept until the end: some hundred megabytes.
constexpr double kMostTicks = 1e7;

struct TimingOptions {
  double seconds = 10.0;
  double rate_hz = 1000.0;
  double spin_us = 0.0;
  std::string device = kSimulator;
  std::string json;
  bool quiet = false;
};

Result<runtime::TimingPlan> plan_of(const TimingOptions& options) {
  const auto refused = [](std::string message) {
    return Error{ErrorKind::kUsage, std::move(message)};
  };
  if (!(options.seconds > 0.0 && options.seconds <= kLongestS)) {
    return refused(fmt::format("--seconds {}: it takes more than 0 and at most {:g}",
                               options.seconds, kLongestS));
  }
  const ValueRange& rates_hz = sampling_number_keys().front().range;
  if (!rates_hz.contains(options.rate_hz)) {
    return refused(fmt::format("--rate {}: it takes {} to {} Hz", options.rate_hz,
                               number_text(rates_hz.minimum), number_text(rates_hz.maximum)));
  }
  const double ticks = std::ceil(options.seconds * options.rate_hz);
  if (ticks > kMostTicks) {
    return refused(fmt::format("--seconds {:g} at {:g} Hz are {:g} ticks; it measures at most {:g}",
                               options.seconds, options.rate_hz, ticks, kMostTicks));
  }
  const Result<double> spin_s = spin_seconds(options.spin_us);
  if (!spin_s) return spin_s.error();
  runtime::TimingPlan plan;
  plan.spin_s = *spin_s;
  plan.rate_hz = options.rate_hz;
  plan.ticks = static_cast<std::uint64_t>(ticks);
  return plan;
}

int measure(const TimingOptions& options) {
  const Result<runtime::TimingPlan> plan = plan_of(options);
  if (!plan) return report(plan.error());
  const Result<DeviceChoice> choice = parse_device_choice(options.device);
  if (!choice) return report(choice.error());
  catch_stop_signals();
  OutputFile json;
  if (const Failure failed = json.open(options.json)) return report(*failed);
  std::unique_ptr<device::Device> device;
  if (choice->hardware) {
    device = make_device(*choice->hardware, Scene{});
    if (const Failure failed = device->open()) return report(*failed);
  }
  const std::string what = device ? device->info().name : "";
  runtime::MonotonicClock clock;
  Progress progress("timing", !options.quiet);
  const runtime::TimingRecord record =
      runtime::probe_timing(*plan, device.get(), clock, [&](std::uint64_t done) {
        progress.show(static_cast<double>(done) / static_cast<double>(plan->ticks));
        return stop_signal() != 0;
      });
  if (device) device->close();
  if (const Failure failed = json.write_whole(timing_json(*plan, record, what))) {
    return report(*failed);
  }
  Failure failed;
  if (options.json == kStandardOutput) {
    failed = write_output(timing_json(*plan, record, what));
  } else if (!options.quiet) {
    failed = write_output(timing_text(*plan, record, what));
  }
  if (failed) return report(*failed);
  if (stop_signal() == 0) return 0;
  tell(fmt::format("ended early by {} after {} of {} ticks: the figures are of these",
                   signal_name(stop_signal()), record.latency_ns.size(), plan->ticks));
  return signal_exit_status(stop_signal());
}

}  // namespace

Command add_timing(CLI::App& program) {
  const auto options = std::make_shared<TimingOptions>();
  CLI::App* app = program.add_subcommand(
      "timing", "Measure how well this machine, and a device on it, keep time");
  app->add_option("--seconds", options->seconds, "How long (default: 10)")
      ->type_name("S")
      ->check(is_number());
  app->add_option("--rate", options->rate_hz, "Ticks a second (default: 1000)")
      ->type_name("HZ")
      ->check(is_number());
  add_spin_option(*app, options->spin_us);
  app->add_option("--device", options->device,
                  "A device too: ie2000, or ie2000:PATH; its force stays off")
      ->type_name("NAME");
  app->add_option("--json", options->json, "Write the figures as JSON; - is standard output")
      ->type_name("FILE");
  app->add_flag("--quiet", options->quiet, "No table and no progress, errors only");
  return {app, [options] { return measure(*options); }};
}

}  // namespace hapticwall::command
