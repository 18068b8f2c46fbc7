// The loops of a headless run. Each algorithm has its own, with its law inlined, for every exact
// plant (one object file per algorithm, core/CMakeLists.txt); one more set calls any algorithm
// through pointers, for all other plants, for an algorithm with a follower and for plug-ins.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/encoder.h"
#include "core/loop/servo.h"
#include "core/plant/output_stage.h"
#include "core/plant/plant_model.h"
#include "core/simulation/metrics.h"
#include "core/stabiliser/law_numbers.h"

// Inlines everything that the loop calls, except with a sanitizer: that would take minutes to
// compile, and speed does not matter there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HAPTICWALL_ONE_FUNCTION
#else
#define HAPTICWALL_ONE_FUNCTION [[gnu::flatten]]
#endif

namespace hapticwall {

// The state of a headless run except its plant.
struct HeadlessRun {
  const std::function<void(const Sample&)>& on_sample;
  bool shows_signals = false;
  Servo servo;
  OutputStage output;
  TickMetrics metrics;
  std::optional<std::uint64_t> diverged_at_tick = std::nullopt;
};

// Compile-time facts about a loop, which drop the branches for absent parts.
struct LoopParts {
  StepKnowledge known;
  bool maybe_encoder = true;
  bool encoder = false;
  bool maybe_output_stage = true;
  bool maybe_log = true;
};

// The loop for every scene, and the lean one for the most common scenes: one undamped wall, nothing
// between command and handle, in the steady state.
inline constexpr LoopParts kAnyLoop{.known = {.sound_device = true}};
constexpr LoopParts lean_loop(bool encoder, bool log) {
  return {.known = {.sound_device = true, .steady = true, .one_undamped_wall = true},
          .maybe_encoder = encoder,
          .encoder = encoder,
          .maybe_output_stage = false,
          .maybe_log = log};
}

// About 10 ms.
inline constexpr int kMaxChunkPieces = 8192;

// The plant as a device of the servo step: a position to read and a force to hold. The loop ends
// before the plant's position becomes NaN, so every reading is sound.
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

  // Passes the time to the next tick. Ends the chunk at this tick after much work, so that a run
  // can be stopped soon.
  void pass_tick(std::uint64_t tick, std::uint64_t& end) {
    if (plant_.try_tick(motion_, force_n_)) [[likely]] {
      return;
    }
    plant_.resume(motion_);
    advance_plant(plant_, force_n_);
    motion_ = plant_.motion();
    pieces_ += plant_.pieces();
    if (pieces_ > kMaxChunkPieces) [[unlikely]] {
      end = tick;
    }
  }
  void give_back() { plant_.resume(motion_); }

 private:
  // Out of line, because the loop's state must not have an address.
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
  int pieces_ = 0;
};

// The law of the only algorithm, inlined.
template <typename Law>
class LoopLaw : public InlinedLaw<Law> {
 public:
  static constexpr bool kLean = true;

  LoopLaw(Servo& servo, const WallSet& walls)
      : InlinedLaw<Law>(servo.stabiliser().first().parameters(), servo.stabiliser().first().state(),
                        walls),
        algorithm_(servo.stabiliser().first().algorithm()) {}
  void show(const StabiliserInput& input, double force_n, Signals& signals) const {
    show_signals(algorithm_, {this->parameters(), this->state(), this->walls(), input, force_n},
                 signals);
  }
  void give_back(Servo& servo) const { servo.stabiliser().first().state() = this->state(); }

 private:
  std::size_t algorithm_;
};

// Any algorithm and its follower.
class LoopCalls : public FollowedStabiliser {
 public:
  static constexpr bool kLean = false;

  LoopCalls(Servo& servo, const WallSet& /*walls*/)
      : FollowedStabiliser(std::move(servo.stabiliser())) {}
  void give_back(Servo& servo) { servo.stabiliser() = std::move(*this); }
};

