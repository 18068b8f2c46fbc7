// The loops of the lanes, for every instruction set and every choice of parts.
#include "core/batch/lane_block.h"
#include "core/batch/lane_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/batch/lane_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/batch/lane_account-inl.h"
#include "core/batch/lane_energy_laws-inl.h"
#include "core/batch/lane_laws-inl.h"
#include "core/batch/lane_motion-inl.h"
#include "core/batch/lane_vector-inl.h"
#include "core/plant/moving_plant.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

// The motion is one chain of operations that wait for each other: so many vectors side by side fill
// the time.
constexpr std::size_t kVectors = 4;
static_assert(hn::MaxLanes(kTag) * kVectors <= kMostLanes);

// Ticks [begin, end), at most kTraceTicks where they are accounted for. Returns the tick that was
// reached.
using MoveLoop = std::uint64_t (*)(LaneBlock& block, std::uint64_t begin, std::uint64_t end);
using AccountLoop = void (*)(LaneBlock& block, std::uint64_t begin, std::uint64_t end);

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

template <typename P>
std::uint64_t move(LaneBlock& block, std::uint64_t begin, std::uint64_t end) {
  return move_vectors<P>(block, begin, end, std::make_index_sequence<kVectors>());
}

template <bool kEncoder, bool kMoving, bool kTail>
void account(LaneBlock& block, std::uint64_t begin, std::uint64_t end) {
  for (std::size_t i = 0; i < kVectors; ++i) {
    Account<kEncoder, kMoving, kTail> vector(block, i * hn::Lanes(kTag));
    for (std::uint64_t tick = begin; tick < end; ++tick) vector.add(tick, tick - begin);
    vector.store_to(block.state);
  }
}

template <typename Law, Keep kKeep, bool... kChosen>
MoveLoop choose_move(const LaneParts& parts) {
  const std::array wanted{parts.encoder, parts.damped, parts.moving};
  if constexpr (sizeof...(kChosen) == wanted.size()) {
    return move<MotionParts<Law, kKeep, kChosen...>>;
  } else {
    return wanted[sizeof...(kChosen)] ? choose_move<Law, kKeep, kChosen..., true>(parts)
                                      : choose_move<Law, kKeep, kChosen..., false>(parts);
  }
}

template <typename Law>
MoveLoop choose_keep(const LaneParts& parts) {
  if (parts.account) return choose_move<Law, Keep::kTrace>(parts);
  return parts.tail ? choose_move<Law, Keep::kReachOfTail>(parts)
                    : choose_move<Law, Keep::kReach>(parts);
}

template <bool... kChosen>
AccountLoop choose_account(const LaneParts& parts) {
  const std::array wanted{parts.encoder, parts.moving, parts.tail};
  if constexpr (sizeof...(kChosen) == wanted.size()) {
    return account<kChosen...>;
  } else {
    return wanted[sizeof...(kChosen)] ? choose_account<kChosen..., true>(parts)
                                      : choose_account<kChosen..., false>(parts);
  }
}

MoveLoop choose_law(const LaneParts& parts) {
  switch (parts.law) {
    case LaneLaw::kNone:
      return choose_keep<NoLaw>(parts);
    case LaneLaw::kVirtualCoupling:
      return choose_keep<VirtualCouplingLaw>(parts);
    case LaneLaw::kPassivityControl:
      return choose_keep<PassivityControlLaw>(parts);
    case LaneLaw::kEnergyBounding:
      return choose_keep<EnergyBoundingLaw>(parts);
    case LaneLaw::kEnergyBounding2010:
      return choose_keep<EnergyBounding2010Law>(parts);
    case LaneLaw::kForceBounding:
      return choose_keep<ForceBoundingLaw>(parts);
    case LaneLaw::kHalfSample:
      return choose_keep<HalfSampleLaw>(parts);
    case LaneLaw::kEnergyBookkeeping:
      break;
  }
  return choose_keep<EnergyBookkeepingLaw>(parts);
}

std::uint64_t run_chosen(LaneBlock& block, const LaneParts& parts, std::uint64_t begin,
                         std::uint64_t end) {
  const MoveLoop move_loop = choose_law(parts);
  const AccountLoop account_loop = parts.account ? choose_account(parts) : nullptr;
  while (begin < end) {
    const std::uint64_t wanted = parts.account ? std::min(end, begin + kTraceTicks) : end;
    const std::uint64_t reached = move_loop(block, begin, wanted);
    if (account_loop != nullptr) account_loop(block, begin, reached);
    if (reached < wanted) return reached;
    begin = reached;
  }
  return end;
}

std::size_t count_chosen() { return hn::Lanes(kTag) * kVectors; }

}  // namespace hapticwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hapticwall::batch {

HWY_EXPORT(run_chosen);
HWY_EXPORT(count_chosen);

std::size_t lane_count() { return HWY_DYNAMIC_DISPATCH(count_chosen)(); }

std::uint64_t run_lanes(LaneBlock& block, const LaneParts& parts, std::uint64_t begin,
                        std::uint64_t end) {
  return HWY_DYNAMIC_DISPATCH(run_chosen)(block, parts, begin, end);
}

}  // namespace hapticwall::batch

#endif  // HWY_ONCE
