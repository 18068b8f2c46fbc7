// Measures by which the literature ranks stabilising algorithms, for any scene: the stiffest wall,
// the hardness at the touch, and the energy to the hand. Axis x only. The study varies the
// stiffness of the first wall. docs/study.md defines the measures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/sample.h"
#include "core/scene.h"
#include "core/study/boundary.h"
#include "core/summary.h"

namespace hapticwall {

// Duration of the initial rise, from the first tick in contact. Our choice: long enough for one or
// two encoder counts, short for a hand.
inline constexpr double kInitialRiseS = 0.01;

// The first contact begins at tick k0, the first in contact after one out of contact. Its rise ends
// before the command first falls, at the first tick at the force limit, and before the handle
// leaves the wall.
//
// Rate-hardness, N/s per m/s = N/m: "initial rate of change of force versus initial velocity upon
// penetrating the surface" (Lawrence, Pao, Dougherty, Salada & Pavlou, "Rate-hardness: a new
// performance metric for haptic interfaces", IEEE Trans. Robotics and Automation 16(4), 2000; cited
// from memory). For the sampled force F_d we use
//
//   max over k of (F_d(k) - F_d(k0)) / ((k - k0) T v_a)
//
// over the ticks k > k0 of the rise within kInitialRiseS, or over the first later tick with more
// force than k0. v_a is the approach speed: the true velocity at k0, before the wall acts. Reasons:
//  * from k0, not from the tick before: the instant of the contact between the two is random, and
//    so is the first count of an encoder;
//  * the steepest mean, not the steepest tick: one encoder count is a jump of K Delta, which says
//    nothing about the wall over one tick;
//  * the steepest, not the last: a contact of some milliseconds flattens at once.
// A spring wall at constant speed gives exactly its stiffness. An encoder adds up to one tick in
// the number of ticks per count. FirstContact::kind() marks two rises without such a mean:
//  * kOneTick: the command does not rise after k0. The value is the jump at k0 over one tick and
//    depends on the position of the wall between two counts;
//  * kToTheLimit: the limit cuts the rise off. The mean from the last free tick on counts too,
//    because after a jump close to the limit little is left.
enum class RiseKind : std::uint8_t { kMean, kOneTick, kToTheLimit };

class FirstContact {
 public:
  explicit FirstContact(double period_s) : period_s_(period_s) {}

  // Call for every sample of a simulated run, in order. Realtime-safe: yes.
  void add(const Sample& sample);

  // v_a; nullopt without an entry (no contact, or in the wall from the start).
  [[nodiscard]] std::optional<double> approach_speed_m_per_s() const;
  // May be 0; nullopt without an entry, or if the handle did not move inwards there.
  [[nodiscard]] std::optional<double> rate_hardness_n_per_m() const;
  // Kind of the rise behind rate_hardness_n_per_m().
  [[nodiscard]] RiseKind kind() const { return kind_; }

 private:
  enum class Phase : std::uint8_t { kUnknown, kFree, kRising, kOver };

  void enter(const Sample& sample);
  void follow(const Sample& sample);
  void take(double slope_n_per_s, RiseKind kind);

  double period_s_;
  Phase phase_ = Phase::kUnknown;
  RiseKind kind_ = RiseKind::kOneTick;
  std::uint64_t entry_tick_ = 0;
  double speed_m_per_s_ = 0.0;
  double free_force_n_ = 0.0;  // of the last tick out of contact
  double entry_force_n_ = 0.0;
  double last_force_n_ = 0.0;
  std::optional<double> steepest_n_per_s_;
};

struct ContactStudyPlan {
  Scene scene;
  std::vector<std::size_t> algorithms;  // indices in algorithms(); compared_algorithms() has rows
  // Scanned stiffnesses of the first wall, in equal ratios.
  double low_n_per_m = 100.0;
  double high_n_per_m = 1e6;
  std::size_t count = 926;  // in steps of 1 %; 2 to kMaxMapValues
  double tolerance = 1e-3;  // of the refinement, relative to the value

  // Precondition: the scene has a wall.
  [[nodiscard]] MapAxis stiffnesses() const;
};

struct ContactMetrics {
  // Along the stiffness of the first wall. `limits.failed.first` is the first failure.
  // `limits.at_settled` is the run just below it if the softest wall settles. Its displayed
  // stiffness is that of this hand and contact, and no bound for other hands.
  Boundary limits;
  // Nullopt if the softest wall of the scan does not settle.
  [[nodiscard]] std::optional<Summary> stiffest() const {
    const double settled = limits.settled.first.value_or(0.0);
    const double failed = limits.failed.first.value_or(std::numeric_limits<double>::infinity());
    return failed < settled ? std::nullopt : limits.at_settled;
  }

  // ---- of the unchanged scene ----
  Summary summary;
  // See FirstContact.
  std::optional<double> approach_speed_m_per_s;
  std::optional<double> rate_hardness_n_per_m;
  RiseKind rise_kind = RiseKind::kMean;  // valid with a rate-hardness
  // Time from the first tick with 10 % of the tail's mean force to the first with 90 %, in whole
  // ticks; may be 0. nullopt unless the scene settles with a positive force. It includes the
  // slowness of the hand.
  std::optional<double> rise_time_s;
  // Peak of the true position at the ticks, into the first wall; nullopt if never reached.
  std::optional<double> peak_penetration_m;
  // Maximum over time of the energy that the hand extracted: max(0, -passivity_margin_j). 0 means
  // that this run was passive, not that the interface is.
  double energy_to_hand_j = 0.0;
};

struct ContactStudyOptions {
  int threads = 0;  // max; 0: as many as the processor runs at a time
  std::function<bool()> should_stop;
  // Called by any thread, never by two at once; monotonic.
  std::function<void(double fraction)> progress;
};

// A missing wall, or the first invalid scene of the scan. Runs none. Realtime-safe: no.
[[nodiscard]] std::optional<SceneProblem> validate(const ContactStudyPlan& plan);

// The rows of compared_algorithms(), with their labels as `summary.algorithm`; independent of the
// number of threads. Empty if `should_stop` returned true. Precondition: validate() returns
// nullopt. Realtime-safe: no.
[[nodiscard]] std::vector<ContactMetrics> study_contact(const ContactStudyPlan& plan,
                                                        const ContactStudyOptions& options = {});

}  // namespace hapticwall
