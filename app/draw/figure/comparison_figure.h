// The figure of a comparison: small multiples, a column an algorithm, with the same axes along each
// row.
#pragma once

#include <cstddef>
#include <span>

#include "app/draw/figure/figure.h"
#include "app/draw/plot/sample_history.h"
#include "app/file/picture.h"
#include "core/result.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::draw {

// One algorithm of a comparison: of a scene with two axes, axis x.
struct ComparedRun {
  Summary summary;
  SampleHistory history;
};

// Wider pages than for so many are no figure any more.
inline constexpr std::size_t kMaxComparedRuns = 16;

// Of a page on which the columns of so many runs can be read.
[[nodiscard]] FigureSize comparison_size(std::size_t runs);

// The columns stand in the order of `runs`. `scene`: what all of them have in common; its algorithm
// is not looked at, but for what follows it. A run that diverged does not stretch the axes where
// there are others. Fails as draw_page() does.
[[nodiscard]] Result<file::Picture> draw_comparison(const Scene& scene,
                                                    std::span<const ComparedRun> runs,
                                                    FigureSize size);

}  // namespace hapticwall::draw
