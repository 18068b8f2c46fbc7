// How much energy goes to and fro in a run: the scale of what rounding may lose. Tests only.
//
// The turnover is ∫(|F_h v| + |F_a v| + b v² + f_c |v|) dt, and what the kinetic energy and the
// spring that holds the handle (of the hand, or of its grip) take and give back. Both measures here
// are never more than that: differences over a tick miss what flows to and fro within it,
// differences over parts of a tick miss less. A test against them is never too lenient.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/plant/plant_model.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::testing {

class Turnover {
 public:
  void add(const PlantTruth& now) {
    joules_ += std::abs(now.actuator_work_j - last_.actuator_work_j) +
               std::abs(now.dissipation_j - last_.dissipation_j) +
               std::abs(now.hand_work_j - last_.hand_work_j) +
               std::abs(now.kinetic_j - last_.kinetic_j);
    last_ = now;
  }
  [[nodiscard]] double joules() const { return joules_; }

 private:
  PlantTruth last_;
  double joules_ = 0.0;
};

// Turnover of a run whose commands are known, seen within the ticks by the plant in long double:
// every straight piece of the path is taken in steps of 2^-40, 2^-40, 2^-39, … 1/2 of it, because
// fast motion happens right after the force or the path has changed.
class TurnoverWithinTicks {
 public:
  static constexpr int kHalvings = 40;

  explicit TurnoverWithinTicks(const Scene& scene)
      : scene_(scene), output_(scene), path_(path_of(scene)) {
    std::visit([&](auto& plant) { state_ = plant.hand_over(0); }, start_plant());
  }

  void tick(double command_n) {
    const double force_n = output_.pass(command_n);
    do {
      piece(force_n, path_.piece_fraction() * scene_.sampling.period_s());
    } while (path_.next_piece());
    path_.next_tick();
  }
  [[nodiscard]] double joules() const { return turnover_.joules() + spring_j_; }

 private:
  static HandPath path_of(const Scene& scene) {
    return scene.x().hand ? HandPath(scene.x().hand->path, scene.sampling.rate_hz)
                          : HandPath(scene.x().device.start_m, scene.sampling.rate_hz);
  }
  ReferencePlantVariant& start_plant() { return plants(scene_.sampling.period_s()).front(); }

  // Plants from the longest step to the shortest, for a piece of that duration.
  std::vector<ReferencePlantVariant>& plants(double duration_s) {
    std::vector<ReferencePlantVariant>& made = plants_[duration_s];
    Scene part = scene_;
    for (int halvings = 1; halvings <= kHalvings && made.size() < kHalvings; ++halvings) {
      part.sampling.rate_hz = std::ldexp(1.0 / duration_s, halvings);
      made.push_back(make_reference_plant(part));
    }
    return made;
  }

  void piece(double force_n, double duration_s) {
    std::vector<ReferencePlantVariant>& made = plants(duration_s);
    double done_s = 0.0;
    for (int halvings = kHalvings + 1; halvings >= 1; --halvings) {
      const int step = std::min(halvings, kHalvings);
      const double step_s = std::ldexp(duration_s, -step);
      std::visit([&](auto& plant) { pass(plant, force_n, done_s, step_s); },
                 made[static_cast<std::size_t>(step) - 1]);
      done_s += step_s;
    }
  }

  template <typename Plant>
  void pass(Plant& plant, double force_n, double done_s, double step_s) {
    const double speed = path_.velocity_m_per_s();
    const double begin_m = path_.position_m() + speed * done_s;
    // A line so long that its slope keeps all digits.
    constexpr double kFarM = 4.0;
    constexpr double kSlowest = 1e-100;
    std::vector<PathPoint> line{{0.0, begin_m}};
    if (std::abs(speed) > kSlowest) {
      line.push_back({kFarM / std::abs(speed), begin_m + std::copysign(kFarM, speed)});
    }
    HandPath straight(line, 1.0 / step_s);
    plant.take_over(state_, straight);
    plant.advance(force_n);
    state_ = plant.hand_over(force_n);
    PlantTruth truth;
    plant.write_truth(plant.motion(), truth);
    turnover_.add(truth);
    add_spring(begin_m + speed * step_s);
  }
  void add_spring(double path_m) {
    if (!scene_.x().hand) return;
    const HandSettings& hand = *scene_.x().hand;
    const double end_m = hand.has_grip() ? static_cast<double>(state_.hand_position_m) : path_m;
    const double stretch_m = end_m - static_cast<double>(state_.position_m);
    const double stored_j = 0.5 * hand.grip_stiffness_n_per_m.value_or(hand.stiffness_n_per_m) *
                            (stretch_m * stretch_m);
    spring_j_ += std::abs(stored_j - stored_j_);
    stored_j_ = stored_j;
  }

  Scene scene_;
  OutputStage output_;
  HandPath path_;
  std::map<double, std::vector<ReferencePlantVariant>> plants_;
  HandOver<long double> state_;
  Turnover turnover_;
  double stored_j_ = 0.0;  // in the spring that holds the handle
  double spring_j_ = 0.0;  // that it has taken and given
};

inline double turnover_within_ticks(const Scene& scene, std::span<const double> commands_n) {
  TurnoverWithinTicks turnover(scene);
  for (const double command_n : commands_n) turnover.tick(command_n);
  return turnover.joules();
}

}  // namespace hapticwall::testing
