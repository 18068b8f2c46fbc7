#include "core/study/identify/first_guess.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace hapticwall::identify {
namespace {

constexpr double kDelayStep = 0.5;  // ticks
// Share of a stroke that is cut at either end, because the handle may stick there.
constexpr double kTrim = 0.06;
constexpr double kMaxPause = 0.15;  // share of a window
constexpr std::size_t kMinWindow = 16;
constexpr std::size_t kMinWindows = 8;

// φ = (1 - s²)⁴ over [begin, end], s from -1 to 1; ticks as the unit of time.
struct Window {
  double begin = 0.0;
  double end = 0.0;
  double sign = 0.0;  // sign of the velocity inside

  [[nodiscard]] double half() const { return (end - begin) / 2.0; }
  [[nodiscard]] double place(double tick) const { return (tick - begin) / half() - 1.0; }
  [[nodiscard]] double value(double tick) const {
    const double rest = 1.0 - place(tick) * place(tick);
    return rest > 0.0 ? rest * rest * rest * rest : 0.0;
  }
  [[nodiscard]] double slope(double tick) const {
    const double s = place(tick);
    const double rest = 1.0 - s * s;
    return rest > 0.0 ? -8.0 * s * rest * rest * rest / half() : 0.0;
  }
  [[nodiscard]] double bend(double tick) const {
    const double s = place(tick);
    const double rest = 1.0 - s * s;
    if (rest <= 0.0) return 0.0;
    return (-8.0 * rest * rest * rest + 48.0 * s * s * rest * rest) / (half() * half());
  }
};

// A handle that sticks has an unknown friction.
bool sticks(const Record& record, const Window& window) {
  const double longest = kMaxPause * (window.end - window.begin);
  auto run_begin = static_cast<std::size_t>(window.begin);
  for (std::size_t k = run_begin; k <= static_cast<std::size_t>(window.end); ++k) {
    if (std::abs(record.position_m[k] - record.position_m[run_begin]) > 0.5 * record.encoder_m) {
      run_begin = k;
    }
    if (static_cast<double>(k - run_begin) > longest) return true;
  }
  return false;
}

// Each stroke, and three windows of half its length.
std::vector<Window> windows(const Record& record, std::size_t first_tick) {
  const std::vector<std::size_t> ends =
      turns(record, first_tick, std::max(3.0 * record.encoder_m, 0.4e-3));
  std::vector<Window> all;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const auto begin = static_cast<double>(ends[i]);
    const double length = static_cast<double>(ends[i + 1]) - begin;
    const double sign = record.position_m[ends[i + 1]] > record.position_m[ends[i]] ? 1.0 : -1.0;
    for (const auto& [from, to] : {std::pair{0.0, 1.0}, {0.0, 0.5}, {0.25, 0.75}, {0.5, 1.0}}) {
      const double used = 1.0 - 2.0 * kTrim;
      const Window window{begin + length * (kTrim + used * from),
                          begin + length * (kTrim + used * to), sign};
      const bool is_long = window.end - window.begin >= static_cast<double>(kMinWindow);
      if (is_long && !sticks(record, window)) all.push_back(window);
    }
  }
  return all;
}

// m ∫φ''x - b ∫φ'x ± f ∫φ = -∫φ u, in a row of (m, b, f₊, f₋ | u). The weight makes the noise of
// all rows alike.
struct Equations {
  Eigen::MatrixX4d left;
  Eigen::VectorXd right;
};

Equations equations(const Record& record, const std::vector<Window>& all, double delay) {
  const auto rows = static_cast<Eigen::Index>(all.size());
  Equations system{Eigen::MatrixX4d::Zero(rows, 4), Eigen::VectorXd::Zero(rows)};
  const double t = record.period_s;
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Window& window = all[static_cast<std::size_t>(row)];
    const auto from = static_cast<std::size_t>(window.begin);
    const auto to = std::min(static_cast<std::size_t>(window.end) + 1, record.force_n.size() - 1);
    const double middle_m = record.position_m[from];
    double weight = 0.0;
    for (std::size_t k = from; k <= to; ++k) {
      const auto tick = static_cast<double>(k);
      const double x = record.position_m[k] - middle_m;
      const double bend = window.bend(tick);
      system.left(row, 0) += bend * x / (t * t);
      system.left(row, 1) -= window.slope(tick) * x / t;
      system.left(row, window.sign > 0.0 ? 2 : 3) += window.sign * window.value(tick);
      weight += bend * bend;
    }
    // The command of tick k acts from k + delay on for a tick.
    const std::size_t reach = static_cast<std::size_t>(std::ceil(delay)) + 1;
    for (std::size_t k = from < reach ? 0 : from - reach; k <= to; ++k) {
      system.right[row] -= window.value(static_cast<double>(k) + delay + 0.5) * record.force_n[k];
    }
    system.left.row(row) /= std::sqrt(weight);
    system.right[row] /= std::sqrt(weight);
  }
  return system;
}

Guess solve(const Record& record, const Equations& system, double delay) {
  const Eigen::Vector4d x = system.left.colPivHouseholderQr().solve(system.right);
  Guess guess;
  guess.delay_s = delay * record.period_s;
  guess.residual = (system.left * x - system.right).squaredNorm();
  guess.parameters = {std::log(std::max(x[0], 1e-3)), std::max(x[1], 1e-3), std::max(x[2], 1e-4),
                      std::max(x[3], 1e-4), 0.0};
  return guess;
}

}  // namespace

std::vector<std::size_t> turns(const Record& record, std::size_t first_tick, double hysteresis_m) {
  std::vector<std::size_t> found;
  double side = 0.0;
  std::size_t extreme = first_tick;
  for (std::size_t k = first_tick; k < record.position_m.size(); ++k) {
    const double from_extreme = record.position_m[k] - record.position_m[extreme];
    if (side * from_extreme > 0.0) extreme = k;
    const bool back = side == 0.0 || side * from_extreme < 0.0;
    if (!back || std::abs(from_extreme) < hysteresis_m) continue;
    if (side != 0.0) found.push_back(extreme);
    side = from_extreme > 0.0 ? 1.0 : -1.0;
    extreme = k;
  }
  return found;
}

std::vector<Guess> first_guesses(const Record& record, std::size_t first_tick,
                                 double max_delay_ticks) {
  const std::vector<Window> all = windows(record, first_tick);
  if (all.size() < kMinWindows) return {};
  std::vector<Guess> guesses;
  for (int step = 0; step * kDelayStep <= max_delay_ticks; ++step) {
    const double delay = step * kDelayStep;
    guesses.push_back(solve(record, equations(record, all, delay), delay));
  }
  std::sort(guesses.begin(), guesses.end(),
            [](const Guess& a, const Guess& b) { return a.residual < b.residual; });
  return guesses;
}

}  // namespace hapticwall::identify
