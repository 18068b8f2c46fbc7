// hapticwall [SCENE]: the window.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/rehearsal.h"
#include "app/command/replay_window.h"
#include "app/command/signals.h"
#include "app/command/usage.h"
#include "app/file/disk/user_folders.h"
#include "app/file/recording/recording_reader.h"
#include "app/file/text/text.h"
#include "app/session/loop_session.h"
#include "core/result.h"

namespace hapticwall::command {
namespace {

// Starts the window's sessions on the chosen device.
session::StartSession session_starter(const DeviceChoice& device,
                                      const session::SessionOptions& options) {
  if (!device.hardware) return {};
  return [device, options](const Scene& scene, BorrowedAlgorithm* borrowed) {
    return session::start_under(borrowed, make_device(*device.hardware, scene), scene, options);
  };
}

constexpr float kFullScalePercent = 100.0F;

// Options of the window alone.
struct LookOptions {
  double scale = 0.0;  // 0: not given
  StreamChoice stream;
  session::ExperimentChoice trials;
  bool rehearses = false;
  bool signals = false;
};

void add_trial_options(CLI::App& program, LookOptions& look) {
  session::ExperimentChoice& choice = look.trials;
  program
      .add_option("--trials", choice.list,
                  "Run the trials of this list as a blind experiment; needs --participant; - takes "
                  "each trial from another program, by standard input and output")
      ->type_name("LIST.csv");
  program.add_option("--participant", choice.participant, "Participant of the experiment")
      ->type_name("P");
  program.add_option("--session", choice.session, "Session of the participant (default: 1)")
      ->type_name("S");
  program
      .add_option("--answers", choice.answers,
                  "Answers of the experiment (default: LIST-P-S.csv); an interrupted list resumes")
      ->type_name("FILE.csv");
  program.add_flag("--rehearse", look.rehearses,
                   "With --trials -: no window; the scene's hand presses, and the other program "
                   "chooses as a simulated observer");
}

// An algorithm among `overrides` wins over --algorithm.
session::SceneWith scene_with(SceneOptions options) {
  if (!options.algorithm.empty())
    options.settings.push_back("algorithm.name=" + std::exchange(options.algorithm, ""));
  return [options](std::span<const std::string> overrides) -> Result<Scene> {
    SceneOptions all = options;
    all.settings.insert(all.settings.end(), overrides.begin(), overrides.end());
    Result<file::LoadedScene> loaded = load(all);
    if (!loaded) return loaded.error();
    return std::move(loaded->scene);
  };
}

// Null without --trials.
Result<std::shared_ptr<session::Experiment>> open_trials(const LookOptions& look,
                                                         const SceneOptions& options) {
  session::ExperimentChoice choice = look.trials;
  if (look.rehearses && choice.list != session::kPiped)
    return usage_error("--rehearse: it needs --trials -");
  if (choice.list.empty()) {
    for (const auto& [name, value] : {std::pair("--participant", choice.participant),
                                      {"--session", choice.session},
                                      {"--answers", choice.answers}}) {
      if (!value.empty()) return usage_error(fmt::format("{}: it needs --trials LIST.csv", name));
    }
    return std::shared_ptr<session::Experiment>();
  }
  if (choice.participant.empty())
    return usage_error("--trials: it needs --participant P, whose answers are stored");
  if (choice.answers == kStandardOutput) return usage_error("--answers -: it takes a file name");
  if (choice.session.empty()) choice.session = "1";
  choice.on_device = options.device != kSimulator;
  if (look.rehearses && choice.on_device)
    return usage_error("--rehearse: it runs on the simulator alone; leave out --device");
  if (choice.list == session::kPiped && look.stream.path == kStandardOutput)
    return usage_error("--stream - and --trials -: both take standard output; stream to a file");
  return session::open_experiment(choice, scene_with(options));
}

// The path of a scene file, for the list of recent files.
std::string opened_file(const std::string& scene) {
  std::error_code error;
  return std::filesystem::is_regular_file(scene, error) ? scene : std::string();
}

std::optional<float> forced_scale(const LookOptions& look) {
  return look.scale > 0.0 ? std::optional(static_cast<float>(look.scale)) : std::nullopt;
}

// Replays a recording instead of a scene. Takes no options of a scene.
Result<int> open_recording(const SceneOptions& options, const LookOptions& look,
                           const session::OpenWindow& open) {
  if (!options.algorithm.empty() || !options.settings.empty() || options.device != kSimulator) {
    return usage_error(fmt::format(
        "{}: a recording takes no such option; 'hapticwall replay' re-runs its hand with "
        "--algorithm and --set",
        file::shown(options.scene)));
  }
  if (look.signals) {
    return usage_error(fmt::format("--signals: {} is a recording, which shows those that it has",
                                   file::shown(options.scene)));
  }
  if (!look.trials.list.empty()) {
    return usage_error(
        fmt::format("--trials: {} is a recording; it takes a scene", file::shown(options.scene)));
  }
  if (!look.stream.path.empty() || !look.stream.every.empty()) {
    return usage_error(fmt::format("--stream: {} is a recording; 'hapticwall replay' streams it",
                                   file::shown(options.scene)));
  }
  auto recording = file::RecordingReader::open(options.scene);
  if (!recording) return recording.error();
  ReplayWindow window;
  window.scale = forced_scale(look);
  return status_after_window(run_replay_window(std::move(*recording), std::move(window), open));
}

Result<int> open_window(const SceneOptions& options, const LookOptions& look,
                        const session::OpenWindow& open) {
  if (file::is_recording(options.scene)) return open_recording(options, look, open);
  const Result<DeviceChoice> device = parse_device_choice(options.device);
  if (!device) return device.error();
  if (Failure failed = check_plugin(options)) return *failed;
  const Result<double> spin_s = spin_seconds(options.spin_us);
  if (!spin_s) return spin_s.error();
  Result<file::LoadedScene> loaded = load(options);
  if (!loaded) return loaded.error();
  if (!device->hardware) tell_difference(*loaded);
  const auto experiment = open_trials(look, options);
  if (!experiment) return experiment.error();
  if (look.rehearses) return rehearse(**experiment);
  const auto stream = open_stream(look.stream, {});
  if (!stream) return stream.error();
  session::SessionOptions session;
  session.allow_no_realtime = options.allow_no_realtime;
  session.allow_slow_device = options.allow_slow_device;
  session.spin_s = *spin_s;
  session.stream = *stream;
  if (look.signals) session.signals = file::all_signal_columns();
  session::WindowOptions window;
  window.scene = loaded->scene;
  window.start_on_device = session_starter(*device, session);
  window.device = options.device;
  window.description = device->description;
  window.stream = *stream;
  window.signals = session.signals;
  window.spin_s = *spin_s;
  window.experiment = *experiment;
  window.settings_path = file::settings_path(file::process_environment);
  window.opened_file = opened_file(options.scene);
  window.forced_scale = forced_scale(look);
  return status_after_window(open(window));
}

}  // namespace

Action add_window(CLI::App& program, session::OpenWindow open) {
  const auto options = std::make_shared<SceneOptions>();
  const auto look = std::make_shared<LookOptions>();
  program
      .add_option(
          "SCENE", options->scene,
          "Scene file, name of a built-in scene (default: press under none), or a recording")
      ->type_name("");
  add_algorithm_option(program, *options);
  add_scene_options(program, *options);
  add_device_options(program, *options);
  add_stream_options(program, look->stream);
  add_signals_option(program, look->signals, "recordings and the stream");
  add_trial_options(program, *look);
  constexpr float kMin = session::kMinScalePercent / kFullScalePercent;
  constexpr float kMax = session::kMaxScalePercent / kFullScalePercent;
  program
      .add_option("--scale", look->scale, "Scale of the window's content, 0.5 to 3; 1 as designed")
      ->check(is_number_within(kMin, kMax))
      ->type_name("FACTOR");
  return [options, look, open = std::move(open)] {
    if (options->scene.empty()) {
      options->scene = kDefaultScene;
      if (options->algorithm.empty()) options->algorithm = kDefaultAlgorithm;
    }
    return open_window(*options, *look, open);
  };
}

}  // namespace hapticwall::command
