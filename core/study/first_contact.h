// Rate-hardness of the first contact with a wall.
#pragma once

#include <cstdint>
#include <optional>

#include "core/sample.h"

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

}  // namespace hapticwall
