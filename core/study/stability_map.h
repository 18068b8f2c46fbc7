// Stability maps (Z-width): the same scene over a grid of two of its numbers, under several
// algorithms. A map is a plan; its cells are counted from 0 and can be run in any order, so that
// parts of it may be run by different machines.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/batch/batch_simulator.h"
#include "core/scene.h"
#include "core/study/scene_number.h"
#include "core/summary.h"

namespace hapticwall {

inline constexpr std::size_t kMostMapValues = 10000;  // on an axis

// Values of a number of the scene, in equal steps or equal ratios, both ends included to the bit.
struct MapAxis {
  SceneNumber number;
  double low = 0.0;
  double high = 0.0;
  std::size_t count = 2;  // 2 to kMostMapValues
  bool logarithmic = false;

  [[nodiscard]] double value(std::size_t index) const;  // index < count
};

// Where a cell stands.
struct MapPlace {
  std::size_t algorithm = 0;  // in StabilityMap::algorithms
  std::size_t y = 0;
  std::size_t x = 0;
};

// What a cell has come to; what does not apply is an absent optional.
struct MapFigures {
  Verdict verdict = Verdict::kSettled;
  std::optional<double> tail_peak_to_peak_m;
  std::optional<double> tail_force_mean_n;
  std::optional<double> tail_force_std_n;
  std::optional<double> displayed_stiffness_n_per_m;
  std::optional<double> max_penetration_m;
  std::optional<double> passivity_margin_j;

  friend bool operator==(const MapFigures&, const MapFigures&) = default;
};
[[nodiscard]] MapFigures map_figures(const Summary& summary);

struct StabilityMap {
  Scene scene;
  std::vector<std::size_t> algorithms;  // indices in algorithms(); what follows them is the scene's
  MapAxis x;
  MapAxis y;

  // x runs fastest, then y, then the algorithms.
  [[nodiscard]] std::size_t cell_count() const { return algorithms.size() * y.count * x.count; }
  [[nodiscard]] MapPlace place(std::size_t cell) const;
  [[nodiscard]] Scene scene_at(std::size_t cell) const;
};

// An axis with fewer than two values, or the first cell whose scene is not valid, and why; every
// value of both axes is tried.
[[nodiscard]] std::optional<SceneProblem> validate(const StabilityMap& map);

// Cells [begin, end), in their order. Every figure is that of simulate(), to the last bit. An empty
// result: `should_stop` has said so. Realtime-safe: no.
[[nodiscard]] std::vector<MapFigures> run_cells(const StabilityMap& map, std::size_t begin,
                                                std::size_t end,
                                                const std::function<bool()>& should_stop = {});

}  // namespace hapticwall
