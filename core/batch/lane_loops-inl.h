// The loops that move the lanes under the law HAPTICWALL_LAW.
// Compiled once per instruction set.
#if defined(HAPTICWALL_LANE_LOOPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HAPTICWALL_LANE_LOOPS_INL_H_
#undef HAPTICWALL_LANE_LOOPS_INL_H_
#else
#define HAPTICWALL_LANE_LOOPS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/batch/lane_block.h"
#include "core/batch/lane_law-inl.h"
#include "core/batch/lane_motion-inl.h"
#include "core/batch/lane_vector-inl.h"
#include "core/plant/moving_plant.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

template <typename P, std::size_t... kIndex>
HWY_INLINE std::uint64_t move_vectors(LaneBlock& block, std::uint64_t begin, std::uint64_t end,
                                      std::index_sequence<kIndex...> /*vectors*/) {
  Motion<P> vectors[] = {Motion<P>(block, kIndex * hn::Lanes(kTag))...};
  const Vector limit_m = constant(kDivergedPositionM);
  std::uint64_t tick = begin;
  for (; tick < end; ++tick) {
    Flags within = vectors[0].within(limit_m);
    ((within = hn::And(within, vectors[kIndex].within(limit_m))), ...);
    if (!hn::AllTrue(kTag, within)) break;
    (vectors[kIndex].pass(tick, tick - begin, block.trace), ...);
  }
  (vectors[kIndex].store_to(block, tick - begin), ...);
  return tick;
}

// Everything is inlined, the law's functions too.
template <typename P>
HWY_FLATTEN std::uint64_t move(LaneBlock& block, std::uint64_t begin, std::uint64_t end) {
  return move_vectors<P>(block, begin, end, std::make_index_sequence<kVectors>());
}

// Walls with dampers are rare: their loop also knows moving paths.
template <typename Law, bool kEncoder>
MoveLoop choose_parts(const LaneParts& parts) {
  if (parts.damped) return move<MotionParts<Law, kEncoder, true, true>>;
  return parts.moving ? move<MotionParts<Law, kEncoder, false, true>>
                      : move<MotionParts<Law, kEncoder, false, false>>;
}

// Static, because every law has its own.
static MoveLoop choose_move(const LaneParts& parts) {
  return parts.encoder ? choose_parts<HAPTICWALL_LAW, true>(parts)
                       : choose_parts<HAPTICWALL_LAW, false>(parts);
}

}  // namespace hapticwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HAPTICWALL_LANE_LOOPS_INL_H_
