#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <string>

#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/tick/servo.h"
#include "tests/benchmark/rows.h"

namespace hapticwall::benchmark_rows {
namespace {

constexpr std::array kScenes{"golden-soft", "golden-soft-fric", "press", "tap", "light"};
constexpr std::size_t kPositions = 1024;
constexpr std::size_t kLiveTicks = 4 * kPositions;

// A handle that goes 0.8 mm into the wall and back, for ever. Every reading is sound.
class MovedDevice {
 public:
  explicit MovedDevice(double wall_m) {
    constexpr double kHalf = static_cast<double>(kPositions) / 2.0;
    for (std::size_t i = 0; i < kPositions; ++i) {
      const auto share = static_cast<double>(std::min(i, kPositions - i)) / kHalf;
      positions_m_[i] = wall_m + 1e-3 * (share - 0.2);
    }
  }
  [[nodiscard]] DeviceReading read() {
    return {positions_m_[next_++ % kPositions], 0.0, DeviceState::kOk};
  }
  void write(double force_n) { benchmark::DoNotOptimize(force_n); }

 private:
  std::array<double, kPositions> positions_m_{};
  std::size_t next_ = 0;
};

// Of `press`, and where the other environments have their surface.
constexpr double kWallM = 0.05;

Scene press_in(const Environment& environment) {
  Scene scene = under("none", builtin("press"));
  scene.environment.index = find_environment(environment.description.name).value();
  if (!scene.environment.is_walls()) scene.x().walls.clear();
  return scene;
}

// The servo's part of the live loop: a tick with its whole sample.
void live_ticks(benchmark::State& state, const Scene& scene) {
  Servo servo(servo_settings(scene));
  MovedDevice device(kWallM);
  for (auto _ : state) {
    for (std::size_t tick = 0; tick < kLiveTicks; ++tick)
      benchmark::DoNotOptimize(servo.tick(device).force_n);
  }
  state.counters[kTicksCounter] = static_cast<double>(kLiveTicks);
}

}  // namespace

// The row of `walls` is the peer of the others.
void add_environments() {
  for (const Environment& environment : environments()) {
    const std::string name = "live tick in " + std::string(environment.description.name);
    benchmark::RegisterBenchmark(
        name.c_str(),
        [scene = press_in(environment)](benchmark::State& state) { live_ticks(state, scene); });
  }
}

void add_algorithms() {
  for (const AlgorithmDescription& algorithm : algorithms()) {
    const std::string name(algorithm.name);
    for (const char* scene : kScenes)
      add_scene(std::string(scene) + ", " + name, under(name.c_str(), builtin(scene)));
    benchmark::RegisterBenchmark(("live tick, " + name).c_str(),
                                 [scene = under(name.c_str(), builtin("press"))](
                                     benchmark::State& state) { live_ticks(state, scene); });
  }
}

}  // namespace hapticwall::benchmark_rows
