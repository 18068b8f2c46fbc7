// Output error by multiple shooting: the model runs through segments of the record, each with its
// own start, and a bounded Levenberg-Marquardt search makes the squared residuals least. The starts
// are projected out of the search for the parameters. Realtime-safe: no, none of it.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "core/study/identify/handle_model.h"

namespace hapticwall::identify {

using ParameterVector = Eigen::Matrix<double, kParameters, 1>;
using ParameterMatrix = Eigen::Matrix<double, kParameters, kParameters>;

struct Fit {
  std::size_t delay = 0;  // in ticks
  Parameters parameters{};
  std::vector<Segment> segments;
  double cost_m2 = 0.0;  // the sum of squared residuals

  [[nodiscard]] std::size_t samples() const;
};

// A segment's part of the normal equations, without the directions of its start.
struct SegmentNormal {
  ParameterMatrix hessian = ParameterMatrix::Zero();
  ParameterVector gradient = ParameterVector::Zero();
  Eigen::Vector2d start_by_residual = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, kParameters> start_by_parameters =
      Eigen::Matrix<double, 2, kParameters>::Zero();
  Eigen::VectorXd residual_m;                                // as measured, y - model
  Eigen::Matrix<double, Eigen::Dynamic, kParameters> slope;  // projected
};

// The fit around its parameters. The residuals of all segments give its cost.
[[nodiscard]] std::vector<SegmentNormal> linearise(const Record& record, const Fit& fit);

// Segments of `count` ticks from `first_tick` to the end of the record. Starts come from segments
// of `known` that begin at the same tick, else from the slope of the record.
[[nodiscard]] std::vector<Segment> cut(const Record& record, std::size_t first_tick,
                                       std::size_t count, const std::vector<Segment>& known = {});

// The cost, with the best start of every segment for these parameters. Refits start from more
// places in segments that are worse than twice the median.
void refit_starts(const Record& record, Fit& fit);

// Searches for parameters and starts until the cost stands, for at most `iterations` steps.
void search(const Record& record, Fit& fit, int iterations);

}  // namespace hapticwall::identify
