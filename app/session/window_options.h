// Options of a window, from the command line.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/file/scene/device_file.h"
#include "app/session/experiment.h"
#include "app/session/live_session.h"
#include "app/session/replay_session.h"
#include "core/algorithm/algorithm.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::session {

// Limits of WindowOptions::forced_scale and of the setting, in percent of the designed size.
inline constexpr int kMinScalePercent = 50;
inline constexpr int kMaxScalePercent = 300;

// Starts a session, with `borrowed` as in start_under().
using StartSession = std::function<Result<std::unique_ptr<LiveSession>>(
    const Scene& scene, BorrowedAlgorithm* borrowed)>;

struct WindowOptions {
  Scene scene;
  StartSession start_on_device;                          // empty: the simulator
  std::string device = "sim";                            // --device
  std::optional<file::DeviceDescription> description{};  // description in the device's file
  // Makes the recording to show first; empty: a session of the scene is shown.
  std::function<std::unique_ptr<ReplaySession>()> replay;
  // Folder for recordings; empty: from the settings, or the current folder.
  std::string recording_folder;
  std::string settings_path;                   // empty: settings are neither read nor kept
  std::optional<float> forced_scale;           // empty: from the settings or the screen
  double spin_s = 0.0;                         // see SessionOptions::spin_s; on the simulator
  std::shared_ptr<file::SampleStream> stream;  // see SessionOptions::stream; on the simulator
  std::vector<file::SignalColumn> signals;     // see SessionOptions::signals; on the simulator
  std::string opened_file;                     // the scene's file; empty: a built-in scene
  std::shared_ptr<Experiment> experiment;      // experiment that starts at once; null: none
};

// Opens a window and returns when it is closed.
using OpenWindow = std::function<Failure(const WindowOptions&)>;

}  // namespace hapticwall::session
