// The result of an identification as a picture.
#pragma once

#include "app/draw/figure/figure.h"
#include "app/file/picture.h"
#include "core/identify/identify.h"
#include "core/result.h"

namespace hapticwall::draw {

inline constexpr FigureSize kIdentificationSize{1600, 1200};

// From top to bottom: measured position and model in the last seconds, the force, and the residuals
// of the whole record in counts of the encoder. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_identification(const identify::Record& record,
                                                        const identify::Identification& found,
                                                        FigureSize size = kIdentificationSize);

}  // namespace hapticwall::draw
