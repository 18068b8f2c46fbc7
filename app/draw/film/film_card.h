// One run in a picture of a film: its name, verdict, wall, contact and plots.
#pragma once

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

}  // namespace hapticwall::draw
