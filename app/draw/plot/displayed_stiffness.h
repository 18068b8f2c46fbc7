// The stiffness that a wall displays: mean force over mean penetration, as a running quotient.
#pragma once

#include <cstddef>
#include <deque>

#include "core/sample.h"

namespace hapticwall::draw {

// Each value is of the ticks in contact within this time.
inline constexpr double kStiffnessWindowS = 0.1;

// The formula of Summary::displayed_stiffness_n_per_m over a shorter time. One sample's quotient
// would follow the encoder: at one count of penetration it changes by a factor.
class DisplayedStiffness {
 public:
  // The displayed stiffness in N/m, or kMasked while no penetration of the window has reached
  // `count_m`, a count of the encoder in m (0: no encoder). Precondition: times grow.
  double push(const Sample& sample, double count_m);

 private:
  struct Contact {
    double time_s = 0.0;
    double force_n = 0.0;
    double penetration_m = 0.0;
    bool deep = false;  // a count or more
  };
  void drop_front();

  std::deque<Contact> contacts_;  // ticks in contact within the window
  double force_n_ = 0.0;          // sums over them
  double penetration_m_ = 0.0;
  std::size_t deep_ = 0;
};

}  // namespace hapticwall::draw
