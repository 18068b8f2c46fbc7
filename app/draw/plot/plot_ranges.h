// The ranges of a plot's axes of values.
#pragma once

#include "app/draw/plot/plot.h"

namespace hapticwall::draw {

// True if a drawn line uses this axis.
[[nodiscard]] bool has_axis(const PlotSurface& surface, const PlotDescription& plot, Side side);

// The samples within the window.
[[nodiscard]] IndexRange visible_range(const PlotSurface& surface);

// The extremes that the automatic axis shows, in SI units.
[[nodiscard]] Extremes axis_values(const PlotSurface& surface, const PlotDescription& plot,
                                   IndexRange range, Side side);

// The range of an axis that shows these values; a symlog one has room in decades.
[[nodiscard]] Extremes axis_range(const Extremes& values, const ValueScale& scale);

}  // namespace hapticwall::draw
