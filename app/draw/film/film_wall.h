// The wall, the handle that is swept between its extremes, the hand and the force: a side view.
#pragma once

#include "app/draw/film/film_moment.h"
#include "app/draw/film/film_pen.h"

namespace hapticwall::draw {

void draw_film_wall(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment);

}  // namespace hapticwall::draw
