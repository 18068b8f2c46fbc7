// An algorithm and its follower: `[algorithm] then = "passivity-control"`.
#pragma once

#include "core/algorithm/algorithm.h"

namespace hapticwall {

// F_1 = the algorithm's force; the passivity controller takes it for the wall's:
//
//   W = E(k-1) + F_1 Δx_k (or F_d(k-1) Δx_k: `observer`);  F_d = F_1 + α v_k where W is too low.
//
// Both algorithms get the force really commanded as F_d(k-1). With the same-sample observer and
// without cap and floor, the whole control law is then passive (Eq. 6 never below zero), whatever
// the algorithm does. An algorithm's bound on the change of force in a tick does not hold any more,
// because α v is added. Source: derived. Realtime-safe: as ActiveAlgorithm.
class FollowedAlgorithm {
 public:
  // ActiveAlgorithm::configure() for the algorithm and its follower. The follower also starts anew
  // when it is put behind an algorithm.
  void configure(const AlgorithmSettings& settings, const AlgorithmContext& context) {
    const bool followed = has_follower(settings) && !first_.borrows();
    const bool same = settings.index == algorithm_ && followed == followed_;
    algorithm_ = settings.index;
    followed_ = followed;
    first_.configure(algorithm_, context);
    follower_.configure(follower_index(), context);
    if (!same) follower_.reset();
  }
  // ActiveAlgorithm::borrow(). Nothing follows a borrowed algorithm.
  void borrow(const BorrowedAlgorithm& borrowed) {
    first_.borrow(borrowed);
    followed_ = false;
  }
  void reset() {
    first_.reset();
    follower_.reset();
  }

  // F_d(k), newtons: the follower's, if there is one.
  [[nodiscard]] double step(const AlgorithmInput& input) {
    if (!followed_) return first_.step(input);
    AlgorithmInput of_follower = input;
    of_follower.wall_force_n = first_.step(input);
    return follower_.step(of_follower);
  }
  // The signals of both in the last step(), and no others; the follower's replace those of the same
  // name.
  void show(Signals& signals) const {
    signals = no_signals();
    first_.show(signals);
    if (followed_) follower_.show(signals);
  }

 private:
  std::size_t algorithm_ = 0;
  bool followed_ = false;
  ActiveAlgorithm first_;
  ActiveAlgorithm follower_;
};

}  // namespace hapticwall
