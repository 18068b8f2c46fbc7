// A headless run: a scene's servo and plant, tick by tick, for any variant of plants.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "core/algorithm/algorithm.h"
#include "core/plant/plant_model.h"
#include "core/run/headless_loop.h"
#include "core/run/simulate.h"

namespace hapticwall {

// Ticks between two questions whether to stop.
constexpr std::uint64_t kChunkTicks = 1024;

// Variant: of plants. `make` makes a scene's plant, `loop` chooses the loop of a chunk.
template <typename Variant>
class Simulation {
 public:
  using MakePlant = Variant (*)(const Scene&);
  using RunLoop = void (*)(HeadlessRun& run, Variant& plant, std::uint64_t end);

  Simulation(const Scene& scene, const SimulationOptions& options, MakePlant make, RunLoop loop)
      : scene_(scene),
        options_(options),
        make_plant_(make),
        run_loop_(loop),
        plant_(make(scene)),
        run_{options.on_sample,  options.signals,       Servo(servo_settings(scene)),
             OutputStage(scene), PlantVariation(scene), tick_metrics(scene)},
        hand_rests_(hand_rests(scene, tail_begin_tick(scene.tick_count(), scene.sampling.rate_hz),
                               scene.tick_count())) {}

  // Runs to the end, or until `should_stop` returns true. Call it once.
  SimulationResult run() {
    while (!over() && !stopped_early_) {
      if (options_.should_stop && options_.should_stop()) {
        stopped_early_ = true;
      } else {
        advance();
      }
    }
    return finish();
  }

  // A chunk at a time: up to the next change, and at most kChunkTicks; fewer if they take long or
  // have substeps.
  void advance() {
    while (next_change_ < options_.changes.size() &&
           options_.changes[next_change_].tick <= run_.servo.state().tick) {
      apply(options_.changes[next_change_++].scene);
    }
    const auto substeps = static_cast<std::uint64_t>(scene_.simulator.substeps);
    const std::uint64_t ticks = std::max<std::uint64_t>(kChunkTicks / substeps, 1);
    std::uint64_t end = std::min(scene_.tick_count(), run_.servo.state().tick + ticks);
    if (next_change_ < options_.changes.size()) {
      end = std::min(end, options_.changes[next_change_].tick);
    }
    run_loop_(run_, plant_, end);
  }
  [[nodiscard]] bool over() const { return tick() >= scene_.tick_count() || diverged(); }
  [[nodiscard]] std::uint64_t tick() const { return run_.servo.state().tick; }
  [[nodiscard]] bool diverged() const { return run_.diverged_at_tick.has_value(); }

  // Throws SimulationRefused if the plant gave up.
  SimulationResult finish() {
    SimulationResult result;
    result.stopped_early = stopped_early_;
    check_end();
    result.summary = summary();
    result.final_state.tick = run_.servo.state().tick;
    result.final_state.time_s =
        static_cast<double>(run_.servo.state().tick) / run_.servo.settings().rate_hz;
    std::visit(
        [&](const auto& plant) { plant.write_truth(plant.motion(), result.final_state.truth); },
        plant_);
    return result;
  }

 private:
  void apply(const Scene& changed) {
    const ServoSettings old = run_.servo.settings();
    Scene scene = changed;
    scene.sampling = scene.sampling.with_clock_of(scene_.sampling);
    ServoSettings settings = servo_settings(scene);
    settings.transition_s = old.transition_s;
    run_.servo.apply(settings);
    if (!same_plant(scene, scene_)) change_plant(scene);
    scene_.sampling = scene.sampling;
    scene_.x().device = scene.x().device;
    scene_.x().hand = scene.x().hand;
    scene_.simulator = scene.simulator;
  }

  // The new plant starts in the state of the old one, under the last force that reached the
  // amplifier.
  void change_plant(const Scene& scene) {
    const double last_n =
        run_.output.present() ? run_.output.last_n() : run_.servo.state().previous_force_n;
    Variant next = make_plant_(scene);
    std::visit(
        [&](auto& old) {
          const auto state = old.hand_over(last_n);
          std::visit([&](auto& plant) { plant.take_over(state, old.path()); }, next);
        },
        plant_);
    plant_ = std::move(next);
    OutputStage output(scene);
    output.take_over(run_.output, last_n);
    run_.output = std::move(output);
    run_.variation = PlantVariation(scene);
  }

  // The loop checks the reach before each tick; this is the check after the last one.
  void check_end() {
    if (std::visit([](const auto& plant) { return plant.gave_up(); }, plant_)) {
      throw SimulationRefused("tick " + std::to_string(tick()) + " under " +
                              algorithm_label(scene_.algorithm) + " is " +
                              std::string(kTooMuchWork));
    }
    const bool in_reach =
        std::visit([](const auto& plant) { return plant.in_reach(plant.motion()); }, plant_);
    if (!run_.diverged_at_tick && !in_reach) run_.diverged_at_tick = run_.servo.state().tick;
  }
  [[nodiscard]] Summary summary() const;

  Scene scene_;  // with the changes so far
  const SimulationOptions& options_;
  MakePlant make_plant_;
  RunLoop run_loop_;
  Variant plant_;
  HeadlessRun run_;
  bool hand_rests_;  // in the tail; changes leave the hand's path as it is
  std::size_t next_change_ = 0;
  bool stopped_early_ = false;
};

// Every scene starts at rest, so the initial kinetic energy is 0.
template <typename Variant>
Summary Simulation<Variant>::summary() const {
  const PlantEnergies energies = std::visit(
      [](const auto& plant) {
        const auto& energy = plant.energy();
        return plant_energies(energy.actuator_work_j, energy.dissipation_j(), energy.hand_work_j,
                              plant.kinetic_j());
      },
      plant_);
  return summarise(scene_, run_.metrics.stats(), run_.servo.state().ledger, energies,
                   {run_.servo.state().tick, run_.diverged_at_tick, hand_rests_});
}

}  // namespace hapticwall
