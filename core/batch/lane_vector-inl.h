// The vocabulary of the lanes' loops: vectors of doubles, one number per lane. Compiled once per
// instruction set.
#if defined(HAPTICWALL_LANE_VECTOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HAPTICWALL_LANE_VECTOR_INL_H_
#undef HAPTICWALL_LANE_VECTOR_INL_H_
#else
#define HAPTICWALL_LANE_VECTOR_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/batch/lane_block.h"
#include "core/stabiliser/law_numbers.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<double>;
using Vector = hn::Vec<Tag>;
using Flags = hn::Mask<Tag>;

inline constexpr Tag kTag;

// The motion is one chain of operations that wait for each other: this many vectors side by side
// fill the time.
inline constexpr std::size_t kVectors = 4;
static_assert(hn::MaxLanes(kTag) * kVectors <= kMaxLanes);

HWY_INLINE Vector constant(double value) { return hn::Set(kTag, value); }
HWY_INLINE Vector load(const LaneNumbers& numbers, std::size_t first_lane) {
  return hn::Load(kTag, numbers.lane.data() + first_lane);
}
HWY_INLINE void store(Vector value, LaneNumbers& numbers, std::size_t first_lane) {
  hn::Store(value, kTag, numbers.lane.data() + first_lane);
}
// A struct of vectors from and to consecutive LaneNumbers, in the order of its members. Rows: an
// array of LaneNumbers, or a struct of them.
template <template <class> class Struct, typename Rows, std::size_t... kIndex>
HWY_INLINE Struct<Vector> load_struct([[maybe_unused]] const Rows& rows,
                                      [[maybe_unused]] std::size_t first_lane,
                                      std::index_sequence<kIndex...> /*members*/) {
  [[maybe_unused]] const auto* const first = reinterpret_cast<const double*>(&rows) + first_lane;
  return {hn::Load(kTag, first + kIndex * kMaxLanes)...};
}
template <template <class> class Struct, typename Rows>
HWY_INLINE Struct<Vector> load_struct(const Rows& rows, std::size_t first_lane) {
  return load_struct<Struct>(rows, first_lane,
                             std::make_index_sequence<kLawNumbers<Struct<double>>>());
}
template <template <class> class Struct, typename Rows>
HWY_INLINE void store_struct(const Struct<Vector>& values, Rows& rows, std::size_t first_lane) {
  auto* const first = reinterpret_cast<double*>(&rows) + first_lane;
  for (std::size_t i = 0; i < kLawNumbers<Struct<double>>; ++i) {
    Vector value;
    std::memcpy(&value, reinterpret_cast<const char*>(&values) + i * sizeof value, sizeof value);
    hn::Store(value, kTag, first + i * kMaxLanes);
  }
}

// std::max(0.0, value).
HWY_INLINE Vector positive_part(Vector value) {
  return hn::IfThenElseZero(hn::Gt(value, hn::Zero(kTag)), value);
}

// std::max(a, b) and std::min(a, b): the first of two equal numbers, so that +0 and -0 are not
// exchanged. The instructions of x86 give their second operand.
HWY_INLINE Vector larger(Vector a, Vector b) {
  return HWY_ARCH_X86 ? hn::Max(b, a) : hn::IfThenElse(hn::Lt(a, b), b, a);
}
HWY_INLINE Vector smaller(Vector a, Vector b) {
  return HWY_ARCH_X86 ? hn::Min(b, a) : hn::IfThenElse(hn::Lt(b, a), b, a);
}
HWY_INLINE void keep_maximum(Vector& maximum, Vector value) { maximum = larger(maximum, value); }
HWY_INLINE void keep_minimum(Vector& minimum, Vector value) { minimum = smaller(minimum, value); }
HWY_INLINE Vector one_where(Flags flags) { return hn::IfThenElseZero(flags, constant(1.0)); }

// core/plant/linear_motion.h: dot() and quadratic() of the states (u, f).
HWY_INLINE Vector dot(const std::array<LaneNumbers, 2>& row, std::size_t first_lane, Vector u,
                      Vector f) {
  return load(row[0], first_lane) * u + load(row[1], first_lane) * f;
}
HWY_INLINE Vector quadratic(const std::array<LaneNumbers, 3>& form, std::size_t first_lane,
                            Vector u, Vector f) {
  return u * (load(form[0], first_lane) * u + load(form[1], first_lane) * f) +
         f * (load(form[2], first_lane) * f);
}

// core/plant/hand_path.h: the intended position at a tick; a resting path is at path_m.
template <bool kMoving>
HWY_INLINE Vector path_position(const LaneParameters& parameters, std::size_t first_lane,
                                std::uint64_t tick) {
  if constexpr (!kMoving) return load(parameters.path_m, first_lane);
  const Vector now = constant(static_cast<double>(static_cast<std::int64_t>(tick)));
  const Vector ticks = now - load(parameters.segment_begin_tick, first_lane);
  return load(parameters.segment_m, first_lane) +
         load(parameters.path_speed_m_per_s, first_lane) *
             (ticks * load(parameters.period_s, first_lane));
}

}  // namespace hapticwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HAPTICWALL_LANE_VECTOR_INL_H_
