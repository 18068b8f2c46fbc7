// Position and force of the last moments.
#pragma once

#include "app/draw/film/film_moment.h"
#include "app/draw/film/film_pen.h"
#include "app/draw/plot/plot_trace.h"

namespace hapticwall::draw {

enum class FilmPlot : std::uint8_t { kPosition, kForce };

void draw_film_plot(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment,
                    FilmPlot plot, PlotScratch& scratch);

}  // namespace hapticwall::draw