// Ticks up to `end`. Works on copies and gives them back at the end, so that the loop's state can
// live in registers.
template <LoopParts kParts, typename Stabiliser, typename Plant>
HAPTICWALL_ONE_FUNCTION void run_loop(HeadlessRun& run, Plant& plant, std::uint64_t end) {
  const ServoSettings settings = run.servo.settings();
  Stabiliser stabiliser(run.servo, settings.walls);
  ServoState state = run.servo.state();
  TickMetrics metrics = run.metrics;
  HeadlessDevice<Plant, kParts> device(plant, run.output, settings.encoder_m);
  std::optional<std::uint64_t> diverged_at_tick;
  Sample sample;
  ShownStabiliser<kParts.maybe_log, Stabiliser> shown{
      stabiliser, run.shows_signals ? &sample.signals : nullptr};
  while (state.tick < end) {
    const double true_position_m = device.true_position_m();
    if (!device.in_reach()) [[unlikely]] {
      diverged_at_tick = state.tick;
      break;
    }
    const TickOutcome outcome = servo_step<kParts.known>(settings, state, shown, device);
    if (state.failed) [[unlikely]] {
      diverged_at_tick = outcome.tick;
      break;
    }
    if (kParts.maybe_log && run.on_sample) {
      write_sample(settings, state.ledger, outcome, sample);
      device.write_truth(sample.truth);
      run.on_sample(sample);
    }
    metrics.add(outcome.tick,
                {true_position_m, outcome.contact.penetration_m, outcome.force_n,
                 outcome.contact.in_contact, outcome.saturated},
                state.ledger);
    device.pass_tick(state.tick, end);
    metrics.add_net_work(device.net_work_j());
  }
  device.give_back();
  stabiliser.give_back(run.servo);
  run.servo.state() = state;
  run.metrics = metrics;
  run.diverged_at_tick = diverged_at_tick;
}

template <bool kLog, typename Stabiliser, typename Plant>
void run_lean_loop(HeadlessRun& run, Plant& plant, std::uint64_t end) {
  return run.servo.settings().encoder_m > 0.0
             ? run_loop<lean_loop(true, kLog), Stabiliser>(run, plant, end)
             : run_loop<lean_loop(false, kLog), Stabiliser>(run, plant, end);
}

// Optional parts are chosen here, once a chunk.
template <typename Stabiliser, typename Plant>
void choose_loop(HeadlessRun& run, Plant& plant, std::uint64_t end) {
  if constexpr (Plant::kPlain && Stabiliser::kLean) {
    const ServoSettings& settings = run.servo.settings();
    const ServoState& state = run.servo.state();
    const bool lean = !run.output.present() && has_one_undamped_wall(settings);
    if (lean && !is_steady(settings, state)) {
      const std::uint64_t unsteady = 1 + state.transition.ticks_left;
      run_loop<kAnyLoop, Stabiliser>(run, plant, std::min(end, state.tick + unsteady));
    }
    if (lean && is_steady(settings, state)) {
      return run.on_sample ? run_lean_loop<true, Stabiliser>(run, plant, end)
                           : run_lean_loop<false, Stabiliser>(run, plant, end);
    }
  }
  run_loop<kAnyLoop, Stabiliser>(run, plant, end);
}

template <typename Plant>
using HeadlessLoop = void (*)(HeadlessRun& run, Plant& plant, std::uint64_t end);

// An algorithm's loops, one for each exact plant.
template <typename Variant>
struct LoopTable;
template <typename... Plants>
struct LoopTable<std::variant<Plants...>> {
  using Type = std::tuple<HeadlessLoop<Plants>...>;
  template <typename Plant>
  static constexpr bool kHas = (std::is_same_v<Plant, Plants> || ...);
  template <typename Law>
  static constexpr Type of() {
    return {choose_loop<LoopLaw<Law>, Plants>...};
  }
};
using LawLoopTable = LoopTable<ExactPlantVariant<double>>;
using LawLoops = LawLoopTable::Type;

}  // namespace hapticwall
