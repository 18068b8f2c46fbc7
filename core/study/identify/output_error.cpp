#include "core/study/identify/output_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapticwall::identify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Parameters kLowest{-9.0, 0.0, 0.0, 0.0, 0.0};
constexpr Parameters kHighest{5.0, 1e3, 1e3, 1e3, 0.05};
constexpr Parameters kDifference{1e-5, 1e-6, 1e-6, 1e-6, 1e-6};
constexpr double kVelocityDifference = 1e-6;
constexpr double kWeakestStart = 1e-4;  // s; below, the velocity of a start has no effect
constexpr double kWorse = 1.1;          // a cost of a segment that a step made worse
constexpr int kStartIterations = 6;
constexpr double kBadSegment = 2.0;      // times the median
constexpr std::size_t kSlopeTicks = 12;  // ticks on either side of a start
constexpr double kSettled = 1e-8;        // relative change of the cost

// A model with the commands of a record.
struct Prepared {
  HandleModel model;
  std::vector<double> actuator_n;
};

Prepared prepare(const Record& record, const Parameters& parameters, std::size_t delay) {
  HandleModel model(parameters, record.period_s);
  std::vector<double> actuator_n = model.actuator(record.force_n, delay);
  return {std::move(model), std::move(actuator_n)};
}

Eigen::VectorXd positions(const Record& record, Prepared& prepared, const Segment& segment,
                          SegmentStart start, std::size_t delay) {
  static thread_local std::vector<double> position_m;
  prepared.model.run(segment, start, record.force_n, delay, prepared.actuator_n, position_m);
  return Eigen::Map<const Eigen::VectorXd>(position_m.data(),
                                           static_cast<Eigen::Index>(position_m.size()));
}

Eigen::VectorXd measured(const Record& record, const Segment& segment) {
  return Eigen::Map<const Eigen::VectorXd>(&record.position_m[segment.first],
                                           static_cast<Eigen::Index>(segment.count));
}

double squared(const Eigen::VectorXd& residual) {
  const double sum = residual.squaredNorm();
  return std::isfinite(sum) ? sum : kInfinity;
}

SegmentStart moved(SegmentStart start, const Eigen::Vector2d& by) {
  return {start.position_m + by[0], start.velocity_m_per_s + by[1]};
}

// Orthonormal directions of a segment's start, and what they mean for it.
struct StartDirections {
  Eigen::VectorXd level;  // direction of the position
  // Direction of the velocity, orthogonal to `level`; empty if it has no effect.
  Eigen::VectorXd slope;
  double mean_s = 0.0;  // mean of the velocity's column
  double slope_norm = 0.0;

  explicit StartDirections(const Eigen::VectorXd& by_velocity) {
    const auto count = static_cast<double>(by_velocity.size());
    level = Eigen::VectorXd::Constant(by_velocity.size(), 1.0 / std::sqrt(count));
    mean_s = by_velocity.mean();
    const Eigen::VectorXd rest = by_velocity.array() - mean_s;
    slope_norm = rest.norm();
    if (slope_norm > kWeakestStart * std::sqrt(count)) slope = rest / slope_norm;
  }
  [[nodiscard]] Eigen::VectorXd without(const Eigen::VectorXd& column) const {
    Eigen::VectorXd rest = column - level * level.dot(column);
    if (slope.size() > 0) rest -= slope * slope.dot(rest);
    return rest;
  }
  // The change of the start that gives the column's part in these directions.
  [[nodiscard]] Eigen::Vector2d start(const Eigen::VectorXd& column) const {
    const double velocity = slope.size() > 0 ? slope.dot(column) / slope_norm : 0.0;
    return {column.mean() - velocity * mean_s, velocity};
  }
};

StartDirections directions(const Record& record, Prepared& prepared, const Segment& segment,
                           const Eigen::VectorXd& base, std::size_t delay) {
  const double away = segment.start.velocity_m_per_s < 0.0 ? -1.0 : 1.0;
  const double step = away * kVelocityDifference;
  const SegmentStart faster = moved(segment.start, {0.0, step});
  return StartDirections((positions(record, prepared, segment, faster, delay) - base) / step);
}

