// The headless loop: a scene's servo and plant, tick by tick, for any variant of plants.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/metrics.h"
#include "core/plant/plant_model.h"
#include "core/servo.h"
#include "core/simulate.h"

// Everything that the loop calls is inlined into it. Instrumented by a sanitizer that takes minutes
// to compile, and no sanitizer is in a hurry.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HAPTICWALL_ONE_FUNCTION
#else
#define HAPTICWALL_ONE_FUNCTION [[gnu::flatten]]
#endif

namespace hapticwall {

// Ticks between two questions whether to stop.
constexpr std::uint64_t kChunkTicks = 1024;

// Precondition of a headless run.
inline void refuse_pointer(const Scene& scene) {
  if (scene.hand && scene.hand->follows_mouse) {
    throw std::invalid_argument("a hand that follows the mouse needs the window");
  }
}

// What the type of a loop knows; a scene's other parts cost it nothing.
struct LoopParts {
  StepKnowledge known;
  bool maybe_encoder = true;
  bool encoder = false;
  bool maybe_output_stage = true;
  bool maybe_log = true;
};

// The loop for anything, and the one for the scenes that come most: an undamped wall, nothing
// between command and handle, in its steady state.
inline constexpr LoopParts kAnyLoop{.known = {.sound_device = true}};
constexpr LoopParts lean_loop(bool encoder, bool log) {
  return {.known = {.sound_device = true, .steady = true, .one_undamped_wall = true},
          .maybe_encoder = encoder,
          .encoder = encoder,
          .maybe_output_stage = false,
          .maybe_log = log};
}

// The plant as the servo step sees it: a position to read and a force to hold. The loop ends where
// the plant's position is no number any more, so that every reading is sound.
template <typename Plant, LoopParts kParts>
class HeadlessDevice {
 public:
  HeadlessDevice(Plant& plant, OutputStage& output, double encoder_m)
      : plant_(plant),
        output_(output),
        motion_(plant.motion()),
        has_encoder_(encoder_m > 0.0),
        has_output_stage_(output.present()),
        encoder_(encoder_m) {}

  DeviceReading read() {
    double position_m = true_position_m();
    if (kParts.maybe_encoder && (kParts.encoder || has_encoder_)) {
      position_m = encoder_.read(position_m);
    }
    return {position_m, 0.0, DeviceState::kOk};
  }
  void write(double force_n) {
    force_n_ = kParts.maybe_output_stage && has_output_stage_ ? output_.pass(force_n) : force_n;
  }

  [[nodiscard]] double true_position_m() const {
    return static_cast<double>(motion_.body.position_m);
  }
  [[nodiscard]] bool in_reach() const { return Plant::in_reach(motion_); }
  [[nodiscard]] double net_work_j() const {
    return static_cast<double>(plant_.net_work_j(motion_));
  }
  void write_truth(PlantTruth& truth) const { plant_.write_truth(motion_, truth); }

  // The time between two ticks passes.
  void pass_tick() {
    if (plant_.try_tick(motion_, force_n_)) [[likely]] {
      return;
    }
    plant_.resume(motion_);
    advance_plant(plant_, force_n_);
    motion_ = plant_.motion();
  }
  void give_back() { plant_.resume(motion_); }

 private:
  // Out of line: the loop's own state must not have an address.
  [[gnu::noinline]] static void advance_plant(Plant& plant, double force_n) {
    plant.advance(force_n);
  }

  Plant& plant_;
  OutputStage& output_;
  typename Plant::Motion motion_;
  bool has_encoder_;
  bool has_output_stage_;
  CountingEncoder encoder_;
  double force_n_ = 0.0;
};

// Variant: of plants, and `make` makes that of a scene.
template <typename Variant>
class Simulation {
 public:
  using MakePlant = Variant (*)(const Scene&);

  Simulation(const Scene& scene, const SimulationOptions& options, MakePlant make)
      : scene_(scene),
        options_(options),
        make_plant_(make),
        servo_(servo_settings(scene)),
        plant_(make(scene)),
        output_(scene.device),
        metrics_(tail_begin_tick(scene.tick_count(), scene.sampling.rate_hz)) {}

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

