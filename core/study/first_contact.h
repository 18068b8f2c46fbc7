// The first touch of a wall, as a hand would judge its hardness by it.
#pragma once

#include <cstdint>
#include <optional>

#include "core/sample.h"

namespace hapticwall {

// No later than this after the first tick in contact is a rise of the force "initial". Our choice:
// long enough for a count or two of an encoder, short beside what a hand does.
inline constexpr double kInitialRiseS = 0.01;

// Fed with every sample of a run, in order; of a simulator, because it needs the true velocity.
//
// The first contact begins at tick k0, the first in contact after one that was not. Its rise ends
// before the command first falls, at the first tick at the force limit, and before the handle is
// out again.
//
// Rate-hardness, N/s per m/s = N/m: "initial rate of change of force versus initial velocity upon
// penetrating the surface" (Lawrence, Pao, Dougherty & Salada, "Rate-hardness: a new performance
// metric for haptic interfaces", IEEE Trans. Robotics and Automation 16(4), 2000; cited from
// memory). Of the sampled force F_d this is taken to be
//
//   max over k of (F_d(k) - F_d(k0)) / ((k - k0) T v_a)
//
// over the ticks k > k0 of the rise within kInitialRiseS; where none of these has more force than
// k0, over the first later one that has. v_a is the approach speed: the true velocity at k0, before
// the wall has pushed. Why so:
//  * from k0, not from the tick before: where between the two the wall was met is chance, as is
//    where an encoder's first count lies in it;
//  * the steepest mean and not the steepest tick: one count of an encoder is a jump of K Delta, and
//    over one tick it says nothing of the wall;
//  * the steepest and not the last: a contact that ends within milliseconds flattens at once.
// A spring wall at constant speed gives exactly its stiffness; with an encoder up to one tick in
// the number of ticks that a count takes more. Two rises have no such mean, and
// FirstContact::kind() tells:
//  * the command rises no further after k0 (a touch of one count, or the limit at once): it is the
//    jump at k0 over one tick, which says where the wall lies between two counts rather than what
//    it is;
//  * it rises to the force limit: what the limit has cut off is unknown, and a jump that nearly
//    reached it would leave next to nothing; so the mean from the last free tick on counts too.
enum class RiseKind : std::uint8_t { kMean, kOneTick, kToTheLimit };

class FirstContact {
 public:
  explicit FirstContact(double period_s) : period_s_(period_s) {}

  // Realtime-safe: yes.
  void add(const Sample& sample);

  // v_a, m/s; nothing where there was no entry (never touched, or in the wall from the beginning).
  [[nodiscard]] std::optional<double> approach_speed_m_per_s() const;
  // N/m, may be 0; nothing without an entry, or where the handle did not move inwards at it.
  [[nodiscard]] std::optional<double> rate_hardness_n_per_m() const;
  // Of the rise that rate_hardness_n_per_m() is of.
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
