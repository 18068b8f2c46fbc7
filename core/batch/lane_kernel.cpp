// The lanes tick by tick, for every instruction set: the loop of their algorithm moves them, then a
// loop of this file accounts the motion.
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

#include "core/batch/lane_account-inl.h"
#include "core/batch/lane_vector-inl.h"
#include "core/stabiliser/algorithm_list.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

using AccountLoop = void (*)(LaneBlock& block, std::uint64_t begin, std::uint64_t end);

template <bool kEncoder, bool kMoving, bool kTail>
void account(LaneBlock& block, std::uint64_t begin, std::uint64_t end) {
  for (std::size_t i = 0; i < kVectors; ++i) {
    Account<kEncoder, kMoving, kTail> vector(block, i * hn::Lanes(kTag));
    for (std::uint64_t tick = begin; tick < end; ++tick) vector.add(tick, tick - begin);
    vector.store_to(block.state);
  }
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

std::uint64_t run_chosen(LaneBlock& block, const LaneParts& parts, MoveLoop move,
                         std::uint64_t begin, std::uint64_t end) {
  const AccountLoop account_loop = choose_account(parts);
  while (begin < end) {
    const std::uint64_t wanted = std::min(end, begin + kTraceTicks);
    const std::uint64_t reached = move(block, begin, wanted);
    account_loop(block, begin, reached);
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

// Each is in the object file of its algorithm.
#define HAPTICWALL_DECLARE(Law) MoveLoop Law##MoveLoop(const LaneParts& parts);
HAPTICWALL_EACH_ALGORITHM(HAPTICWALL_DECLARE)
#undef HAPTICWALL_DECLARE

std::uint64_t run_lanes(LaneBlock& block, const LaneParts& parts, std::uint64_t begin,
                        std::uint64_t end) {
#define HAPTICWALL_ADDRESS(Law) Law##MoveLoop,
  static constexpr std::array kMoveLoops{HAPTICWALL_EACH_ALGORITHM(HAPTICWALL_ADDRESS)};
#undef HAPTICWALL_ADDRESS
  return HWY_DYNAMIC_DISPATCH(run_chosen)(block, parts, kMoveLoops[parts.algorithm](parts), begin,
                                          end);
}

}  // namespace hapticwall::batch

#endif  // HWY_ONCE
