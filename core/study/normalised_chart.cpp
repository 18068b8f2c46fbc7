#include "core/study/normalised_chart.h"

#include <algorithm>
#include <cmath>

#include "core/algorithm/algorithm.h"
#include "core/study/boundary.h"
#include "core/study/stability_bounds.h"

namespace hapticwall {
namespace {

constexpr double kWallAtM = -1.0;
constexpr double kPathAtM = 1.0;  // the longest spring that a scene can have
// The wall of the largest limit gives way by this, softer ones by more: several times the swing
// that still counts as settled, and little beside the length of the spring.
constexpr double kLeastPressM = 0.2e-3;
constexpr double kBeyondBest = 1.5;

// Stiffness in N/m for K T²/m = 1, and damping in N·s/m for B T/m = 1.
double stiffness_unit(const Scene& scene) {
  const double rate_hz = scene.sampling.rate_hz;
  return scene.x().device.mass_kg * rate_hz * rate_hz;
}
double damping_unit(const Scene& scene) {
  return scene.x().device.mass_kg * scene.sampling.rate_hz;
}

ChartPoint point_at(const Scene& scene, double damping) {
  const WallSettings wall{0.0, 0.0, damping * damping_unit(scene)};
  const StabilityBounds bounds = stability_bounds(scene, wall, delay_of(scene));
  return {damping, *bounds.stable_n_per_m / stiffness_unit(scene),
          *bounds.rule_n_per_m / stiffness_unit(scene)};
}

// The damping beyond which no wall is stable.
double last_damping(const Scene& scene) {
  constexpr int kSteps = 50;
  constexpr double kAny = 1e-6;  // with this damping some wall is stable if one is with any
  double low = kAny;
  if (point_at(scene, low).limit == 0.0) return 0.0;
  double high = 1.0;
  while (point_at(scene, high).limit > 0.0) high *= 2.0;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = 0.5 * (low + high);
    (point_at(scene, middle).limit > 0.0 ? low : high) = middle;
  }
  return low;
}

DelayChart theory_of(Scene scene, int ticks) {
  constexpr std::size_t kCurvePoints = 400;
  scene.x().device.delay_ticks = ticks;
  DelayChart chart;
  chart.ticks = ticks;
  chart.last_damping = last_damping(scene);
  for (std::size_t i = 0; i <= kCurvePoints; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(kCurvePoints);
    chart.curve.push_back(point_at(scene, part * chart.last_damping));
  }
  chart.best = *std::ranges::max_element(chart.curve, {}, &ChartPoint::limit);
  return chart;
}

// The handle pressed into a wall, which the plan varies.
Scene pressed(const NormalisedChart& chart, const DelayChart& delay) {
  constexpr double kTicksPerDamping = 12000.0;  // enough for a wall 0.1 % below the limit to settle
  constexpr double kMinTicks = 1e5;
  constexpr double kMaxTicks = 1e6;
  Scene scene = chart.handle;
  const double unit = stiffness_unit(scene);
  const double length_m = kPathAtM - kWallAtM;
  scene.duration_s = scene.sampling.period_s() *
                     std::clamp(kTicksPerDamping / chart.device_damping, kMinTicks, kMaxTicks);
  scene.x().device.delay_ticks = delay.ticks;
  HandSettings hand;
  hand.stiffness_n_per_m = delay.pressing * unit;
  hand.path = {{0.0, kPathAtM}};
  scene.x().hand = hand;
  scene.x().walls = {{kWallAtM, delay.best.limit * unit, 0.0}};
  // Within the deepest rest of all walls, and less deep than twice the others'.
  scene.x().device.start_m =
      kWallAtM + 0.5 * length_m * delay.pressing / (kBeyondBest * delay.best.limit);
  return scene;
}

void add_points(const NormalisedChart& chart, DelayChart& delay) {
  constexpr double kOfLastDamping = 0.9;
  delay.pressing = delay.best.limit * kLeastPressM / (kPathAtM - kWallAtM);
  if (delay.best.limit == 0.0) return;
  Scene scene = pressed(chart, delay);
  for (std::size_t i = 0; i < kChartPoints; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(kChartPoints - 1);
    const ChartPoint point = point_at(scene, part * kOfLastDamping * delay.last_damping);
    delay.points.push_back({point.damping, point.limit, point.rule, {}, {}, 0});
  }
}

// Walls from half the softest limit to beyond the best.
BoundaryPlan plan_of(const NormalisedChart& chart, const DelayChart& delay) {
  constexpr std::size_t kScan = 11;
  constexpr double kTolerance = 1e-4;
  constexpr double kLeastShare = 1e-3;
  BoundaryPlan plan;
  plan.scene = pressed(chart, delay);
  plan.algorithms = {find_algorithm("none").value()};
  const auto number = [&](const char* key) { return find_scene_number(plan.scene, key).value(); };
  plan.x = MapAxis{number("wall.damping_n_s_per_m"), 0.0,
                   delay.points.back().damping * damping_unit(chart.handle), kChartPoints, false};
  const double softest = std::ranges::min_element(delay.points, {}, &SimulatedPoint::limit)->limit;
  const double unit = stiffness_unit(chart.handle);
  plan.along = {number("wall.stiffness_n_per_m"),
                unit * std::max(0.5 * softest, kLeastShare * delay.best.limit),
                unit * kBeyondBest * delay.best.limit, kScan, true};
  plan.tolerance = kTolerance;
  return plan;
}

}  // namespace

Scene bare_handle(const Scene& scene) {
  Scene handle;
  handle.name = scene.name;
  handle.sampling = scene.sampling;
  handle.x().device.mass_kg = scene.x().device.mass_kg;
  handle.x().device.damping_n_s_per_m = scene.x().device.damping_n_s_per_m;
  return handle;
}

NormalisedChart chart_of_theory(const Scene& scene) {
  NormalisedChart chart;
  chart.handle = bare_handle(scene);
  chart.device_damping = chart.handle.x().device.damping_n_s_per_m / damping_unit(chart.handle);
  for (int ticks = 0; ticks <= kMaxChartDelay; ++ticks) {
    chart.delays.push_back(theory_of(chart.handle, ticks));
    add_points(chart, chart.delays.back());
  }
  return chart;
}

std::optional<SceneProblem> validate(const NormalisedChart& chart) {
  for (const DelayChart& delay : chart.delays) {
    if (delay.points.empty()) continue;
    if (auto problem = validate(plan_of(chart, delay))) return problem;
  }
  return std::nullopt;
}

bool simulate_points(NormalisedChart& chart, const ChartOptions& options) {
  const double unit = stiffness_unit(chart.handle);
  const auto normalised = [&](const std::optional<double>& stiffness) {
    return stiffness ? std::optional(*stiffness / unit) : std::nullopt;
  };
  double done = 0.0;
  for (DelayChart& delay : chart.delays) {
    const double share = 1.0 / static_cast<double>(chart.delays.size());
    if (!delay.points.empty()) {
      const auto show = [&](double part) {
        if (options.progress) options.progress(done + share * part);
      };
      const auto found = find_boundaries(plan_of(chart, delay),
                                         {.should_stop = options.should_stop, .progress = show});
      if (found.empty()) return false;
      for (std::size_t i = 0; i < found.size(); ++i) {
        SimulatedPoint& point = delay.points[i];
        point.settled = normalised(found[i].settled.last);
        point.failed = normalised(found[i].failed.first);
        point.changes = found[i].changes;
      }
    }
    done += share;
  }
  return true;
}

}  // namespace hapticwall
