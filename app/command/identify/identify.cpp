// hapticwall identify: mass, damping, friction and delay of a device.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <thread>
#include <variant>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/identify/identify_report.h"
#include "app/command/identify/identify_run.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/command/usage.h"
#include "app/draw/figure/identify_figure.h"
#include "app/file/text/text.h"
#include "core/stabiliser/stabiliser.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

constexpr double kDefaultLimitN = 2.0;  // without --limit never more
constexpr double kDefaultShare = 0.2;   // of the device's force
constexpr std::chrono::seconds kTimeToLetGo{3};

struct IdentifyOptions {
  SceneOptions scene;
  OutputOptions output;
  double limit_n = 0.0;  // 0: the default
  double travel_m = 0.018;
  double seconds = 25.0;
};

// What the device says of itself before the experiment.
struct Facts {
  std::string name;
  double encoder_m = 0.0;
  double force_limit_n = 0.0;  // 0: unknown
};

Result<Facts> facts_of(const DeviceChoice& choice, const Scene& scene) {
  const DeviceSettings& own = scene.x().device;
  if (!choice.hardware) {
    return Facts{"simulator", own.encoder_m.value_or(0.0), own.force_limit_n.value_or(0.0)};
  }
  const std::unique_ptr<device::Device> device = make_device(*choice.hardware, scene);
  if (Failure failed = device->open()) return *failed;
  const device::DeviceInfo info = device->info();
  device->close();
  return Facts{info.name, info.encoder_m, info.force_limit_n};
}

Result<double> limit_of(const IdentifyOptions& options, const Facts& facts) {
  if (options.limit_n == 0.0) {
    if (facts.force_limit_n <= 0.0) return kDefaultLimitN;
    return std::min(kDefaultLimitN, kDefaultShare * facts.force_limit_n);
  }
  if (facts.force_limit_n <= 0.0 || options.limit_n <= facts.force_limit_n) {
    return options.limit_n;
  }
  return usage_error(fmt::format("--limit {:g}: the device gives at most {:g} N", options.limit_n,
                                 facts.force_limit_n));
}

// The device alone: no hand, no wall.
Scene scene_for(const Scene& loaded, const identify::ExperimentSettings& experiment) {
  Scene scene;
  scene.name = "identify";
  scene.duration_s = longest_session_s(experiment);
  scene.sampling = loaded.sampling;
  scene.simulator = loaded.simulator;
  scene.x().device = loaded.x().device;
  scene.x().device.force_limit_n = experiment.force_limit_n;
  scene.x().walls.clear();
  scene.algorithm.index = *find_algorithm("none");
  return scene;
}

