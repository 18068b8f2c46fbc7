#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/batch_simulator.h"
#include "tests/benchmark/rows.h"

namespace hapticwall::benchmark_rows {
namespace {

constexpr std::size_t kScenes = 128;

// A row of a stability map: the scene with one stiffness after the other.
std::vector<Scene> varied(const Scene& scene) {
  std::vector<Scene> scenes(kScenes, scene);
  for (std::size_t i = 0; i < kScenes; ++i) {
    scenes[i].x().walls.front().stiffness_n_per_m *= 0.5 + 0.01 * static_cast<double>(i);
  }
  return scenes;
}

// On one core, as every row of the table.
void measure(benchmark::State& state, const std::vector<Scene>& scenes) {
  BatchOptions options;
  options.threads = 1;
  for (auto _ : state) benchmark::DoNotOptimize(simulate_batch(scenes, options));
  state.counters[kTicksCounter] = static_cast<double>(kScenes * scenes.front().tick_count());
}

void add_batch_row(const std::string& name, const Scene& scene) {
  const std::vector<Scene> scenes = varied(scene);
  Scene one_tick = scene;
  one_tick.duration_s = scene.sampling.period_s();
  const std::vector<Scene> set_ups = varied(one_tick);
  benchmark::RegisterBenchmark(name.c_str(),
                               [scenes](benchmark::State& state) { measure(state, scenes); });
  benchmark::RegisterBenchmark((name + kSetUpSuffix).c_str(),
                               [set_ups](benchmark::State& state) { measure(state, set_ups); });
}

Scene with_encoder(Scene scene) {
  scene.x().device.encoder_m = 0.254e-3;
  return scene;
}

}  // namespace

void add_batch() {
  const Scene soft = builtin("golden-soft");
  for (const AlgorithmDescription& algorithm : algorithms()) {
    const Scene scene = under(std::string(algorithm.name).c_str(), soft);
    const std::string name = ", " + std::string(algorithm.name);
    add_batch_row("batch, summary" + name, scene);
    add_batch_row("batch, summary" + name + ", encoder", with_encoder(scene));
  }
}

}  // namespace hapticwall::benchmark_rows
