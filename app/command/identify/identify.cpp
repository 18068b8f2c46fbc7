// hapticwall identify: mass, damping, friction and delay of a device.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/report/terminal.h"
#include "app/command/run/realtime_run.h"
#include "app/command/signals.h"
#include "app/command/usage.h"
#include "app/draw/figure/identify_figure.h"
#include "app/file/text/text.h"
#include "app/session/identify_experiment.h"
#include "app/session/loop/clock.h"
#include "app/table/identify_report.h"

namespace hapticwall::command {
namespace {

constexpr std::chrono::seconds kTimeToLetGo{3};

struct IdentifyRun {
  const Scene& scene;                        // one axis without hand and walls
  session::IdentifyExperiment& experiment;   // with the rate, limit and encoder of the scene
  std::unique_ptr<device::Device> device{};  // not open yet; nullptr: the simulator
  bool allow_no_realtime = false;
  bool allow_slow_device = false;
  bool show_progress = false;
};

struct IdentifyOutcome {
  std::uint64_t missed_ticks = 0;
  bool stopped_early = false;
};

// Time that passes fast, for a simulator. It sleeps now and then, so that the owner gets a core and
// takes the ticks.
class HastyClock final : public session::Clock {
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

// Arms the device, waits for its whole force and runs the experiment. A device that is lost or
// disarmed, and an experiment that stopped by itself, are an error (ErrorKind::kDevice). The force
// is zero when this returns. A simulator takes no time.
Result<IdentifyOutcome> run_experiment(IdentifyRun run) {
  session::IdentifyExperiment& experiment = run.experiment;
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
       .ends = [&](const session::Snapshot& snapshot) { return experiment.look(snapshot); }});
  if (!result) return result.error();
  IdentifyOutcome outcome;
  outcome.missed_ticks = result->summary.front().missed_ticks.value_or(0);
  if (result->trouble) return *result->trouble;
  outcome.stopped_early = result->stopped_early && stop_signal() != 0;
  if (outcome.stopped_early) return outcome;
  if (Failure trouble = experiment.trouble()) return *trouble;
  return outcome;
}

struct IdentifyOptions {
  SceneOptions scene;
  OutputOptions output;
  session::IdentifyChoice choice;
};

// The device's own information before the experiment.
Result<device::DeviceInfo> info_of(const DeviceChoice& choice, const Scene& scene) {
  if (!choice.hardware) return session::info_on({"simulator", true}, scene);
  const std::unique_ptr<device::Device> device = make_device(*choice.hardware, scene);
  if (Failure failed = device->open()) return *failed;
  const device::DeviceInfo info = device->info();
  device->close();
  return info;
}

// False after a stop signal.
bool ask_to_let_go(const identify::ExperimentSettings& experiment, bool waits) {
  tell(session::let_go_text(experiment) + "; Ctrl-C ends it with the force off");
  const auto end = std::chrono::steady_clock::now() + kTimeToLetGo;
  while (waits && stop_signal() == 0 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return stop_signal() == 0;
}

// Writes everything; a model that does not fit is an error without a device file.
Result<int> report(const IdentifyOptions& options, const table::IdentifiedBy& by,
                   const identify::Identification& found, const identify::Record& record,
                   OutputFiles& files, OutputFile& device_file, file::DeviceDescription device) {
  const auto draw = [&](const draw::Paper& paper) {
    return draw::draw_identification(record, found, paper);
  };
  if (Failure failed = files.write(
          {"", table::identify_json(by, found), table::identify_text(by, found)}, draw)) {
    return *failed;
  }
  if (!found.fits) return device_error(table::misfit_text(by));
  if (Failure failed = device_file.write_whole(
          device_to_toml(table::identified_device(std::move(device), by, found)))) {
    return *failed;
  }
  if (!options.output.device_file.empty() && !options.output.quiet) {
    tell(table::written_text(options.output.device_file));
  }
  return 0;
}

// A device file may be replaced by the file of the numbers found with it.
std::string library_of(const IdentifyOptions& options) {
  return names_device_plugin(options.scene.device) ? file_of_device(options.scene.device) : "";
}

Result<int> identify_device(const IdentifyOptions& options) {
  const Result<DeviceChoice> choice = parse_device_choice(options.scene.device);
  if (!choice) return choice.error();
  const std::string why = session::why_not_identified(options.scene.device, choice->description);
  if (!why.empty()) return usage_error(why);
  const Result<file::LoadedScene> loaded = load(options.scene);
  if (!loaded) return loaded.error();
  if (Failure failed = check_outputs(options.output, {options.scene.scene, library_of(options)}))
    return *failed;
  if (Failure failed = check_scene_files(options.output, *loaded)) return *failed;
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(options.output);
  if (!files) return files.error();
  OutputFile device_file;
  if (Failure failed = device_file.open(options.output.device_file)) return *failed;
  const Result<device::DeviceInfo> info = info_of(*choice, loaded->scene);
  if (!info) return info.error();
  const auto settings =
      session::experiment_settings(options.choice, *info, loaded->scene.sampling.rate_hz);
  if (!settings) return settings.error();
  const Scene scene = session::identify_scene(loaded->scene, *settings);
  const bool moves = choice->hardware.has_value();
  if ((moves || !options.output.quiet) && !ask_to_let_go(*settings, moves)) return ended_early();
  session::IdentifyExperiment experiment(*settings);
  const Result<IdentifyOutcome> outcome =
      run_experiment({.scene = scene,
                      .experiment = experiment,
                      .device = choice->hardware ? make_device(*choice->hardware, scene) : nullptr,
                      .allow_no_realtime = options.scene.allow_no_realtime,
                      .allow_slow_device = options.scene.allow_slow_device,
                      .show_progress = !options.output.quiet});
  if (!outcome) return outcome.error();
  if (outcome->stopped_early) return ended_early();
  const identify::Record record = experiment.record();
  const auto found = identify::identify(record, experiment.facts());
  if (stop_signal() != 0) return ended_early();
  if (!found) return device_error(std::string(session::kTooFewStrokes));
  const table::IdentifiedBy by{
      info->name,           file::utc_now(),          settings->force_limit_n,
      settings->duration_s, experiment.facts().turns, outcome->missed_ticks};
  return report(
      options, by, *found, record, *files, device_file,
      session::identified_description(choice->description, options.scene.device, *info, scene));
}

}  // namespace

Command add_identify(CLI::App& program) {
  const auto options = std::make_shared<IdentifyOptions>();
  options->scene.scene = kDefaultScene;
  CLI::App* app = program.add_subcommand(
      "identify", "Find mass, damping, friction and delay of a device; it moves by itself");
  app->add_option("SCENE", options->scene.scene,
                  "The scene of a simulated device, without its hand and walls (default: press)");
  add_scene_options(*app, options->scene);
  add_device_options(*app, options->scene);
  app->add_option("--limit", options->choice.limit_n,
                  "Largest force (default: 20 % of the device's, at most 2 N)")
      ->type_name("N")
      ->check(is_number_within(session::kIdentifyLimitN.minimum, session::kIdentifyLimitN.maximum));
  app->add_option("--travel", options->choice.travel_m,
                  "Travel to both sides of the start (default: 0.018)")
      ->type_name("M")
      ->check(
          is_number_within(session::kIdentifyTravelM.minimum, session::kIdentifyTravelM.maximum));
  app->add_option("--seconds", options->choice.seconds, "Duration of the strokes (default: 25)")
      ->type_name("S")
      ->check(
          is_number_within(session::kIdentifySeconds.minimum, session::kIdentifySeconds.maximum));
  app->add_option("--device-file", options->output.device_file,
                  "Write a device file that scenes name: NAME.toml")
      ->type_name("FILE");
  add_plot_option(*app, options->output, "Draw the record, the model and the residuals as PNG");
  app->add_option("--json", options->output.json, "Write the result as JSON; - is standard output")
      ->type_name("FILE");
  app->add_flag("--quiet", options->output.quiet, "Print errors only");
  return {app, [options] { return identify_device(*options); }};
}

}  // namespace hapticwall::command
