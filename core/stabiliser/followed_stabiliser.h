// An algorithm followed by a passivity controller: `[algorithm] then = "passivity-control"`.
#pragma once

#include <cstddef>

#include "core/stabiliser/passivity_control.h"
#include "core/stabiliser/stabiliser_list.h"

namespace hapticwall {

// F_1 = the algorithm's force; the passivity controller takes it for the wall's:
//
//   W = E(k-1) + F_1 Δx_k (or F_d(k-1) Δx_k: `observer`);  F_d = F_1 + α v_k where W is too low.
//
// Both see the force that was really commanded as F_d(k-1). With the same-sample observer, without
// cap and floor, the control law as a whole is passive then (Eq. 6 never below zero), whatever the
// algorithm does; a promise of the algorithm about the change of its force in a tick does not
// survive, for α v comes on top of it. Source: derived. A view: the states are the servo's, and it
// is copied freely. Realtime-safe: yes.
class FollowedStabiliser {
 public:
  FollowedStabiliser(StabiliserBank& bank, std::size_t index, PassivityControl& follower)
      : bank_(&bank), index_(index), follower_(&follower) {}

  [[nodiscard]] double step(StabiliserInput input) {
    input.wall_force_n =
        bank_->visit(index_, [&](auto& stabiliser) { return stabiliser.step(input); });
    return follower_->step(input);
  }

 private:
  StabiliserBank* bank_;
  std::size_t index_;
  PassivityControl* follower_;
};

}  // namespace hapticwall
