// A force of the program itself in the place of an algorithm's: an experiment on the device.
#pragma once

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// The servo step makes its force finite and clamps it, as that of any algorithm.
class TickLaw {
 public:
  TickLaw() = default;
  TickLaw(const TickLaw&) = delete;
  TickLaw& operator=(const TickLaw&) = delete;
  virtual ~TickLaw() = default;

  // The force of this tick, newtons. Called once a tick. Realtime-safe: yes.
  [[nodiscard]] virtual double step(const StabiliserInput& input) = 0;
};

}  // namespace hapticwall
