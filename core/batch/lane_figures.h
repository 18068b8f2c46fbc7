// The figures of a lane whose scene has ended.
#pragma once

#include "core/batch/batch_simulator.h"
#include "core/batch/lane_group.h"

namespace hapticwall::batch {

// The lanes must have run with their energies where Figures is Summary.
template <typename Figures>
[[nodiscard]] Figures lane_figures(const Scene& scene, const LaneEnd& end, const LaneBlock& block);
template <>
[[nodiscard]] Summary lane_figures(const Scene& scene, const LaneEnd& end, const LaneBlock& block);
template <>
[[nodiscard]] BatchVerdict lane_figures(const Scene& scene, const LaneEnd& end,
                                        const LaneBlock& block);

}  // namespace hapticwall::batch