  // A chunk at a time: up to the next change, and at most kChunkTicks.
  void advance() {
    while (next_change_ < options_.changes.size() &&
           options_.changes[next_change_].tick <= servo_.state().tick) {
      apply(options_.changes[next_change_++].scene);
    }
    std::uint64_t end = std::min(scene_.tick_count(), servo_.state().tick + kChunkTicks);
    if (next_change_ < options_.changes.size()) {
      end = std::min(end, options_.changes[next_change_].tick);
    }
    run_until(end);
  }
  [[nodiscard]] bool over() const {
    return servo_.state().tick >= scene_.tick_count() || diverged_at_tick_.has_value();
  }

  SimulationResult finish() {
    SimulationResult result;
    result.stopped_early = stopped_early_;
    check_end();
    result.summary = summary();
    result.final_state.tick = servo_.state().tick;
    result.final_state.time_s =
        static_cast<double>(servo_.state().tick) / servo_.settings().rate_hz;
    visit_plant(
        [&](const auto& plant) { plant.write_truth(plant.motion(), result.final_state.truth); },
        plant_);
    return result;
  }

 private:
  void apply(const Scene& changed) {
    const ServoSettings old = servo_.settings();
    Scene scene = changed;
    scene.sampling = scene_.sampling;
    ServoSettings settings = servo_settings(scene);
    settings.transition_s = old.transition_s;
    servo_.apply(settings);
    if (!same_plant(scene, scene_)) change_plant(scene);
    scene_.device = scene.device;
    scene_.hand = scene.hand;
    scene_.simulator = scene.simulator;
  }

  void change_plant(const Scene& scene) {
    const double last_n = output_.present() ? output_.last_n() : servo_.state().previous_force_n;
    Variant next = make_plant_(scene);
    visit_plant(
        [&](auto& old) {
          const auto state = old.hand_over(last_n);
          visit_plant([&](auto& plant) { plant.take_over(state, old.path()); }, next);
        },
        plant_);
    plant_ = std::move(next);
    OutputStage output(scene.device);
    output.take_over(output_, last_n);
    output_ = std::move(output);
  }

  // Plant, algorithm and optional parts are chosen here, once a chunk.
  void run_until(std::uint64_t end) {
    visit_plant(
        [&](auto& plant) {
          servo_.with_algorithm([&](auto& stabiliser) { choose_loop(plant, stabiliser, end); });
        },
        plant_);
  }

  template <typename Plant, typename Stabiliser>
  void choose_loop(Plant& plant, Stabiliser& stabiliser, std::uint64_t end) {
    // The lean loops are for the scenes that come most.
    if constexpr (Plant::kPlain && !std::is_same_v<Stabiliser, FollowedStabiliser>) {
      const bool lean = !output_.present() && has_one_undamped_wall(servo_.settings());
      if (lean && !is_steady(servo_.state())) {
        const std::uint64_t unsteady = 1 + servo_.state().transition.ticks_left;
        run_loop<kAnyLoop>(plant, stabiliser, std::min(end, servo_.state().tick + unsteady));
      }
      if (lean && is_steady(servo_.state())) {
        return options_.on_sample ? choose_lean_loop<true>(plant, stabiliser, end)
                                  : choose_lean_loop<false>(plant, stabiliser, end);
      }
    }
    run_loop<kAnyLoop>(plant, stabiliser, end);
  }

  template <bool kLog, typename Plant, typename Stabiliser>
  void choose_lean_loop(Plant& plant, Stabiliser& stabiliser, std::uint64_t end) {
    return servo_.settings().encoder_m > 0.0
               ? run_loop<lean_loop(true, kLog)>(plant, stabiliser, end)
               : run_loop<lean_loop(false, kLog)>(plant, stabiliser, end);
  }

