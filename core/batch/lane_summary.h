// The summary of a lane whose scene has ended.
#pragma once

#include "core/batch/lane_group.h"
#include "core/summary.h"

namespace hapticwall::batch {

[[nodiscard]] Summary lane_summary(const Scene& scene, const LaneEnd& end, const LaneBlock& block);

}  // namespace hapticwall::batch
