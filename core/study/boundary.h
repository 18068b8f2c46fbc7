// Where along a number of the scene the verdict changes: a scan, then bisection.
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
  std::optional<MapAxis> x;             // a boundary for each of its values; else one
  MapAxis along;                        // what is searched; its values are scanned first
  double tolerance = 1e-3;              // of the value itself, at least kFinestTolerance

  [[nodiscard]] std::size_t boundary_count() const {
    return algorithms.size() * (x ? x->count : 1);
  }
};
inline constexpr double kFinestTolerance = 1e-12;

// The first change of verdict from the low end on. `settled` counts, everything else does not.
struct Boundary {
  std::size_t algorithm = 0;          // in BoundaryPlan::algorithms
  std::optional<double> x;            // where there is an axis
  std::optional<double> settled;      // the last value known to settle; nothing: none of the scan
  std::optional<double> unsettled;    // the first known not to; nothing: all of the scan settle
  std::size_t changes = 0;            // of verdict in the scan; more than 1: there are islands
  std::optional<Summary> at_settled;  // what it comes to there
};

struct BoundaryOptions {
  std::function<bool()> should_stop;
  std::function<void(double fraction)> progress;
};

// The first invalid scene of the scan, and why.
[[nodiscard]] std::optional<SceneProblem> validate(const BoundaryPlan& plan);

// x runs fastest, then the algorithms. An empty result: `should_stop` has said so. Realtime-safe:
// no.
[[nodiscard]] std::vector<Boundary> find_boundaries(const BoundaryPlan& plan,
                                                    const BoundaryOptions& options = {});

}  // namespace hapticwall
