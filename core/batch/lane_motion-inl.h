// The motion of one vector of lanes: core/loop/servo_step.h and core/plant/one_body.h with the same
// operations in the same order, so that every lane has the bits of simulate()
// (tests/property/batch_lanes_test.cpp). No fused multiply-add: it rounds differently. Compiled
// once per instruction set.
#if defined(HAPTICWALL_LANE_MOTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HAPTICWALL_LANE_MOTION_INL_H_
#undef HAPTICWALL_LANE_MOTION_INL_H_
#else
#define HAPTICWALL_LANE_MOTION_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "core/batch/lane_block.h"
#include "core/batch/lane_law-inl.h"
#include "core/batch/lane_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

// The parts of the motion (LaneParts) as a type.
template <typename LawType, bool kEncoderPart, bool kDampedPart, bool kMovingPart>
struct MotionParts {
  using Law = LawType;
  static constexpr bool kEncoder = kEncoderPart;
  static constexpr bool kDamped = kDampedPart;
  static constexpr bool kMoving = kMovingPart;
};

template <typename P>
class Motion {
 public:
  HWY_INLINE Motion(const LaneBlock& block, std::size_t first_lane)
      : parameters_(block.parameters), at_(first_lane) {
    const LaneMotion& m = block.state.motion;
    position_m_ = load(m.position_m, at_);
    velocity_ = load(m.velocity_m_per_s, at_);
    measured_m_ = load(m.measured_m, at_);
    force_n_ = load(m.force_n, at_);
    saturated_ticks_ = load(m.saturated_ticks, at_);
    law_state_ = load_struct<P::Law::template State>(m.law, at_);
  }

  HWY_INLINE void store_to(LaneBlock& block, std::size_t ticks) const {
    LaneMotion& m = block.state.motion;
    store(position_m_, m.position_m, at_);
    store(velocity_, m.velocity_m_per_s, at_);
    store(measured_m_, m.measured_m, at_);
    store(force_n_, m.force_n, at_);
    store(saturated_ticks_, m.saturated_ticks, at_);
    store_struct<P::Law::template State>(law_state_, m.law, at_);
    store(velocity_, block.trace.velocity_m_per_s[ticks], at_);
  }

  [[nodiscard]] HWY_INLINE Flags within(Vector limit_m) const {
    return hn::Le(hn::Abs(position_m_), limit_m);
  }

  // `row`: the tick's in the trace.
  HWY_INLINE void pass(std::uint64_t tick, std::size_t row, LaneTrace& trace) {
    store(position_m_, trace.position_m[row], at_);
    store(velocity_, trace.velocity_m_per_s[row], at_);
    servo_step();
    store(force_n_, trace.force_n[row], at_);
    if constexpr (P::kEncoder) store(measured_m_, trace.measured_m[row], at_);
    move(tick, row, trace);
  }

 private:
  [[nodiscard]] HWY_INLINE Vector parameter(const LaneNumbers& numbers) const {
    return load(numbers, at_);
  }

  // core/encoder.h, for |position| ≤ 1 m.
  [[nodiscard]] HWY_INLINE Vector measure() const {
    if constexpr (!P::kEncoder) return position_m_;
    const Vector shift = constant(6755399441055744.0);  // 1.5 * 2^52
    const Vector resolution_m = parameter(parameters_.encoder_m);
    return resolution_m * ((position_m_ / resolution_m + shift) - shift);
  }

  // core/loop/servo_step.h, core/wall.h.
  HWY_INLINE void servo_step() {
    const Vector measured_m = measure();
    const Vector displacement_m = measured_m - measured_m_;
    const Vector velocity = displacement_m * parameter(parameters_.rate_hz);
    const Walls walls{{parameter(parameters_.wall_m), parameter(parameters_.wall_stiffness_n_per_m),
                       parameter(parameters_.wall_damping_n_s_per_m)}};
    const Vector penetration_m = measured_m - walls.wall.position_m;
    const Flags in_contact = greater(penetration_m, hn::Zero(kTag));
    const Vector wall_force_n =
        P::kDamped ? wall_force(walls, measured_m, velocity)
                   : or_zero(in_contact, walls.wall.stiffness_n_per_m * penetration_m);
    force_n_ = limited(P::Law::step(
        load_struct<P::Law::template Parameters>(parameters_.law, at_), law_state_, walls,
        {wall_force_n, measured_m, displacement_m, velocity, penetration_m, force_n_, in_contact}));
    measured_m_ = measured_m;
  }

  [[nodiscard]] HWY_INLINE Vector limited(Vector wanted_n) {
    const Vector limit_n = parameter(parameters_.force_limit_n);
    const Vector size_n = P::Law::kOnlyPushes ? wanted_n : hn::Abs(wanted_n);
    saturated_ticks_ = saturated_ticks_ + one_where(hn::Gt(size_n, limit_n));
    const Vector limited_n = hn::Min(limit_n, size_n);
    return P::Law::kOnlyPushes ? limited_n : hn::CopySign(limited_n, wanted_n);
  }

  // core/plant/one_body.h, advance_by().
  HWY_INLINE void move(std::uint64_t tick, std::size_t row, LaneTrace& trace) {
    const Vector stretch_m = path_position<P::kMoving>(parameters_, at_, tick) - position_m_;
    const Vector s = parameter(parameters_.path_speed_m_per_s);
    const Vector u = P::kMoving ? velocity_ - s : velocity_;
    // b_h (s - v) and -(b_h u) have the same bits.
    const Vector hand_n = parameter(parameters_.hand_stiffness_n_per_m) * stretch_m -
                          parameter(parameters_.hand_damping_n_s_per_m) * u;
    const Vector f = (hand_n - parameter(parameters_.damping_n_s_per_m) * velocity_) - force_n_;
    Vector displacement_m = dot(parameters_.integral_at_rest, at_, velocity_, f);
    if constexpr (P::kMoving) {
      const Vector moved_m =
          velocity_ * parameter(parameters_.duration_s) + dot(parameters_.drift, at_, u, f);
      displacement_m = hn::IfThenElse(hn::Eq(s, hn::Zero(kTag)), displacement_m, moved_m);
    }
    store(f, trace.net_force_n[row], at_);
    store(displacement_m, trace.displacement_m[row], at_);
    position_m_ = position_m_ + displacement_m;
    velocity_ = velocity_ + dot(parameters_.velocity, at_, u, f);
  }

  const LaneParameters& parameters_;
  std::size_t at_;  // first lane of the vector
  typename P::Law::template State<Vector> law_state_;
  Vector position_m_, velocity_, measured_m_, force_n_;
  Vector saturated_ticks_;
};

}  // namespace hapticwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HAPTICWALL_LANE_MOTION_INL_H_
