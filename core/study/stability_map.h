// Stability maps: one scene over a grid of two of its numbers, under several algorithms. A cell is
// the verdict for the hand of the scene, and no bound for other hands. A map is a plan. Its cells
// have indices from 0 and run in any order, also on different machines.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/scene.h"
#include "core/scene_keys.h"
#include "core/summary.h"

namespace hapticwall {

inline constexpr std::size_t kMaxMapValues = 10000;  // on an axis

// Values of a number in equal steps or equal ratios; both ends are exact.
struct MapAxis {
  SceneNumber number;
  double low = 0.0;
  double high = 0.0;
  std::size_t count = 2;  // 2 to kMaxMapValues
  bool logarithmic = false;

  [[nodiscard]] double value(std::size_t index) const;  // index < count
};

struct MapPlace {
  std::size_t algorithm = 0;  // index in StabilityMap::algorithms
  std::size_t y = 0;
  std::size_t x = 0;
};

// Result of a cell; fields that do not apply are nullopt.
struct MapMetrics {
  Verdict verdict = Verdict::kSettled;
  std::optional<double> tail_peak_to_peak_m;
  std::optional<double> tail_force_mean_n;
  std::optional<double> tail_force_std_n;
  std::optional<double> displayed_stiffness_n_per_m;
  std::optional<double> max_penetration_m;
  std::optional<double> passivity_margin_j;

  friend bool operator==(const MapMetrics&, const MapMetrics&) = default;
};
// The part of a summary that a map keeps of every cell.
[[nodiscard]] MapMetrics map_metrics(const Summary& summary);

struct StabilityMap {
  Scene scene;
  std::vector<std::size_t> algorithms;  // indices in algorithms(); the scene sets `then`
  MapAxis x;
  MapAxis y;

  // x varies fastest, then y, then the algorithm.
  [[nodiscard]] std::size_t cell_count() const { return algorithms.size() * y.count * x.count; }
  // Precondition of both: cell < cell_count(). Realtime-safe: no.
  [[nodiscard]] MapPlace place(std::size_t cell) const;
  [[nodiscard]] Scene scene_at(std::size_t cell) const;
};

// A dimensionless form of a scene number. It makes maps of different devices comparable.
struct Dimensionless {
  std::string_view symbol;  // "K T²/m"
  double factor = 1.0;      // of a value of the axis
};

// K T²/m of the first wall's stiffness, B T/m of its damping, b T/m of the device's damping,
// f_c/(K Δ) of its friction; m is the mass of the handle. nullopt for other numbers, and if the
// other axis changes the factor. Realtime-safe: no.
[[nodiscard]] std::optional<Dimensionless> dimensionless(const Scene& scene, const MapAxis& axis,
                                                         const MapAxis& other);

// An axis with fewer than two values, or the first cell with an invalid scene. Reads only the edges
// of the grid, where every contradiction of two numbers shows. Realtime-safe: no.
[[nodiscard]] std::optional<SceneProblem> validate(const StabilityMap& map);

// Cells [begin, end), in order, with the same bits as simulate(). Empty if `should_stop` returned
// true. Throws SimulationRefused (simulate.h) with the name of the cell. Realtime-safe: no.
[[nodiscard]] std::vector<MapMetrics> run_cells(const StabilityMap& map, std::size_t begin,
                                                std::size_t end,
                                                const std::function<bool()>& should_stop = {});
// run_cells() for these cells, on at most `threads` threads; 0: as many as the processor runs.
[[nodiscard]] std::vector<MapMetrics> run_cells(const StabilityMap& map,
                                                std::span<const std::size_t> cells, int threads,
                                                const std::function<bool()>& should_stop = {});

}  // namespace hapticwall
