// Identification from the record of an experiment to a device's numbers, with intervals, or to the
// words that the model does not fit.
#pragma once

#include <optional>
#include <vector>

#include "core/study/identify/experiment.h"
#include "core/study/identify/output_error.h"

namespace hapticwall::identify {

// A value with its 95 % interval.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct Identification {
  bool fits = false;            // false: no number below may be used
  double residual_ratio = 0.0;  // RMS of the residuals over that of an encoder's counts
  Estimate mass_kg;
  Estimate damping_n_s_per_m;
  Estimate friction_n;  // the mean of both directions
  Estimate friction_up_n;
  Estimate friction_down_n;
  Estimate delay_s;                          // of a force, delay and lag together
  Estimate lag_s;                            // with the most likely delay
  std::size_t delay_ticks = 0;               // the most likely
  std::vector<std::size_t> possible_delays;  // in ticks; includes delay_ticks
  double encoder_m = 0.0;
  double noise_m = 0.0;  // standard deviation of the position at rest, beyond the encoder's
  Fit fit;
};

// A residual beyond this ratio means that the model does not fit.
inline constexpr double kMaxResidualRatio = 1.05;

// The resolution of a record whose device states none: its smallest step. 0 if nothing moved.
// Realtime-safe: no.
[[nodiscard]] double smallest_step(const std::vector<double>& position_m);

// The forces that held from each tick on, in `force_n` (commanded) or later by late reports, as
// `applied_n` (of as many ticks, before each) tells. The lag at which both agree best stays out: it
// belongs to the delay. `force_n` itself, if they agree nowhere: the device tells nothing.
[[nodiscard]] std::vector<double> taken_forces(const std::vector<double>& force_n,
                                               const std::vector<double>& applied_n);

// Takes some tenths of a second to some seconds. Realtime-safe: no. nullopt if the record has too
// few strokes. Precondition: record.encoder_m > 0; the experiment's ticks are those of the record.
[[nodiscard]] std::optional<Identification> identify(const Record& record,
                                                     const ExperimentFacts& facts);

}  // namespace hapticwall::identify
