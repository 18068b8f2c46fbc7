// The experiment of `hapticwall identify`: strokes to and fro that let a fit find a device's mass,
// damping, friction, delay and lag. It takes one position a tick and gives one force.
//
//   still → ramp to one side → ramp to the other → strokes that grow → random strokes → end
//
// x grows towards the wall and a positive force pushes out of it, so a positive force moves a
// device with the right sign to smaller x. Any doubt ends the experiment with zero force for good.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string_view>

namespace hapticwall::identify {

struct ExperimentSettings {
  double rate_hz = 1000.0;
  double force_limit_n = 2.0;  // greater than 0
  double encoder_m = 0.0;      // 0: unknown
  double peak_m = 0.018;       // of a stroke, from the start
  double duration_s = 25.0;    // of the strokes
  double force_step_n = 1e-3;  // a device would round other forces than multiples of this
  std::uint32_t seed = 1;      // of the random strokes
};

// Time without force, before the ramps.
inline constexpr double kStillS = 0.5;

enum class ExperimentState : std::uint8_t {
  kRunning,
  kDone,
  // The reasons to stop.
  // The handle moved by more than 1 mm plus two counts before the first force.
  kNotAtRest,
  // A positive force moved it to larger positions.
  kWrongSign,
  // It rested at 95 % of the force limit.
  kNoMotion,
  // It moved farther between two ticks than 3 m/s allow.
  kJumped,
  // It rested for 0.6 s under the force of a stroke.
  kFrozen,
  // A stroke lasted for 2.5 s, or many in turn missed the peak by half of it.
  kTravelNotReached,
  // It was beyond 2.8 times the peak, or often beyond 1.95 times.
  kTooFar
};
// A sentence for people; empty while it runs and after a whole experiment.
[[nodiscard]] std::string_view experiment_trouble(ExperimentState state);

// Observations of the experiment, beside the ticks.
struct ExperimentFacts {
  ExperimentState state = ExperimentState::kRunning;
  std::uint64_t ticks = 0;               // so far
  std::uint64_t first_stroke_tick = 0;   // ticks from here on are good for the fit
  std::uint32_t turns = 0;               // ends of strokes
  std::array<double, 2> break_away_n{};  // magnitude, towards smaller and larger x
  double rest_mean_m = 0.0;              // of the positions before the first force
  double rest_variance_m2 = 0.0;
  double rest_range_m = 0.0;
};

// Realtime-safe: yes, all of it. No allocation, lock or system call.
class Experiment {
 public:
  explicit Experiment(const ExperimentSettings& settings);

  // The force until the next tick, newtons, within ±force_limit_n; zero after the end.
  [[nodiscard]] double step(double position_m);
  [[nodiscard]] const ExperimentFacts& facts() const { return facts_; }
  // Share of the strokes' time, 0 to 1; 1 after any end.
  [[nodiscard]] double progress() const;

 private:
  static constexpr std::size_t kLevels = 3;
  enum class Phase : std::uint8_t { kStill, kRamp, kDrive, kCoast, kBrake };
  enum class Aim : std::uint8_t { kGrow, kRandom };

  [[nodiscard]] double seconds(std::uint64_t ticks) const;
  [[nodiscard]] double force() const;
  void look_at(double position_m);
  void rest(double position_m);
  void ramp();
  void start_ramp(double side);
  void drive();
  void coast();
  void brake();
  void turn();
  void learn_from(double peak_m);
  void grow(double half_period_s);
  void start_stroke(double side, std::size_t level);
  [[nodiscard]] double chance();  // from 0 to below 1
  void choose_stroke();
  void watch_strokes();
  void end(ExperimentState why);
  [[nodiscard]] double& threshold() { return threshold_m_[level_][side_ > 0.0 ? 1 : 0]; }
  [[nodiscard]] double level_n() const;
  [[nodiscard]] double largest_n() const;
  [[nodiscard]] double break_away_n() const;

  ExperimentSettings settings_;
  ExperimentFacts facts_;
  double hysteresis_m_;  // a change of position that is motion
  Phase phase_ = Phase::kStill;
  Aim aim_ = Aim::kGrow;
  std::uint64_t phase_tick_ = 0;  // at which the phase began
  std::uint64_t stroke_tick_ = 0;
  double start_m_ = 0.0;
  double previous_m_ = 0.0;
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
  double side_ = 1.0;       // of the wanted motion: +1 to larger x
  double along_m_ = 0.0;    // position from the start, in the direction of side_
  double extreme_m_ = 0.0;  // min of along_m_ in a ramp, its max in a stroke
  std::uint64_t extreme_tick_ = 0;
  double anchor_m_ = 0.0;  // the last place from which the handle moved
  std::uint64_t anchor_tick_ = 0;
  double amplitude_n_ = 0.0;
  std::size_t level_ = 0;
  std::array<std::array<double, 2>, kLevels> threshold_m_{};  // [level][side]
  bool coasts_ = false;
  double coast_from_m_ = 0.0;
  std::uint32_t settled_strokes_ = 0;
  std::uint32_t short_strokes_ = 0;
  std::uint32_t guards_ = 0;
  std::minstd_rand random_;
};

}  // namespace hapticwall::identify
