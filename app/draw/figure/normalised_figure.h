// The normalised stability chart as a picture.
#pragma once

#include "app/draw/figure/figure.h"
#include "app/file/picture.h"
#include "core/result.h"
#include "core/study/normalised_chart.h"

namespace hapticwall::draw {

inline constexpr FigureSize kNormalisedSize{1600, 1000};

// For each delay the limit of stability, the rule as a thin line, and a mark for each simulated
// boundary. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_normalised(const NormalisedChart& chart,
                                                    FigureSize size = kNormalisedSize);

}  // namespace hapticwall::draw
