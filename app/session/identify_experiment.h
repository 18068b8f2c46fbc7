// The experiment of `identify` in a session: its choice, its scene, its algorithm and its record.
// The command and the window run it alike.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/scene/device_file.h"
#include "app/session/loop/snapshot.h"
#include "core/algorithm/algorithm.h"
#include "core/result.h"
#include "core/scene.h"
#include "core/scene_keys.h"
#include "core/study/identify/identify.h"
#include "device/device.h"

namespace hapticwall::session {

// Settings that a person chooses.
struct IdentifyChoice {
  double limit_n = 0.0;     // 0.01 to 32.767; 0: 20 % of the device's force, at most 2 N
  double travel_m = 0.018;  // travel to either side of the start, 0.005 to 0.1
  double seconds = 25.0;    // duration of the strokes, 8 to 300
};
inline constexpr ValueRange kIdentifyLimitN{0.01, 32.767};
inline constexpr ValueRange kIdentifyTravelM{0.005, 0.1};
inline constexpr ValueRange kIdentifySeconds{8.0, 300.0};

// An experiment that came to its end, without numbers.
inline constexpr std::string_view kTooFewStrokes =
    "the handle made too few strokes; repeat with more seconds";

// Reason why no experiment can identify the device that --device `option` opens and `own`
// describes; empty: one can.
[[nodiscard]] std::string why_not_identified(const std::string& option,
                                             const std::optional<file::DeviceDescription>& own);

// The device's own information; for a simulator, that of its scene.
[[nodiscard]] device::DeviceInfo info_on(device::DeviceInfo device, const Scene& scene);

// Fails for a limit above that of the device. `device`: of info_on().
[[nodiscard]] Result<identify::ExperimentSettings> experiment_settings(
    const IdentifyChoice& choice, const device::DeviceInfo& device, double rate_hz);

// The time that the session may take, s: the experiment and all before it.
[[nodiscard]] double longest_session_s(const identify::ExperimentSettings& experiment);

// The device alone: no hand, no wall.
[[nodiscard]] Scene identify_scene(const Scene& loaded,
                                   const identify::ExperimentSettings& experiment);

// Asks a person to let go of the handle, and announces the next step.
[[nodiscard]] std::string let_go_text(const identify::ExperimentSettings& experiment);

// Description of a device before its numbers are known: `own`, or the known facts of `device`,
// which --device `option` opened.
[[nodiscard]] file::DeviceDescription identified_description(
    const std::optional<file::DeviceDescription>& own, const std::string& option,
    const device::DeviceInfo& device, const Scene& scene);

// The experiment as a substitute for the algorithm. The loop calls step(); the owner's thread calls
// the rest.
class ExperimentAlgorithm final : public BorrowedAlgorithm {
 public:
  explicit ExperimentAlgorithm(const identify::ExperimentSettings& settings);

  // Zero force before begin() and after the end, for good. A force that did not go out ends it:
  // arming again must not bring it back.
  [[nodiscard]] double step(const AlgorithmInput& input);

  void begin() { begun_.store(true, std::memory_order_relaxed); }
  // Ends it at the next tick.
  void stop() { stopped_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool begun() const { return begun_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool ended() const { return ended_.load(std::memory_order_acquire); }
  // The experiment's tick of the first stroke; 0: not yet.
  [[nodiscard]] std::uint64_t first_stroke() const {
    return first_stroke_.load(std::memory_order_relaxed);
  }
  // The session's tick at which the experiment began. Precondition of both: the loop is over, or
  // ended().
  [[nodiscard]] std::uint64_t first_tick() const { return first_tick_; }
  [[nodiscard]] const identify::ExperimentFacts& facts() const { return experiment_.facts(); }

 private:
  identify::Experiment experiment_;
  std::uint64_t first_tick_ = 0;
  double wanted_n_ = 0.0;  // desired force at the previous tick
  std::atomic<bool> begun_{false};
  std::atomic<bool> stopped_{false};
  std::atomic<bool> ended_{false};
  std::atomic<std::uint64_t> first_stroke_{0};
};

// Progress of a running experiment, as a person sees it.
enum class IdentifyStage : std::uint8_t { kWaits, kRest, kRamps, kStrokes, kOver };
struct IdentifyProgress {
  IdentifyStage stage = IdentifyStage::kWaits;  // kWaits: for the whole force of the device
  double strokes_s = 0.0;
  double lowest_m = 0.0;  // position relative to the start of the experiment
  double highest_m = 0.0;
};

// The owner's side: begins the experiment, keeps its record, and notices its end. The session whose
// loop has algorithm() must end before this does.
class IdentifyExperiment {
 public:
  explicit IdentifyExperiment(const identify::ExperimentSettings& settings)
      : settings_(settings), algorithm_(settings) {}

  [[nodiscard]] ExperimentAlgorithm& algorithm() { return algorithm_; }
  [[nodiscard]] const identify::ExperimentSettings& settings() const { return settings_; }

  // Begins at once; for a simulator whose loop has not started.
  void begin() { algorithm_.begin(); }
  // Every tick of the session, in order.
  void add(const Tick& tick);
  // Begins as soon as the whole force acts. True when the experiment is over; a device that was
  // disarmed meanwhile ends it.
  [[nodiscard]] bool look(const Snapshot& snapshot);
  // Zero force from the next tick on; `why` completes "the experiment ended with the force off: ".
  void stop(std::string why);
  [[nodiscard]] IdentifyProgress progress() const;

  // Precondition of the following members: the loop is over, or look() has returned true. trouble()
  // is the reason why the experiment did not finish.
  [[nodiscard]] Failure trouble() const;
  // The ticks of the experiment alone, with the resolution of the device.
  [[nodiscard]] identify::Record record() const;
  [[nodiscard]] const identify::ExperimentFacts& facts() const { return algorithm_.facts(); }

 private:
  identify::ExperimentSettings settings_;
  ExperimentAlgorithm algorithm_;
  std::vector<double> position_m_;
  std::vector<double> force_n_;
  std::vector<double> applied_n_;
  std::uint64_t ticks_ = 0;      // ticks of the session
  std::uint64_t kept_from_ = 0;  // the first one in the record
  std::uint64_t next_tick_ = 0;  // the tick that continues the record
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
  std::string why_;  // reason of a stop; empty: not stopped
};

}  // namespace hapticwall::session
