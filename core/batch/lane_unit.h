// The whole of an algorithm's lanes: the main file that includes this defines HAPTICWALL_LAW, the
// struct, and HAPTICWALL_LAW_FILE, its file, which it has included before (core/CMakeLists.txt).
#pragma once

#include "core/batch/lane_block.h"
#include "core/batch/lane_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/batch/lane_loops-inl.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/batch/lane_loops-inl.h"

namespace hapticwall::batch {

HWY_EXPORT(choose_move);

#define HAPTICWALL_MOVE_LOOP(Law) Law##MoveLoop
#define HAPTICWALL_MOVE_LOOP_OF(Law) HAPTICWALL_MOVE_LOOP(Law)
MoveLoop HAPTICWALL_MOVE_LOOP_OF(HAPTICWALL_LAW)(const LaneParts& parts);
MoveLoop HAPTICWALL_MOVE_LOOP_OF(HAPTICWALL_LAW)(const LaneParts& parts) {
  return HWY_DYNAMIC_DISPATCH(choose_move)(parts);
}

}  // namespace hapticwall::batch
