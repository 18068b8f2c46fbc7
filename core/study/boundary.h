// Finds where the verdict changes along a number of the scene: first and last failure, first and
// last settled value, by a scan and bisection.
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

// Smallest and largest value with a verdict; nullopt: none in the scan. `settled` counts settled
// and moving; a wall that is not touched has no verdict. A change of verdict between
// two values of the scan is found to the tolerance. A change and its reverse between two values of
// the scan are not seen: the step of the scan belongs to the result.
struct Extent {
  std::optional<double> first;
  std::optional<double> last;
};

struct Boundary {
  std::size_t algorithm = 0;  // index in BoundaryPlan::algorithms
  std::optional<double> x;    // value of the axis x, if any
  Extent settled;
  Extent failed;                      // chatters, gives energy or diverges
  std::size_t changes = 0;            // of verdict in the scan; more than 1: islands
  std::optional<Summary> at_settled;  // on the settled side of the first change
  // Limit by theory: exact_stable_limit(). nullopt unless the key is the stiffness of the only
  // wall.
  std::optional<double> stable_below_n_per_m;
};

struct BoundaryOptions {
  int threads = 0;  // max; 0: as many as the processor runs at a time
  std::function<bool()> should_stop;
  // Called by any thread, never by two at once; monotonic.
  std::function<void(double fraction)> progress;
};

// First invalid scene of the scan, if any. Runs none. Realtime-safe: no.
[[nodiscard]] std::optional<SceneProblem> validate(const BoundaryPlan& plan);

// x varies fastest, then the algorithm. Empty if `should_stop` returned true. A boundary takes
// `along.count` runs for the scan and about log2(1/tolerance) for each of at most two changes.
// Realtime-safe: no.
[[nodiscard]] std::vector<Boundary> find_boundaries(const BoundaryPlan& plan,
                                                    const BoundaryOptions& options = {});

}  // namespace hapticwall
