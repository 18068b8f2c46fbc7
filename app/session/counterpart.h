// The same hand at the same wall under another algorithm, computed tick by tick beside a session.
//
// A sample of the simulator holds the hand's intended position, whether a script or the pointer led
// it, so that the counterpart's hand is the session's (recorded_hand.h). Under the session's own
// algorithm, from tick 0 on, the counterpart has the session's bits.
#pragma once

#include <cstdint>
#include <memory>

#include "app/session/recorded_hand.h"
#include "core/run/stepped_axis.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::session {

class Counterpart {
 public:
  // A validated scene of one axis, at rest. `first`: the session's first sample. Ticks before it
  // are computed with a hand that moves evenly to its place.
  Counterpart(const Scene& scene, const Sample& first);

  // Computes the ticks up to that of a sample of the session. Between samples that are not
  // neighbours the hand moves evenly. Returns the counterpart's sample of the tick, or null when
  // the run has diverged. Precondition: the tick is larger than that of the call before.
  [[nodiscard]] const Sample* follow(const Sample& of_session);
  // Takes a scene that a session may change to, from the next tick on.
  void change(const Scene& scene) { axis_.change(scene); }

  [[nodiscard]] const Scene& scene() const { return axis_.scene(); }
  [[nodiscard]] std::uint64_t tick() const { return axis_.tick(); }

 private:
  SteppedAxis axis_;
  RecordedHand hand_;
  Sample last_;            // of the session
  bool computed_ = false;  // the tick of axis_
};

}  // namespace hapticwall::session
