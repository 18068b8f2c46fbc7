// The CSV of a stability map: any text, read as the map that is asked for.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/file/map/map_file.h"
#include "app/file/map/map_rows.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/study/stability_map.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

MapAxis axis_of(const Scene& scene, const char* path, double low, double high) {
  MapAxis axis;
  axis.number = find_scene_number(scene, path).value();
  axis.low = low;
  axis.high = high;
  return axis;
}

// Two values on either axis, under two algorithms: eight cells.
StabilityMap small_map() {
  StabilityMap map;
  map.scene = file::parse_scene(
                  "[device]\nmass_kg = 0.05\ndamping_n_s_per_m = 1\n"
                  "[hand]\nstiffness_n_per_m = 100\ndamping_n_s_per_m = 1\npath = [[0, 0.06]]\n"
                  "[[wall]]\nposition_m = 0.05\nstiffness_n_per_m = 1000\n",
                  "map.toml")
                  ->scene;
  map.algorithms = {*find_algorithm("none"), *find_algorithm("virtual-coupling")};
  map.x = axis_of(map.scene, "wall.stiffness_n_per_m", 1e3, 1e4);
  map.y = axis_of(map.scene, "device.damping_n_s_per_m", 0.1, 2.0);
  return map;
}

bool is_finite(const MapMetrics& figures) {
  return std::ranges::all_of(
      std::vector{figures.tail_peak_to_peak_m, figures.tail_force_mean_n, figures.tail_force_std_n,
                  figures.displayed_stiffness_n_per_m, figures.max_penetration_m,
                  figures.passivity_margin_j},
      [](const std::optional<double>& value) { return std::isfinite(value.value_or(0.0)); });
}

Outcome fuzz_one(Bytes input) {
  static const StabilityMap kMap = small_map();
  const std::string origin = "fuzz.csv";
  const auto figures = file::parse_map(text_of(input), origin, kMap);
  if (!figures) {
    require_one_clean_line(figures.error(), origin);
    return Outcome::kRefused;
  }
  require(figures->size() == kMap.cell_count(), "there are as many cells as the map has");
  std::string written = file::map_header(kMap);
  for (std::size_t cell = 0; cell < figures->size(); ++cell) {
    require(is_finite((*figures)[cell]), "the figures of a cell are finite");
    file::append_map_row(written, kMap, cell, (*figures)[cell]);
  }
  const auto again = file::parse_map(written, "written.csv", kMap);
  require(again.ok() && *again == *figures, "a map that was written reads back the same");
  return Outcome::kTaken;
}

const Registered kRegistered({"map", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
