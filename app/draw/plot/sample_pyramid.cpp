#include "app/draw/plot/sample_pyramid.h"

namespace hapticwall::draw {

void BlockLevels::forget_before(std::uint64_t first) {
  // No range asks for the block that the new beginning cuts.
  for (std::size_t level = 0; level < kLevels; ++level)
    stats[level].forget_before(first / size_of(level));
  squares.forget_before(first / size_of(kSquaresLevel));
}

void SamplePyramid::stack(double value, std::uint64_t end) {
  static_assert(BlockLevels::kFan == 4, "size_of() shifts by two bits a level");
  SampleStats carried = stats_of(value);
  for (std::size_t level = 0; level < kLevels; ++level) {
    levels_.growing[level].include(carried);
    if (end % size_of(level) != 0) return;
    carried = levels_.growing[level];
    levels_.stats[level].push_back(carried);
    if (level == BlockLevels::kSquaresLevel)
      levels_.squares.push_back(raw_squares(end - size_of(level), end, carried.mean()));
    levels_.growing[level] = {};
  }
}

double SamplePyramid::raw_squares(std::uint64_t first, std::uint64_t last, double mean) const {
  double sum = 0.0;
  for (std::uint64_t i = first; i < last; ++i) {
    const double distance = samples_[i] - mean;
    if (!std::isnan(distance)) sum += distance * distance;
  }
  return sum;
}

double SamplePyramid::squares(std::uint64_t first, std::uint64_t last, double mean) const {
  constexpr std::uint64_t kSize = size_of(BlockLevels::kSquaresLevel);
  const std::uint64_t first_block = (first + kSize - 1) / kSize;
  const std::uint64_t last_block = last / kSize;
  if (first_block >= last_block) return raw_squares(first, last, mean);
  double sum =
      raw_squares(first, first_block * kSize, mean) + raw_squares(last_block * kSize, last, mean);
  for (std::uint64_t i = first_block; i < last_block; ++i) {
    const SampleStats& block = levels_.stats[BlockLevels::kSquaresLevel][i];
    if (block.empty()) continue;
    const double distance = block.mean() - mean;
    sum += levels_.squares[i] + block.count * distance * distance;
  }
  return sum;
}

}  // namespace hapticwall::draw
