// hapticwall timing: measures the timing of this machine, and of a device.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device/timing_report.h"
#include "app/command/device_choice.h"
#include "app/command/output_file.h"
#include "app/command/report/progress.h"
#include "app/command/signals.h"
#include "app/command/usage.h"
#include "app/session/loop/realtime_setup.h"
#include "core/result.h"
#include "core/scene_keys.h"

namespace hapticwall::command {
namespace {

constexpr double kMaxDurationS = 86'400.0;
// All measurements stay in memory: some hundred megabytes.
constexpr double kMaxTicks = 1e7;

struct TimingOptions {
  double seconds = 10.0;
  double rate_hz = 1000.0;
  double spin_us = 0.0;
  std::string device = kSimulator;
  OutputOptions output;
};

Result<session::TimingPlan> plan_of(const TimingOptions& options) {
  if (!(options.seconds > 0.0 && options.seconds <= kMaxDurationS)) {
    return usage_error(fmt::format("--seconds {}: it takes more than 0 and at most {:g}",
                                   options.seconds, kMaxDurationS));
  }
  const ValueRange& rates_hz = number_keys<SamplingSettings>().front().range;
  if (!rates_hz.contains(options.rate_hz)) {
    return usage_error(fmt::format("--rate {}: it takes {} to {} Hz", options.rate_hz,
                                   number_text(rates_hz.minimum), number_text(rates_hz.maximum)));
  }
  const double ticks = std::ceil(options.seconds * options.rate_hz);
  if (ticks > kMaxTicks) {
    return usage_error(
        fmt::format("--seconds {:g}: at {:g} Hz these are {:g} ticks; it measures at most {:g}",
                    options.seconds, options.rate_hz, ticks, kMaxTicks));
  }
  const Result<double> spin_s = spin_seconds(options.spin_us);
  if (!spin_s) return spin_s.error();
  session::TimingPlan plan;
  plan.spin_s = *spin_s;
  plan.rate_hz = options.rate_hz;
  plan.ticks = static_cast<std::uint64_t>(ticks);
  return plan;
}

Result<int> measure(const TimingOptions& options) {
  const Result<session::TimingPlan> plan = plan_of(options);
  if (!plan) return plan.error();
  const Result<DeviceChoice> choice = parse_device_choice(options.device);
  if (!choice) return choice.error();
  if (Failure failed = check_outputs(options.output, {file_of_device(options.device)}))
    return *failed;
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(options.output);
  if (!files) return files.error();
  std::unique_ptr<device::Device> device;
  if (choice->hardware) {
    device = make_device(*choice->hardware, Scene{});
    if (Failure failed = device->open()) return *failed;
  }
  const std::string name = device ? device->info().name : "";
  session::MonotonicClock clock;
  Progress progress("timing", !options.output.quiet);
  session::TimingRecord record =
      session::probe_timing(*plan, device.get(), clock, [&](std::uint64_t done) {
        progress.show(static_cast<double>(done) / static_cast<double>(plan->ticks));
        return stop_signal() != 0;
      });
  if (device) record.delay_date = device->info().delay_date;
  if (device) device->close();
  if (Failure failed =
          files->write({"", timing_json(*plan, record, name), timing_text(*plan, record, name)})) {
    return *failed;
  }
  if (stop_signal() == 0) return 0;
  return ended_early(fmt::format(" after {} of {} ticks: the numbers cover these",
                                 record.latency_ns.size(), plan->ticks));
}

}  // namespace

Command add_timing(CLI::App& program) {
  const auto options = std::make_shared<TimingOptions>();
  CLI::App* app =
      program.add_subcommand("timing", "Measure the timing of this machine, and of a device");
  app->add_option("--seconds", options->seconds, "Duration (default: 10)")
      ->type_name("S")
      ->check(is_number());
  app->add_option("--rate", options->rate_hz, "Ticks per second (default: 1000)")
      ->type_name("HZ")
      ->check(is_number());
  add_spin_option(*app, options->spin_us);
  app->add_option("--device", options->device,
                  "Measure a device, too: ie2000, ff, or one with :PATH; its force stays off")
      ->type_name("NAME");
  app->add_option("--json", options->output.json,
                  "Write the measurements as JSON; - is standard output")
      ->type_name("FILE");
  app->add_flag("--quiet", options->output.quiet, "Print errors only");
  return {app, [options] { return measure(*options); }};
}

}  // namespace hapticwall::command
