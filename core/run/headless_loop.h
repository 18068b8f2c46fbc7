// The loop of a headless run, one for each plant. It calls algorithms through pointers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/encoder.h"
#include "core/plant/output_stage.h"
#include "core/plant/plant_model.h"
#include "core/plant/plant_variation.h"
#include "core/run/metrics.h"
#include "core/tick/servo.h"

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
  PlantVariation variation;
  TickMetrics metrics;
  std::optional<std::uint64_t> diverged_at_tick = std::nullopt;
};

// Pieces of motion after which a chunk ends early, so that a stop takes effect soon: about 10 ms,
// because a piece takes about 1 µs.
inline constexpr int kMaxChunkPieces = 8192;

// The plant as a device of the servo step: a position to read and a force to hold. The loop ends
// before the plant's position becomes NaN, so every reading is sound.
template <typename Plant>
class HeadlessDevice {
 public:
  // Begins at this tick.
  HeadlessDevice(Plant& plant, OutputStage& output, const PlantVariation& variation,
                 double encoder_m, std::uint64_t tick)
      : plant_(plant),
        output_(output),
        variation_(variation),
        tick_(tick),
        motion_(plant.motion()),
        has_noise_(variation.has_noise()),
        has_encoder_(encoder_m > 0.0),
        has_output_stage_(output.present()),
        encoder_(encoder_m) {}

  DeviceReading read() {
    double position_m = true_position_m();
    if (has_noise_) [[unlikely]] {
      position_m = variation_.measured_m(position_m, tick_);
    }
    if (has_encoder_) {
      position_m = encoder_.read(position_m);
    }
    return {position_m, 0.0, DeviceState::kOk};
  }
  void write(double force_n) { force_n_ = has_output_stage_ ? output_.pass(force_n) : force_n; }

  [[nodiscard]] double true_position_m() const {
    return static_cast<double>(motion_.body.position_m);
  }
  [[nodiscard]] bool in_reach() const { return Plant::in_reach(motion_); }
  [[nodiscard]] double true_velocity_m_per_s() const {
    return static_cast<double>(motion_.body.velocity_m_per_s);
  }
  [[nodiscard]] double absorbed_j() const {
    return static_cast<double>(plant_.absorbed_j(motion_));
  }
  [[nodiscard]] double net_work_j() const {
    return static_cast<double>(plant_.net_work_j(motion_));
  }
  void write_truth(PlantTruth& truth) const { plant_.write_truth(motion_, truth); }

  // Passes the time to the next tick. Ends the chunk at this tick after much work, so that a run
  // can be stopped soon.
  void pass_tick(std::uint64_t tick, std::uint64_t& end) {
    tick_ = tick;
    if (plant_.try_tick(motion_, force_n_)) [[likely]] {
      return;
    }
    plant_.resume(motion_);
    advance_out_of_line(plant_, variation_, tick - 1, force_n_);
    motion_ = plant_.motion();
    pieces_ += plant_.pieces();
    if (pieces_ > kMaxChunkPieces) [[unlikely]] {
      end = tick;
    }
  }
  // Returns the motion to the plant. Call it once, after the last pass_tick().
  void give_back() { plant_.resume(motion_); }

 private:
  // Out of line, because the loop's state must not have an address.
  [[gnu::noinline]] static void advance_out_of_line(Plant& plant, const PlantVariation& variation,
                                                    std::uint64_t tick, double force_n) {
    advance_plant(plant, variation, tick, force_n);
  }

  Plant& plant_;
  OutputStage& output_;
  const PlantVariation& variation_;
  std::uint64_t tick_;
  typename Plant::Motion motion_;
  bool has_noise_;
  bool has_encoder_;
  bool has_output_stage_;
  CountingEncoder encoder_;
  double force_n_ = 0.0;
  int pieces_ = 0;
};

// Ticks up to `end`. Works on copies and gives them back at the end, so that the loop's state can
// live in registers.
template <typename Plant>
HAPTICWALL_ONE_FUNCTION void run_loop(HeadlessRun& run, Plant& plant, std::uint64_t end) {
  const ServoSettings settings = run.servo.settings();
  TickParts& parts = run.servo.parts();
  ServoState state = run.servo.state();
  TickMetrics metrics = run.metrics;
  HeadlessDevice<Plant> device(plant, run.output, run.variation, settings.encoder_m, state.tick);
  std::optional<std::uint64_t> diverged_at_tick;
  Sample sample;
  while (state.tick < end) {
    const double true_position_m = device.true_position_m();
    if (!device.in_reach()) [[unlikely]] {
      diverged_at_tick = state.tick;
      break;
    }
    const TickOutcome outcome = servo_step(settings, state, parts, device);
    if (state.failed) [[unlikely]] {
      diverged_at_tick = outcome.tick;
      break;
    }
    if (run.on_sample) {
      write_sample(settings, state.ledger, outcome, sample);
      if (run.shows_signals) parts.show(sample.signals);
      device.write_truth(sample.truth);
      run.on_sample(sample);
    }
    metrics.add(outcome.tick,
                {true_position_m, device.true_velocity_m_per_s(), device.absorbed_j(),
                 outcome.contact.penetration_m, outcome.force_n, outcome.contact.in_contact,
                 outcome.saturated},
                state.ledger);
    device.pass_tick(state.tick, end);
    metrics.add_net_work(device.net_work_j());
  }
  device.give_back();
  run.servo.state() = state;
  run.metrics = metrics;
  run.diverged_at_tick = diverged_at_tick;
}

}  // namespace hapticwall
