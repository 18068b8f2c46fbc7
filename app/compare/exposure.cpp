#include "app/compare/exposure.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::compare {
namespace {

bool in_contact(const Tick& tick) {
  return std::ranges::any_of(
      tick.in_use(), [](const Sample& sample) { return (sample.flags & kFlagInContact) != 0; });
}

double force_of(const Tick& tick) {
  return tick.count > 1 ? std::hypot(tick.axes[0].force_n, tick.axes[1].force_n)
                        : std::abs(tick.x().force_n);
}

// A positive force pushes against positive motion.
double work_on_hand(const Tick& from, const Tick& to) {
  double work_j = 0.0;
  for (std::size_t axis = 0; axis < from.count; ++axis)
    work_j -=
        from.axes.at(axis).force_n * (to.axes.at(axis).position_m - from.axes.at(axis).position_m);
  return work_j;
}

}  // namespace

void Exposure::add(const Tick& tick, double period_s) {
  if (!is_finite(tick)) return;
  period_s_ = period_s;
  const bool contact = in_contact(tick);
  const std::uint64_t number = tick.x().tick;
  const bool begins = !first_tick_;
  if (begins) first_tick_ = number;
  const bool follows = !begins && number == before_.x().tick + 1;
  if (!begins && number > before_.x().tick + 1) lost_ticks_ += number - before_.x().tick - 1;
  if (follows) energy_to_hand_j_ += work_on_hand(before_, tick);
  if (contact && (begins || !in_contact(before_))) ++touches_;
  if (contact) {
    ++contact_ticks_;
    force_sum_n_ += force_of(tick);
  }
  max_force_n_ = std::max(max_force_n_, force_of(tick));
  before_ = tick;
}

file::ExposureRow Exposure::row() const {
  file::ExposureRow row;
  row.contact_s = static_cast<double>(contact_ticks_) * period_s_;
  if (contact_ticks_ > 0) row.mean_force_n = force_sum_n_ / static_cast<double>(contact_ticks_);
  row.max_force_n = max_force_n_;
  row.energy_to_hand_j = energy_to_hand_j_;
  row.touches = touches_;
  row.lost_ticks = lost_ticks_;
  row.first_tick = first_tick_;
  if (first_tick_) row.last_tick = before_.x().tick;
  return row;
}

}  // namespace hapticwall::compare
