// How well a fit knows its parameters. Realtime-safe: no, none of it.
#pragma once

#include "core/study/identify/output_error.h"

namespace hapticwall::identify {

// Half-widths of 95 % intervals. Quantisation is no white noise: the larger of two covariances
// counts, one from the residuals of whole segments and one from encoder counts drawn anew.
class Intervals {
 public:
  // Precondition: more segments than parameters. Draws with a fixed seed: same record, same bits.
  Intervals(const Record& record, const Fit& fit);

  // Half width of the interval of a sum of parameters with these weights; weight 1 for ln m alone
  // gives the mass's relative width.
  [[nodiscard]] double half_width(const ParameterVector& weights) const;

 private:
  ParameterMatrix sandwich_;
  ParameterMatrix requantised_;
  double quantile_;  // of Student's t
};

// The 97.5 % quantile of Student's t, within 0.1 % from 4 degrees of freedom on.
[[nodiscard]] double student_quantile(double degrees);

}  // namespace hapticwall::identify