// The best start near that of the segment; returns its cost.
double improve_start(const Record& record, Prepared& prepared, Segment& segment,
                     std::size_t delay) {
  Eigen::VectorXd base = positions(record, prepared, segment, segment.start, delay);
  double cost = squared(measured(record, segment) - base);
  for (int i = 0; i < kStartIterations; ++i) {
    const Eigen::VectorXd residual = measured(record, segment) - base;
    Eigen::Vector2d step = directions(record, prepared, segment, base, delay).start(residual);
    if (!step.allFinite()) break;
    double tried = kInfinity;
    for (int halvings = 0; halvings < 4 && !(tried < cost); ++halvings, step /= 2.0) {
      Segment next = segment;
      next.start = moved(segment.start, step);
      const Eigen::VectorXd there = positions(record, prepared, next, next.start, delay);
      tried = squared(measured(record, segment) - there);
      if (!(tried < cost)) continue;
      segment = next;
      base = there;
    }
    if (!(tried < cost * (1.0 - 1e-6))) break;
    cost = tried;
  }
  return std::min(cost, squared(measured(record, segment) - base));
}

SegmentStart start_by_slope(const Record& record, std::size_t tick) {
  const std::size_t from = tick < kSlopeTicks ? 0 : tick - kSlopeTicks;
  const std::size_t to = std::min(tick + kSlopeTicks, record.position_m.size() - 1);
  const auto rows = static_cast<Eigen::Index>(to - from + 1);
  Eigen::MatrixX3d powers(rows, 3);
  Eigen::VectorXd y(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double t = static_cast<double>(from) + static_cast<double>(i) - static_cast<double>(tick);
    powers.row(i) << 1.0, t, t * t;
    y[i] = record.position_m[from + static_cast<std::size_t>(i)];
  }
  const Eigen::Vector3d c = powers.colPivHouseholderQr().solve(y);
  return {c[0], c[1] / record.period_s};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Other starts for a segment that fits badly.
double restart(const Record& record, Prepared& prepared, Segment& segment, std::size_t delay,
               double cost) {
  const SegmentStart by_slope = start_by_slope(record, segment.first);
  for (const double share : {1.0, 0.0, 0.7, 1.4, -0.2}) {
    Segment other = segment;
    other.start = {by_slope.position_m, share * by_slope.velocity_m_per_s};
    const double other_cost = improve_start(record, prepared, other, delay);
    if (!(other_cost < cost)) continue;
    cost = other_cost;
    segment = other;
  }
  return cost;
}

double cost_of(const Record& record, const Fit& fit) {
  Prepared prepared = prepare(record, fit.parameters, fit.delay);
  double cost = 0.0;
  for (const Segment& segment : fit.segments) {
    cost += squared(measured(record, segment) -
                    positions(record, prepared, segment, segment.start, fit.delay));
  }
  return cost;
}

SegmentNormal normal_of(const Record& record, const Fit& fit, const Segment& segment,
                        Prepared& prepared, std::vector<Prepared>& changed) {
  const Eigen::VectorXd base = positions(record, prepared, segment, segment.start, fit.delay);
  const StartDirections start = directions(record, prepared, segment, base, fit.delay);
  SegmentNormal normal;
  normal.residual_m = measured(record, segment) - base;
  normal.slope.resize(base.size(), kParameters);
  for (int p = 0; p < kParameters; ++p) {
    const auto i = static_cast<std::size_t>(p);
    const Eigen::VectorXd column =
        (positions(record, changed[i], segment, segment.start, fit.delay) - base) / kDifference[i];
    normal.slope.col(p) = start.without(column);
    normal.start_by_parameters.col(p) = start.start(column);
  }
  normal.hessian = normal.slope.transpose() * normal.slope;
  normal.gradient = normal.slope.transpose() * normal.residual_m;
  normal.start_by_residual = start.start(normal.residual_m);
  return normal;
}

// The step of Levenberg and Marquardt within the bounds: a parameter that a bound holds is left
// out.
ParameterVector bounded_step(const Parameters& at, ParameterMatrix hessian,
                             ParameterVector gradient, double damping) {
  hessian.diagonal() *= 1.0 + damping;
  for (int p = 0; p < kParameters; ++p) {
    const auto i = static_cast<std::size_t>(p);
    const bool held = (at[i] <= kLowest[i] && gradient[p] <= 0.0) ||
                      (at[i] >= kHighest[i] && gradient[p] >= 0.0) || !(hessian(p, p) > 0.0);
    if (!held) continue;
    hessian.row(p).setZero();
    hessian.col(p).setZero();
    hessian(p, p) = 1.0;
    gradient[p] = 0.0;
  }
  ParameterVector step = hessian.ldlt().solve(gradient);
  for (int p = 0; p < kParameters; ++p) {
    const auto i = static_cast<std::size_t>(p);
    step[p] = std::clamp(at[i] + step[p], kLowest[i], kHighest[i]) - at[i];
  }
  step[kLogMass] = std::clamp(step[kLogMass], -0.7, 0.7);
  return step;
}

// The best of the start that a step moved, the same improved, and the one before.
double settle_start(const Record& record, Prepared& prepared, Segment& segment,
                    const Segment& before, std::size_t delay, double cost_before) {
  const double cost = squared(measured(record, segment) -
                              positions(record, prepared, segment, segment.start, delay));
  if (cost <= kWorse * cost_before) return cost;
  Segment other = before;
  const double other_cost = improve_start(record, prepared, other, delay);
  const double improved = improve_start(record, prepared, segment, delay);
  if (improved <= other_cost) return improved;
  segment = other;
  return other_cost;
}

// The fit after a step of its parameters, with its cost.
Fit stepped(const Record& record, const Fit& fit, const std::vector<SegmentNormal>& normals,
            const ParameterVector& step) {
  Fit next = fit;
  for (int p = 0; p < kParameters; ++p) next.parameters[static_cast<std::size_t>(p)] += step[p];
  Prepared prepared = prepare(record, next.parameters, fit.delay);
  next.cost_m2 = 0.0;
  for (std::size_t s = 0; s < normals.size(); ++s) {
    const Eigen::Vector2d by = normals[s].start_by_residual - normals[s].start_by_parameters * step;
    if (by.allFinite()) next.segments[s].start = moved(fit.segments[s].start, by);
    next.cost_m2 += settle_start(record, prepared, next.segments[s], fit.segments[s], fit.delay,
                                 squared(normals[s].residual_m));
  }
  return next;
}

}  // namespace

