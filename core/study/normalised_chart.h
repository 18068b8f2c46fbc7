// The stability chart of Hulin and Gil: K T²/m over B T/m for delays of whole ticks, by theory and
// by the simulator.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/scene.h"

namespace hapticwall {

// All numbers are normalised: stiffness K T²/m, damping B T/m.
struct ChartPoint {
  double damping = 0.0;
  double limit = 0.0;  // largest_stable_stiffness() of the handle alone
  double rule = 0.0;   // (b + B) / (T/2 + t_d)
};

struct SimulatedPoint {
  double damping = 0.0;
  double limit = 0.0;  // of the loop as simulated, with the spring that presses
  double rule = 0.0;
  std::optional<double> settled;  // stiffest wall that settles; nullopt: none
  std::optional<double> failed;   // softest wall that does not; nullopt: all settle
  std::size_t changes = 0;        // of the verdict along the scan
};

struct DelayChart {
  int ticks = 0;
  std::vector<ChartPoint> curve;  // from no damping to `last_damping`
  ChartPoint best;
  double last_damping = 0.0;  // with more no wall is stable; 0: none is with any
  double pressing = 0.0;      // stiffness of the spring that presses
  std::vector<SimulatedPoint> points;
};

struct NormalisedChart {
  Scene handle;                 // see bare_handle()
  double device_damping = 0.0;  // b T/m
  std::vector<DelayChart> delays;
};

inline constexpr int kMaxChartDelay = 2;  // ticks
inline constexpr std::size_t kChartPoints = 10;

// Rate, mass and damping of the scene; no hand, friction, encoder, force limit, amplifier or wall.
// The classical chart has none of them.
[[nodiscard]] Scene bare_handle(const Scene& scene);

// The theory alone, with the dampings at which to simulate. About 30 ms.
[[nodiscard]] NormalisedChart chart_of_theory(const Scene& scene);

struct ChartOptions {
  std::function<bool()> should_stop;
  std::function<void(double fraction)> progress;  // as in BoundaryOptions
};

// A stiffness of the chart that no scene can have, if any.
[[nodiscard]] std::optional<SceneProblem> validate(const NormalisedChart& chart);

// A soft spring presses the handle into a wall, so that a stable loop never leaves it; boundaries
// of the verdict are found to 1e-4. Just below the limit a swing decays for longer than the run, at
// most by 0.1 % if b T/m is at least 0.01. False if `should_stop` returned true. Realtime-safe: no.
[[nodiscard]] bool simulate_points(NormalisedChart& chart, const ChartOptions& options = {});

}  // namespace hapticwall
