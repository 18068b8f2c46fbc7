// The bytes of a figure's file: PNG, SVG or PDF.
#pragma once

#include <string>

#include "app/draw/figure/paper.h"
#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::draw {

// Content of the file `path`, by its ending: shapes for .svg and .pdf, else pixels.
[[nodiscard]] Ink ink_of(const std::string& path);

// Precondition: `figure` was drawn with ink_of(path). A vector file has the size of the paper. The
// first figure of a process always has the same bytes. Realtime-safe: no.
[[nodiscard]] Result<std::string> encode_figure(const file::Picture& figure,
                                                const std::string& path);

}  // namespace hapticwall::draw
