// A stability map as `hapticwall map` makes it: all cores, set-up of every cell included.
#include <benchmark/benchmark.h>

#include <string>

#include "core/algorithm/algorithm.h"
#include "core/study/stability_map.h"
#include "tests/benchmark/rows.h"

namespace hapticwall::benchmark_rows {
namespace {

constexpr std::size_t kSide = 200;
constexpr double kDurationS = 2.0;
constexpr int kRepetitions = 3;

StabilityMap map_of(Scene scene) {
  scene.duration_s = kDurationS;
  StabilityMap map;
  map.algorithms = {scene.algorithm.index};
  map.x = {find_scene_number(scene, "wall.stiffness_n_per_m").value(), 300.0, 1e5, kSide, true};
  map.y = {find_scene_number(scene, "device.damping_n_s_per_m").value(), 0.1, 10.0, kSide, true};
  map.scene = std::move(scene);
  return map;
}

void add_map(const std::string& name, const Scene& scene) {
  const StabilityMap map = map_of(scene);
  benchmark::RegisterBenchmark(name.c_str(),
                               [map](benchmark::State& state) {
                                 for (auto _ : state) {
                                   benchmark::DoNotOptimize(run_cells(map, 0, map.cell_count()));
                                 }
                                 const auto cells = static_cast<double>(map.cell_count());
                                 state.counters[kTicksCounter] =
                                     cells * static_cast<double>(map.scene_at(0).tick_count());
                                 state.counters[kSimulatedCounter] = cells * kDurationS;
                               })
      ->Iterations(1)
      ->Repetitions(kRepetitions)
      ->UseRealTime();
}

}  // namespace

void add_maps() {
  add_map("map, golden-soft, none", builtin("golden-soft"));
  add_map("map, press, none", under("none", builtin("press")));
  add_map("map, press, energy-bounding", under("energy-bounding", builtin("press")));
}

}  // namespace hapticwall::benchmark_rows
