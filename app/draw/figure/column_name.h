// The name above a column of small plots.
#pragma once

#include <string>

#include "app/draw/plot/theme.h"

namespace hapticwall::draw {

// In strong letters, within `width` pixels: a long name is smaller, and then cut off with "…".
void draw_column_name(const Theme& theme, const std::string& name, float width);

}  // namespace hapticwall::draw
