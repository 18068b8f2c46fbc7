// The spectrum of one signal beside the plots.
#pragma once

#include <vector>

#include "app/draw/plot/plot.h"
#include "app/draw/plot/spectrum.h"

namespace hapticwall::draw {

struct SpectrumSettings {
  bool shown = false;
  Quantity quantity = &Sample::position_m;
};

// The state of the spectrum between frames.
struct SpectrumView {
  Spectrum spectrum;
  std::optional<SpectralLine> strongest;
};

// Draws heading, choice of the signal and the spectrum of the visible range into `size`; of the
// samples between the cursors while these are shown. Transforms in every frame in which it is
// drawn.
PlotArea draw_spectrum_plot(const PlotSurface& surface, const PlotTable& table,
                            SpectrumSettings& settings, SpectrumView& view, ImVec2 size);

}  // namespace hapticwall::draw
