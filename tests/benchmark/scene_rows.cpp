#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <type_traits>
#include <variant>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/plant/plant_model.h"
#include "core/run/simulate.h"
#include "core/tick/servo.h"
#include "tests/benchmark/friction_loop.h"
#include "tests/benchmark/rows.h"

namespace hapticwall::benchmark_rows {
namespace {

// `events`: of friction in a run; 0 where they are not of interest.
void measure(benchmark::State& state, const Scene& scene, double events) {
  if (simulate(scene).summary.verdict == Verdict::kDiverged) {
    state.SkipWithError("a scene that ends early measures nothing");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(simulate(scene));
  state.counters[kTicksCounter] = static_cast<double>(scene.tick_count());
  if (events > 0.0) state.counters[kEventsCounter] = events;
}

void register_row(const std::string& name, const Scene& scene, double events = 0.0) {
  const std::function<void(benchmark::State&)> run = [scene, events](benchmark::State& state) {
    measure(state, scene, events);
  };
  benchmark::RegisterBenchmark(name.c_str(), run);
}

// golden-soft without its force limit: a mass, a hand's spring and damper, a wall.
Scene linear_scene() {
  Scene scene = builtin("golden-soft");
  scene.x().device.force_limit_n.reset();
  return scene;
}

struct Feature {
  const char* name;
  void (*add)(Scene& scene);
};
constexpr std::array<Feature, 6> kFeatures{
    Feature{"encoder", [](Scene& scene) { scene.x().device.encoder_m = 0.254e-3; }},
    Feature{"force limit", [](Scene& scene) { scene.x().device.force_limit_n = 8.9; }},
    Feature{"friction", [](Scene& scene) { scene.x().device.friction_n = 0.14; }},
    Feature{"grip",
            [](Scene& scene) {
              scene.x().hand->grip_stiffness_n_per_m = 1000.0;
              scene.x().hand->grip_damping_n_s_per_m = 1.0;
            }},
    Feature{"delay", [](Scene& scene) { scene.x().device.delay_ticks = 2; }},
    Feature{"lag", [](Scene& scene) { scene.x().device.amplifier_time_constant_s = 1e-3; }}};

// A plant behind the servo's tick, as the live loop has it.
template <typename Plant>
struct PlantDevice {
  Plant& plant;

  [[nodiscard]] DeviceReading read() const { return {plant.position_m(), 0.0, DeviceState::kOk}; }
  void write(double force_n) { plant.advance(force_n); }
};

// Stops and breaks of friction in a run of a scene without encoder.
std::uint64_t count_friction_events(const Scene& scene) {
  PlantVariant variant = make_plant(scene);
  std::uint64_t events = 0;
  std::visit(
      [&](auto& plant) {
        if constexpr (requires { plant.friction_events(); }) {
          Servo servo(servo_settings(scene));
          PlantDevice<std::remove_reference_t<decltype(plant)>> device{plant};
          for (std::uint64_t tick = 0; tick < scene.tick_count(); ++tick) (void)servo.tick(device);
          events = plant.friction_events();
        }
      },
      variant);
  return events;
}

// A scene with friction, which is counted, and the same without.
void add_events(const std::string& name, Scene scene) {
  register_row(name, scene, static_cast<double>(count_friction_events(scene)));
  scene.x().device.friction_n.reset();
  register_row(name + kWithoutSuffix, scene);
}

// The peer must have about as many events. A handle that comes to rest must rest at the same place.
bool does_the_same(const benchmark_loops::FrictionState& end, const Scene& scene) {
  constexpr double kSamePlaceM = 1e-9;
  constexpr double kSameShare = 0.02;
  const SimulationResult run = simulate(scene);
  const auto events = static_cast<double>(count_friction_events(scene));
  const bool same_place = std::abs(end.position_m - run.final_state.truth.position_m) < kSamePlaceM;
  return std::abs(static_cast<double>(end.events) - events) <= kSameShare * events &&
         (same_place || run.summary.verdict == Verdict::kOscillating);
}

}  // namespace

void add_friction_kernel(const std::string& name, const Scene& scene) {
  benchmark::RegisterBenchmark((name + kKernelSuffix).c_str(), [scene](benchmark::State& state) {
    const benchmark_loops::FrictionLoop loop(scene);
    if (!does_the_same(loop.run(), scene)) {
      state.SkipWithError("the friction kernel does not follow the scene");
      return;
    }
    for (auto _ : state) benchmark::DoNotOptimize(loop.run());
    state.counters[kTicksCounter] = static_cast<double>(scene.tick_count());
  });
}

Scene builtin(const char* name) {
  const auto loaded = file::load_scene(name);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
    std::exit(EXIT_FAILURE);
  }
  return loaded->scene;
}

Scene under(const char* algorithm, Scene scene) {
  scene.algorithm.index = find_algorithm(algorithm).value();
  return scene;
}

void add_scene(const std::string& name, const Scene& scene) {
  register_row(name, scene);
  // A run of one tick gives the cost before the loop begins.
  Scene one_tick = scene;
  one_tick.duration_s = scene.sampling.period_s();
  register_row(name + kSetUpSuffix, one_tick);
}

void add_ladder() {
  const Scene linear = linear_scene();
  Scene scene = linear;
  add_scene("ladder: linear", scene);
  for (const Feature& feature : kFeatures) {
    feature.add(scene);
    add_scene(std::string("ladder: + ") + feature.name, scene);
  }
  for (const Feature& feature : kFeatures) {
    scene = linear;
    feature.add(scene);
    add_scene(std::string("linear and ") + feature.name + " alone", scene);
  }
}

// Handles that a stiff wall throws to and fro for ever: they stop and break loose at every turn.
void add_friction_events() {
  Scene light = under("none", builtin("light"));
  light.x().device.friction_n = 0.5;
  light.x().device.encoder_m.reset();
  const std::string name = "friction events, handle alone (light)";
  add_events(name, light);
  add_friction_kernel(name, light);
  Scene tap = under("none", builtin("tap"));
  tap.x().device.encoder_m.reset();
  add_events("friction events, grip (tap)", tap);
}

}  // namespace hapticwall::benchmark_rows
