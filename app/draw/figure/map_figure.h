// A stability map as a picture: one field an algorithm, the bounds of theory drawn over it.
#pragma once

#include <span>

#include "app/draw/figure/paper.h"
#include "app/file/picture.h"
#include "core/result.h"
#include "core/study/stability_map.h"

namespace hapticwall::draw {

// `figures`: metrics of all cells of the map. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_map(const StabilityMap& map,
                                             std::span<const MapMetrics> figures,
                                             const Paper& paper = {});

}  // namespace hapticwall::draw
