#include "app/draw/plot/displayed_stiffness.h"

#include "app/draw/plot/sample_pyramid.h"

namespace hapticwall::draw {

void DisplayedStiffness::drop_front() {
  const Contact& oldest = contacts_.front();
  force_n_ -= oldest.force_n;
  penetration_m_ -= oldest.penetration_m;
  deep_ -= oldest.deep ? 1 : 0;
  contacts_.pop_front();
  if (contacts_.empty()) force_n_ = penetration_m_ = 0.0;  // drops the rounding errors, too
}

double DisplayedStiffness::push(const Sample& sample, double count_m) {
  constexpr double kRounding = 1e-6;  // relative, of times and of counts
  while (!contacts_.empty() &&
         sample.time_s - contacts_.front().time_s > (1.0 - kRounding) * kStiffnessWindowS)
    drop_front();
  if (sample.penetration_m > 0.0) {
    const bool deep = sample.penetration_m >= (1.0 - kRounding) * count_m;
    contacts_.push_back({sample.time_s, sample.force_n, sample.penetration_m, deep});
    force_n_ += sample.force_n;
    penetration_m_ += sample.penetration_m;
    deep_ += deep ? 1 : 0;
  }
  return deep_ > 0 ? force_n_ / penetration_m_ : kMasked;
}

}  // namespace hapticwall::draw
