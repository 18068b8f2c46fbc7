#include "core/plant/exact_plant.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/plant/linear_body.h"
#include "core/plant/taylor_polynomial.h"

namespace hapticwall {

template <typename Body, bool kFriction>
void ExactPlant<Body, kFriction>::advance(Real force_n) {
  if (this->gave_up()) return;
  pieces_ = 0;
  motion_.path = path_.straight();
  if (path_.bends_within_tick()) {
    do {
      advance_piece(force_n, path_.piece_fraction() * period_s_, 0);
    } while (path_.next_piece());
  } else if (!try_straight_tick(motion_, force_n)) {
    advance_piece(force_n, period_s_, 1);
  }
  path_.next_tick();
}

template <typename Body, bool kFriction>
void ExactPlant<Body, kFriction>::advance_for(Real force_n, double periods) {
  if (this->gave_up()) return;
  pieces_ = 0;
  this->pass_pieces(periods, [&](double fraction) {
    motion_.path = path_.straight();
    advance_piece(force_n, fraction * period_s_, 0);
  });
}

template <typename Body, bool kFriction>
void ExactPlant<Body, kFriction>::advance_piece(Real force_n, Real duration_s, int first_level) {
  // Small displacements must not drown in a large position: the origin moves to the handle.
  const Real origin_m = motion_.body.position_m;
  Body::move_origin(motion_.body, origin_m);
  const Real begin_m = path_.position_m() - origin_m;
  Drive now{begin_m, path_.velocity_m_per_s()};
  Real done_s = 0;
  int events_at_one_instant = 0;
  int stalls = 0;
  stop_if_spent();
  while (done_s < duration_s) {
    if (++pieces_ > Base::kMaxPieces) {
      motion_.body.position_m = std::numeric_limits<Real>::quiet_NaN();
      return;
    }
    const Real rest_s = duration_s - done_s;
    Real step_s = try_levels(first_level, force_n, now, rest_s);
    if (step_s == 0 && events_at_one_instant > kMaxEventsAtOneInstant) {
      step_s = rest_for_a_while(force_n, now, rest_s, stalls++);
      events_at_one_instant = 0;
    }
    if (step_s == 0) {
      step_s = std::min(body_.level(body_.deepest_level()).duration_s, rest_s);
      if (done_s + step_s <= done_s) break;  // the rest is below the last digit
      step_s *= advance_by_taylor(force_n, now, step_s);
      // A stretch shorter than the last digit of the time makes no progress either.
      events_at_one_instant = done_s + step_s > done_s ? 0 : events_at_one_instant + 1;
    }
    done_s += step_s;
    now.position_m = begin_m + path_.velocity_m_per_s() * done_s;
  }
  Body::move_origin(motion_.body, -origin_m);
}

// Takes the longest level from `first_level` on that fits without an event; returns its duration,
// or 0 for none.
template <typename Body, bool kFriction>
auto ExactPlant<Body, kFriction>::try_levels(int first_level, Real force_n, const Drive& now,
                                             Real rest_s) -> Real {
  for (int level = first_level; level <= body_.deepest_level(); ++level) {
    const Real step_s = body_.level(level).duration_s;
    if (step_s > rest_s || !surely_quiet(level, force_n, now)) continue;
    if (kFriction && motion_.direction == 0) {
      body_.advance_sticking(body_.level(level), motion_.body, force_n, now);
    } else {
      account(motion_, force_n,
              body_.advance_by(body_.level(level), motion_.body, load(motion_, force_n), now));
      stop_if_spent();
    }
    return step_s;
  }
  return 0;
}

// If rounding makes stop and breakaway alternate at one instant, the handle rests for the shortest
// step, and for twice as long after each repetition in the same stretch. Returns the time of rest;
// 0 if even the shortest step is too long.
template <typename Body, bool kFriction>
auto ExactPlant<Body, kFriction>::rest_for_a_while(Real force_n, const Drive& now, Real rest_s,
                                                   int stalls) -> Real {
  for (int level = std::max(0, body_.deepest_level() - stalls); level <= body_.deepest_level();
       ++level) {
    const Real step_s = body_.level(level).duration_s;
    if (step_s > rest_s) continue;
    if (motion_.direction != 0) stop();
    body_.advance_sticking(body_.level(level), motion_.body, force_n, now);
    return step_s;
  }
  return 0;
}

// Stops a handle whose velocity consists of rounding errors only.
template <typename Body, bool kFriction>
void ExactPlant<Body, kFriction>::stop_if_spent() {
  if constexpr (kFriction) {
    if (motion_.direction * motion_.body.velocity_m_per_s > 0 || motion_.direction == 0) return;
    stop();
  }
}
template <typename Body, bool kFriction>
void ExactPlant<Body, kFriction>::stop() {
  motion_.body.velocity_m_per_s = 0;
  motion_.direction = 0;
  ++friction_events_;
}

template <typename Body, bool kFriction>
bool ExactPlant<Body, kFriction>::surely_quiet(int level, Real force_n, const Drive& now) const {
  if constexpr (!kFriction) return true;
  if (motion_.direction == 0) {
    return body_.surely_sticks(body_.level(level), motion_.body, force_n, now,
                               friction_n_ + rounding_n(motion_.body, force_n, now));
  }
  return body_.surely_slides(body_.level(level), motion_.body, load(motion_, force_n), now,
                             motion_.direction);
}

// Moves to the end of the step or to the next event; returns the covered fraction of the step.
template <typename Body, bool kFriction>
auto ExactPlant<Body, kFriction>::advance_by_taylor(Real force_n, const Drive& now, Real step_s)
    -> Real {
  if constexpr (!kFriction) {
    const auto slide = body_.slide(motion_.body, load(motion_, force_n), now, step_s, 0);
    account(motion_, force_n, body_.advance(motion_.body, slide, 1));
    return 1;
  }
  return motion_.direction == 0 ? advance_sticking(force_n, now, step_s)
                                : advance_sliding(force_n, now, step_s);
}

template <typename Body, bool kFriction>
auto ExactPlant<Body, kFriction>::advance_sliding(Real force_n, const Drive& now, Real step_s)
    -> Real {
  // After a breakaway the net force equals the friction up to rounding and must not pull back.
  const Real push = motion_.body.velocity_m_per_s == 0 ? motion_.direction : 0;
  const auto slide = body_.slide(motion_.body, load(motion_, force_n), now, step_s, push);
  const auto stopped = first_crossing(slide.velocity, motion_.direction);
  account(motion_, force_n, body_.advance(motion_.body, slide, stopped.value_or(1)));
  if (!stopped) return 1;
  stop();
  return *stopped;
}

template <typename Body, bool kFriction>
auto ExactPlant<Body, kFriction>::advance_sticking(Real force_n, const Drive& now, Real step_s)
    -> Real {
  const Real rounding = rounding_n(motion_.body, force_n, now);
  const Real net_n = body_.net_force_at_rest_n(motion_.body, force_n, now);
  if (friction_n_ - std::abs(net_n) < -rounding) {
    break_loose(net_n > 0 ? 1 : -1);
    return 0;
  }
  const auto stick = body_.stick(motion_.body, force_n, now, step_s);
  TaylorPolynomial<Real> net = stick.hand_force;
  net.coefficient[0] -= force_n;
  if constexpr (Body::kHasLag) {
    for (std::size_t j = 0; j < net.coefficient.size(); ++j) {
      net.coefficient[j] -= stick.excess.coefficient[j];
    }
  }
  Real theta = 1;
  Real direction = 0;
  for (const Real side : {Real(1), Real(-1)}) {
    TaylorPolynomial<Real> reserve = net;  // f_c - side * F_net
    for (Real& c : reserve.coefficient) c *= -side;
    reserve.coefficient[0] += friction_n_;
    const auto loose = first_crossing(reserve, Real(1));
    if (loose && (*loose < theta || direction == 0)) {
      theta = *loose;
      direction = side;
    }
  }
  Body::settle(motion_.body, stick, theta);
  if (direction != 0) break_loose(direction);
  return theta;
}

template <typename Body, bool kFriction>
void ExactPlant<Body, kFriction>::break_loose(Real direction) {
  motion_.direction = direction;
  ++friction_events_;
}

template class ExactPlant<LinearBody<double, false, false>, false>;
template class ExactPlant<LinearBody<double, false, false>, true>;
template class ExactPlant<LinearBody<double, false, true>, false>;
template class ExactPlant<LinearBody<double, false, true>, true>;
template class ExactPlant<LinearBody<double, true, false>, false>;
template class ExactPlant<LinearBody<double, true, false>, true>;
template class ExactPlant<LinearBody<double, true, true>, false>;
template class ExactPlant<LinearBody<double, true, true>, true>;
template class ExactPlant<LinearBody<long double, false, false>, false>;
template class ExactPlant<LinearBody<long double, false, false>, true>;
template class ExactPlant<LinearBody<long double, false, true>, false>;
template class ExactPlant<LinearBody<long double, false, true>, true>;
template class ExactPlant<LinearBody<long double, true, false>, false>;
template class ExactPlant<LinearBody<long double, true, false>, true>;
template class ExactPlant<LinearBody<long double, true, true>, false>;
template class ExactPlant<LinearBody<long double, true, true>, true>;

}  // namespace hapticwall
