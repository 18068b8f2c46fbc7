// Cost of a tick of the headless loop, each row beside the bare loop of the same run
// (docs/performance.md).
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "app/file/plugin/plugin_file.h"
#include "core/run/simulate.h"
#include "tests/benchmark/bare_loop.h"
#include "tests/benchmark/ratio_reporter.h"
#include "tests/benchmark/rows.h"

namespace hapticwall::benchmark_rows {
namespace {

void bare_loop(benchmark::State& state) {
  const Scene scene = builtin("golden-soft");
  const benchmark_loops::BareLoop loop(scene);
  // The peer must do the same work: it ends where the program's own loop ends.
  const double end_m = simulate(scene).final_state.truth.position_m;
  if (std::abs(loop.run().position_m - end_m) > 1e-12) {
    state.SkipWithError("the bare loop does not follow golden-soft");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(loop.run());
  state.counters[kTicksCounter] = static_cast<double>(scene.tick_count());
}

void with_samples(benchmark::State& state, const Scene& scene) {
  std::vector<Sample> samples(scene.tick_count());
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) { samples[sample.tick] = sample; };
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulate(scene, options));
    benchmark::ClobberMemory();
  }
  state.counters[kTicksCounter] = static_cast<double>(scene.tick_count());
}

void register_all() {
  benchmark::RegisterBenchmark(kBareLoop, bare_loop);
  const Scene soft = builtin("golden-soft");
  Scene encoder = soft;
  encoder.x().device.encoder_m = 0.254e-3;
  add_scene("golden-soft, full ledger", soft);
  add_scene("golden-soft, encoder, full ledger", encoder);
  benchmark::RegisterBenchmark("golden-soft, full ledger, every sample kept",
                               [soft](benchmark::State& state) { with_samples(state, soft); });
  const Scene friction = builtin("golden-soft-fric");
  add_scene("golden-soft-fric, full ledger", friction);
  add_friction_kernel("golden-soft-fric, full ledger", friction);
  if (!file::load_plugin(HAPTICWALL_BENCHMARK_PLUGIN)) std::abort();
  add_algorithms();
  add_environments();
  add_ladder();
  add_friction_events();
  add_maps();
}

}  // namespace
}  // namespace hapticwall::benchmark_rows

int main(int argc, char** argv) {
  hapticwall::benchmark_rows::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  hapticwall::benchmark_rows::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return reporter.failed() ? EXIT_FAILURE : EXIT_SUCCESS;
}