// False after a stop signal.
bool ask_to_let_go(const identify::ExperimentSettings& experiment, bool waits) {
  tell(fmt::format(
      "let go of the handle: it moves by itself for {:.0f} s, {:.0f} mm to both sides, at up to "
      "{:.2g} N; Ctrl-C ends it with the force off",
      longest_session_s(experiment), experiment.peak_m * kMillimetresPerMetre,
      experiment.force_limit_n));
  const auto end = std::chrono::steady_clock::now() + kTimeToLetGo;
  while (waits && stop_signal() == 0 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return stop_signal() == 0;
}

std::string utc_date() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[sizeof "9999-12-31T23:59:59Z"] = {};
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

file::DeviceDescription described(const IdentifyOptions& options, const DeviceChoice& choice,
                                  const Facts& facts, const Scene& scene) {
  file::DeviceDescription device;
  if (choice.description) return *choice.description;
  device.name = facts.name;
  device.source = "hapticwall identify --device " + options.scene.device;
  device.rate_hz = scene.sampling.rate_hz;
  device.x.force_limit_n =
      facts.force_limit_n > 0.0 ? facts.force_limit_n : *scene.x().device.force_limit_n;
  return device;
}

// Writes everything; a model that does not fit is an error without a device file.
Result<int> report(const IdentifyOptions& options, const IdentifiedBy& by,
                   const identify::Identification& found, const identify::Record& record,
                   OutputFiles& files, OutputFile& device_file, file::DeviceDescription device) {
  const auto draw = [&](draw::Ink ink) {
    return draw::draw_identification(record, found, draw::kIdentificationSize.in(ink));
  };
  if (Failure failed =
          files.write({"", identify_json(by, found), identify_text(by, found)}, draw)) {
    return *failed;
  }
  if (!found.fits) {
    return device_error(fmt::format(
        "{}: this model does not fit, so there are no numbers; let go of the handle, clear its "
        "way, and look for play",
        by.device));
  }
  if (device.x.encoder_m <= 0.0) device.x.encoder_m = found.encoder_m;
  if (Failure failed = device_file.write_whole(
          device_to_toml(identified_device(std::move(device), by, found)))) {
    return *failed;
  }
  if (!options.output.device_file.empty() && !options.output.quiet) {
    tell(fmt::format("{}: written; a scene names it with device = \"{}\"",
                     file::shown(options.output.device_file),
                     file::shown(options.output.device_file)));
  }
  return 0;
}

Result<int> identify_device(const IdentifyOptions& options) {
  const Result<DeviceChoice> choice = parse_device_choice(options.scene.device);
  if (!choice) return choice.error();
  if (choice->hardware && !choice->description &&
      std::holds_alternative<device::WheelOptions>(*choice->hardware)) {
    return usage_error(
        "--device ff: the torque of the wheel is unknown, and all numbers would be wrong with it; "
        "name a device file, docs/wheels.md: --device ff:mine.toml");
  }
  const Result<file::LoadedScene> loaded = load(options.scene);
  if (!loaded) return loaded.error();
  if (Failure failed = check_outputs(options.output, {options.scene.scene})) return *failed;
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(options.output);
  if (!files) return files.error();
  OutputFile device_file;
  if (Failure failed = device_file.open(options.output.device_file)) return *failed;
  const Result<Facts> facts = facts_of(*choice, loaded->scene);
  if (!facts) return facts.error();
  const Result<double> limit_n = limit_of(options, *facts);
  if (!limit_n) return limit_n.error();

  identify::ExperimentSettings experiment;
  experiment.rate_hz = loaded->scene.sampling.rate_hz;
  experiment.force_limit_n = *limit_n;
  experiment.encoder_m = facts->encoder_m;
  experiment.peak_m = options.travel_m;
  experiment.duration_s = options.seconds;
  const Scene scene = scene_for(loaded->scene, experiment);
  const bool moves = choice->hardware.has_value();
  if ((moves || !options.output.quiet) && !ask_to_let_go(experiment, moves)) return ended_early();
  Result<IdentifyOutcome> outcome =
      run_experiment({.scene = scene,
                      .experiment = experiment,
                      .device = choice->hardware ? make_device(*choice->hardware, scene) : nullptr,
                      .allow_no_realtime = options.scene.allow_no_realtime,
                      .show_progress = !options.output.quiet});
  if (!outcome) return outcome.error();
  if (outcome->stopped_early) return ended_early();
  const auto found = identify::identify(outcome->record, outcome->facts);
  if (stop_signal() != 0) return ended_early();
  if (!found) return device_error("the handle made too few strokes; repeat with more --seconds");
  const IdentifiedBy by{facts->name,     utc_date(),           *limit_n,
                        options.seconds, outcome->facts.turns, outcome->missed_ticks};
  return report(options, by, *found, outcome->record, *files, device_file,
                described(options, *choice, *facts, scene));
}

}  // namespace

Command add_identify(CLI::App& program) {
  const auto options = std::make_shared<IdentifyOptions>();
  options->scene.scene = kDefaultScene;
  CLI::App* app = program.add_subcommand(
      "identify", "Find mass, damping, friction and delay of a device; it moves by itself");
  app->add_option("SCENE", options->scene.scene,
                  "The scene of a simulated device, without its hand and walls (default: tap)");
  add_scene_options(*app, options->scene);
  add_device_options(*app, options->scene);
  app->add_option("--limit", options->limit_n,
                  "Largest force (default: 20 % of the device's, at most 2 N)")
      ->type_name("N")
      ->check(is_number_within(0.01, 32.767));
  app->add_option("--travel", options->travel_m,
                  "Travel to both sides of the start (default: 0.018)")
      ->type_name("M")
      ->check(is_number_within(0.005, 0.1));
  app->add_option("--seconds", options->seconds, "Duration of the strokes (default: 25)")
      ->type_name("S")
      ->check(is_number_within(8.0, 300.0));
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
