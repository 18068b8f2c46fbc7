#include "app/runtime/rerun_overlay.h"

#include <fmt/format.h>

#include <utility>

#include "app/file/text.h"
#include "app/runtime/hand_rerun.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::runtime {

Result<Overlay> rerun_as_overlay(file::RecordingReader& recording, const std::string& algorithm,
                                 const std::vector<std::string>& settings,
                                 const std::function<bool(double)>& keep_going) {
  const std::uint64_t rows = recording.rows();
  const std::string name = file::shown(recording.info().csv_path);
  if (rows > kMostOverlaidTicks) {
    return Error{
        ErrorKind::kUsage,
        fmt::format("{}: at most {} ticks are laid over a recording, this one has {}; `hapticwall "
                    "replay --csv` records the re-run of any",
                    name, kMostOverlaidTicks, rows)};
  }
  const auto scene = rerun_scene(recording.info(), algorithm, settings);
  if (!scene) return scene.error();
  Overlay overlay;
  overlay.label = algorithms()[scene->scene.algorithm.index].name;
  if (!settings.empty()) overlay.label += fmt::format(", {}", fmt::join(settings, ", "));
  overlay.samples.reserve(rows);
  RerunOptions options;
  options.on_sample = [&](const Sample& sample) { overlay.samples.push_back(sample); };
  options.keep_going = keep_going;
  const auto outcome = rerun_hand(recording, *scene, options);
  if (!outcome) return outcome.error();
  if (outcome->stopped_early) {
    return Error{ErrorKind::kUsage, name + ": the re-run was ended early"};
  }
  return overlay;
}

}  // namespace hapticwall::runtime