std::size_t Fit::samples() const {
  std::size_t count = 0;
  for (const Segment& segment : segments) count += segment.count;
  return count;
}

std::vector<SegmentNormal> linearise(const Record& record, const Fit& fit) {
  Prepared prepared = prepare(record, fit.parameters, fit.delay);
  std::vector<Prepared> changed;
  for (std::size_t p = 0; p < kParameters; ++p) {
    Parameters other = fit.parameters;
    other[p] += kDifference[p];
    changed.push_back(prepare(record, other, fit.delay));
  }
  std::vector<SegmentNormal> normals;
  for (const Segment& segment : fit.segments) {
    normals.push_back(normal_of(record, fit, segment, prepared, changed));
  }
  return normals;
}

std::vector<Segment> cut(const Record& record, std::size_t first_tick, std::size_t count,
                         const std::vector<Segment>& known) {
  std::vector<Segment> segments;
  for (std::size_t first = first_tick; first + count <= record.position_m.size(); first += count) {
    const auto same = std::find_if(known.begin(), known.end(),
                                   [&](const Segment& one) { return one.first == first; });
    segments.push_back(
        {first, count, same != known.end() ? same->start : start_by_slope(record, first)});
  }
  return segments;
}

void refit_starts(const Record& record, Fit& fit) {
  Prepared prepared = prepare(record, fit.parameters, fit.delay);
  std::vector<double> costs;
  for (Segment& segment : fit.segments) {
    costs.push_back(improve_start(record, prepared, segment, fit.delay));
  }
  const double limit = kBadSegment * median(costs);
  fit.cost_m2 = 0.0;
  for (std::size_t s = 0; s < costs.size(); ++s) {
    if (!(costs[s] <= limit)) {
      costs[s] = restart(record, prepared, fit.segments[s], fit.delay, costs[s]);
    }
    fit.cost_m2 += costs[s];
  }
}

void search(const Record& record, Fit& fit, int iterations) {
  double damping = 1e-3;
  fit.cost_m2 = cost_of(record, fit);
  for (int i = 0; i < iterations; ++i) {
    const std::vector<SegmentNormal> normals = linearise(record, fit);
    ParameterMatrix hessian = ParameterMatrix::Zero();
    ParameterVector gradient = ParameterVector::Zero();
    for (const SegmentNormal& normal : normals) {
      hessian += normal.hessian;
      gradient += normal.gradient;
    }
    if (!hessian.allFinite() || !gradient.allFinite()) return;
    const double before = fit.cost_m2;
    for (int tries = 0; tries < 8; ++tries) {
      Fit next =
          stepped(record, fit, normals, bounded_step(fit.parameters, hessian, gradient, damping));
      if (next.cost_m2 < before) {
        fit = std::move(next);
        damping = std::max(damping / 8.0, 1e-9);
        break;
      }
      damping = std::max(damping * 8.0, 1e-6);
    }
    if (!(fit.cost_m2 < before * (1.0 - kSettled))) return;
  }
}

}  // namespace hapticwall::identify
