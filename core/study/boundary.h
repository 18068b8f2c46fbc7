// Finds the change of verdict along a number of the scene, by a scan and bisection.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "core/study/stability_map.h"

namespace hapticwall {

struct BoundaryPlan {
  Scene scene;
  std::vector<std::size_t> algorithms;  // indices in algorithms()
  std::optional<MapAxis> x;             // one boundary for each of its values
  MapAxis along;                        // searched key; its values are scanned first
  double tolerance = 1e-3;              // relative to the value, at least kMinTolerance

  [[nodiscard]] std::size_t boundary_count() const {
    return algorithms.size() * (x ? x->count : 1);
  }
};
inline constexpr double kMinTolerance = 1e-12;

// First change between settled and any other verdict, from the low end.
struct Boundary {
  std::size_t algorithm = 0;          // in BoundaryPlan::algorithms
  std::optional<double> x;            // value of the axis x, if any
  std::optional<double> settled;      // last value known to settle; nullopt: none
  std::optional<double> unsettled;    // first known not to; nullopt: all settle
  std::size_t changes = 0;            // of verdict in the scan; more than 1: islands
  std::optional<Summary> at_settled;  // at `settled`
};

struct BoundaryOptions {
  std::function<bool()> should_stop;
  std::function<void(double fraction)> progress;
};

// First invalid scene of the scan, if any.
[[nodiscard]] std::optional<SceneProblem> validate(const BoundaryPlan& plan);

// x varies fastest, then the algorithm. Empty if `should_stop` returned true. Realtime-safe: no.
[[nodiscard]] std::vector<Boundary> find_boundaries(const BoundaryPlan& plan,
                                                    const BoundaryOptions& options = {});

}  // namespace hapticwall
