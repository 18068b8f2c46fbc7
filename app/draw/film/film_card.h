// One run in a picture of a film: its name, verdict, wall, contact and plots.
#pragma once

#include <cstdint>

#include "app/draw/film/film_moment.h"
#include "app/draw/film/film_pen.h"
#include "app/draw/plot/plot_trace.h"

namespace hapticwall::draw {

// Memory for one card between the pictures.
struct FilmScratch {
  PlotScratch plot;
  Trace trail;
};

void draw_film_card(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment,
                    FilmScratch& scratch);

// Parts of a card: a side view of the wall, the handle that is swept between its extremes, the hand
// and the force;
void draw_film_wall(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment);
// and position or force of the last moments.
enum class FilmPlot : std::uint8_t { kPosition, kForce };
void draw_film_plot(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment,
                    FilmPlot plot, PlotScratch& scratch);

}  // namespace hapticwall::draw
