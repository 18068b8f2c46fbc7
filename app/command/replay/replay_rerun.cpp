#include "app/command/replay/replay_rerun.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/command/recorded_hand.h"
#include "app/command/report/progress.h"
#include "app/command/report/summary_table.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/text/text.h"
#include "core/units.h"

namespace hapticwall::command {
Result<runtime::RerunOutcome> rerun_recorded(const RecordedRerun& rerun, RunOutputs& outputs) {
  std::unique_ptr<file::RecordingWriter> writer;
  if (!rerun.csv.empty()) {
    auto created = file::RecordingWriter::create(rerun.csv, outputs.columns());
    if (!created) return created.error();
    writer = std::move(*created);
  }
  if (rerun.talks) tell_limits(rerun.recording.info());
  Progress progress(rerun.loaded.scene.name, rerun.talks);
  Failure failed;
  runtime::RerunOptions options;
  options.keep_going = [&](double fraction) {
    progress.show(fraction);
    return stop_signal() == 0 && !outputs.reader_left();
  };
  options.on_sample = [&](const Sample& sample) {
    if (writer && !failed) failed = writer->append({{sample}});
    if (outputs.wants_ticks()) outputs.take({{sample}});
  };
  auto outcome = runtime::rerun_hand(rerun.recording, rerun.loaded, options);
  if (!outcome) return outcome;
  if (writer && !failed)
    failed = writer->finish(rerun.loaded.scene, runtime::rerun_metadata(rerun.recording.info(),
                                                                        rerun.loaded, *outcome));
  outputs.keep_failure(std::move(failed));
  return outcome;
}

std::string comparison_line(const runtime::RerunOutcome& outcome, double rate_hz) {
  std::string text = "equal to the recording, bit for bit";
  if (outcome.first_different_tick) {
    text = fmt::format(
        "differs from the recording from tick {} ({:.6g} s) on, by at most {:.3g} mm",
        *outcome.first_different_tick, static_cast<double>(*outcome.first_different_tick) / rate_hz,
        outcome.largest_distance_m * kMillimetresPerMetre);
  }
  return summary_line("re-run", text);
}

}  // namespace hapticwall::command
