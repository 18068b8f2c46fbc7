#include "app/draw/plot/sample_pyramid.h"

namespace hapticwall::draw {

template class Pyramid<BlockArray<double>>;

BlockLevels::BlockLevels(std::uint64_t first) : squares(first / size_of(kSquaresLevel)) {
  // A block that begins before it is incomplete; no range asks for it.
  for (std::size_t level = 0; level < kLevels; ++level)
    stats[level] = BlockArray<SampleStats>(first / size_of(level));
}

void BlockLevels::forget_before(std::uint64_t first) {
  // No range asks for the block that the new beginning cuts.
  for (std::size_t level = 0; level < kLevels; ++level)
    stats[level].forget_before(first / size_of(level));
  squares.forget_before(first / size_of(kSquaresLevel));
}

}  // namespace hapticwall::draw