  // Works on copies and gives them back at the end, so that the loop's state can live in registers.
  template <LoopParts kParts, typename Plant, typename Stabiliser>
  HAPTICWALL_ONE_FUNCTION void run_loop(Plant& plant, Stabiliser& shared_stabiliser,
                                        std::uint64_t end) {
    const ServoSettings settings = servo_.settings();
    Stabiliser stabiliser = shared_stabiliser;
    ServoState state = servo_.state();
    TickMetrics metrics = metrics_;
    HeadlessDevice<Plant, kParts> device(plant, output_, settings.encoder_m);
    std::optional<std::uint64_t> diverged_at_tick;
    Sample sample;
    while (state.tick < end) {
      const double true_position_m = device.true_position_m();
      if (!device.in_reach()) [[unlikely]] {
        diverged_at_tick = state.tick;
        break;
      }
      const TickOutcome outcome = servo_step<kParts.known>(settings, state, stabiliser, device);
      if (state.failed) [[unlikely]] {
        diverged_at_tick = outcome.tick;
        break;
      }
      if (kParts.maybe_log && options_.on_sample) {
        write_sample(settings, state.ledger, outcome, sample);
        device.write_truth(sample.truth);
        options_.on_sample(sample);
      }
      metrics.add(outcome.tick,
                  {true_position_m, outcome.contact.penetration_m, outcome.force_n,
                   outcome.contact.in_contact, outcome.saturated},
                  state.ledger);
      device.pass_tick();
      metrics.add_net_work(device.net_work_j());
    }
    device.give_back();
    shared_stabiliser = stabiliser;
    servo_.state() = state;
    metrics_ = metrics;
    diverged_at_tick_ = diverged_at_tick;
  }

  // The loop looks before a tick; what the last tick's hold has done is looked at here.
  void check_end() {
    const bool in_reach =
        visit_plant([](const auto& plant) { return plant.in_reach(plant.motion()); }, plant_);
    if (!diverged_at_tick_ && !in_reach) diverged_at_tick_ = servo_.state().tick;
  }
  [[nodiscard]] Summary summary() const;

  Scene scene_;  // with the changes so far
  const SimulationOptions& options_;
  MakePlant make_plant_;
  Servo servo_;
  Variant plant_;
  OutputStage output_;
  TickMetrics metrics_;
  std::size_t next_change_ = 0;
  bool stopped_early_ = false;
  std::optional<std::uint64_t> diverged_at_tick_;
};

template <typename Variant>
Summary Simulation<Variant>::summary() const {
  Summary summary;
  summary.scene = scene_.name;
  summary.algorithm = algorithm_label(scene_.algorithm);
  summary.ticks = servo_.state().tick;
  summary.duration_s = static_cast<double>(servo_.state().tick) / servo_.settings().rate_hz;
  metrics_.write(summary, !scene_.walls.empty());
  if (diverged_at_tick_) {
    summary.verdict = Verdict::kDiverged;
    summary.diverged_at_tick = diverged_at_tick_;
  }
  summary.energy_cv_j = servo_.state().ledger.cv_j;
  summary.energy_hold_j = servo_.state().ledger.hold_j;
  summary.energy_scv_j = servo_.state().ledger.scv_j;
  summary.energy_budget_j = servo_.state().ledger.budget_j;
  visit_plant(
      [&](const auto& plant) {
        const auto& energy = plant.energy();
        summary.true_actuator_work_j = static_cast<double>(energy.actuator_work_j);
        summary.true_dissipation_j = static_cast<double>(energy.dissipation_j());
        summary.true_hand_work_j = static_cast<double>(energy.hand_work_j);
        summary.kinetic_j = static_cast<double>(plant.kinetic_j());
        // Every scene starts at rest: there is no kinetic energy at the start.
        summary.energy_balance_error_j =
            static_cast<double>(energy.hand_work_j - (plant.kinetic_j() + energy.dissipation_j() +
                                                      energy.actuator_work_j));
      },
      plant_);
  summary.passivity_margin_j = metrics_.passivity_margin_j();
  return summary;
}

}  // namespace hapticwall
